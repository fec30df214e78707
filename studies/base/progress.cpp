#include "studies/base/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace flankwright::studies {

namespace {

constexpr int bar_width = 30;
constexpr std::chrono::milliseconds redraw{100};  // on a terminal
constexpr std::chrono::seconds repeat{5};         // elsewhere

}  // namespace

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1), start_(Clock::now()) {}

Progress::~Progress() { finish(); }

void Progress::show(const std::string& label, int done, int total, const std::string& remark) {
  const Clock::time_point now = Clock::now();
  const bool last = total > 0 && done >= total;
  const bool is_new = label != label_;
  if (is_new) {
    label_ = label;
    label_start_ = now;
    done_before_ = done;
  }
  if (quiet_ || (!last && !is_new && now - last_shown_ < (terminal_ ? std::chrono::milliseconds(redraw) : repeat))) return;
  last_shown_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::string text;
  if (total > 0) {
    const int filled = bar_width * done / total;
    text = fmt::format("{} [{}{}] {}/{}  {:.0f} s", label, std::string(filled, '#'), std::string(bar_width - filled, '.'), done, total, seconds);
    if (const auto left = seconds_left(now, done, total)) text += fmt::format(", about {:.0f} s left", *left);
  } else {
    text = fmt::format("{}: {} analyses  {:.0f} s", label, done, seconds);
  }
  if (!remark.empty()) text += "  " + remark;
  if (terminal_) {
    std::fprintf(stderr, "\r\033[K%s", text.c_str());
    line_open_ = true;
  } else {
    std::fprintf(stderr, "%s\n", text.c_str());
  }
  std::fflush(stderr);
}

std::optional<double> Progress::seconds_left(Clock::time_point now, int done, int total) const {
  const int since = done - done_before_;
  if (since <= 0 || done >= total) return std::nullopt;
  const double seconds = std::chrono::duration<double>(now - label_start_).count();
  return seconds / since * (total - done);
}

void Progress::finish() {
  if (line_open_) std::fputc('\n', stderr);
  line_open_ = false;
}

}  // namespace flankwright::studies
