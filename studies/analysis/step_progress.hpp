#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <utility>

#include "core/base/progress_report.hpp"

namespace flankwright::studies {

/// Counts what threads have done of one step of a run, and reports it. Short steps report nothing.
class StepProgress {
 public:
  /// @param progress  outlives this; may be empty
  StepProgress(const ProgressReport& progress, std::string label, std::size_t total, std::string remark = {})
      : progress_(progress), label_(std::move(label)), total_(static_cast<int>(total)), remark_(std::move(remark)) {}

  /// One more is done. May be called by several threads at a time.
  void add_one() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (progress_ && Clock::now() - start_ >= silence) progress_(label_, done_, total_, remark_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds silence{2};  // a shorter step needs no report

  const ProgressReport& progress_;
  std::string label_;
  int total_, done_{0};
  std::string remark_;
  std::mutex mutex_;
  Clock::time_point start_{Clock::now()};
};

}  // namespace flankwright::studies
