#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace flankwright::studies {

/// Progress of long work: a label, done and total steps (total 0: unknown), a remark.
using ProgressReport = std::function<void(const std::string& label, int done, int total, const std::string& remark)>;

/// Progress of long work on stderr: a bar that redraws itself on a terminal, a line every few seconds elsewhere.
class Progress {
 public:
  /// @param quiet  shows nothing at all
  explicit Progress(bool quiet = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param total  0 where it is not known how much there is to do: a count is shown instead of a bar
  void show(const std::string& label, int done, int total, const std::string& remark);
  /// Ends the bar's line, so that other text can follow.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_, terminal_, line_open_{false};
  Clock::time_point start_, last_shown_;
};

}  // namespace flankwright::studies
