#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "core/base/progress_report.hpp"

namespace flankwright::studies {

/// Progress of long work on stderr: a bar that redraws itself on a terminal, a line every few seconds elsewhere. It shows the time
/// that is left as if the steps to come took as long as those done under the same label.
class Progress {
 public:
  /// @param quiet  shows nothing at all
  explicit Progress(bool quiet = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param total  0 where it is not known how much there is to do: a count is shown instead of a bar
  void show(const std::string& label, int done, int total, const std::string& remark);
  /// Shows what is reported to it, with these words before each label.
  ProgressReport report(std::string before = {}) {
    return [this, before = std::move(before)](const std::string& label, int done, int total, const std::string& remark) {
      show(before + label, done, total, remark);
    };
  }
  /// Ends the bar's line, so that other text can follow.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  /// None before a step is done, and at the end.
  std::optional<double> seconds_left(Clock::time_point now, int done, int total) const;

  bool quiet_, terminal_, line_open_{false};
  Clock::time_point start_, last_shown_;
  std::string label_;              ///< of the work at hand
  Clock::time_point label_start_;  ///< of that
  int done_before_{0};             ///< steps that were done then
};

}  // namespace flankwright::studies
