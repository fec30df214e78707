#include "studies/progress.hpp"

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
  if (quiet_ || (!last && now - last_shown_ < (terminal_ ? std::chrono::milliseconds(redraw) : repeat))) return;
  last_shown_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::string text;
  if (total > 0) {
    const int filled = bar_width * done / total;
    text = fmt::format("{} [{}{}] {}/{}  {:.0f} s", label, std::string(filled, '#'), std::string(bar_width - filled, '.'), done,
                       total, seconds);
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

void Progress::finish() {
  if (line_open_) std::fputc('\n', stderr);
  line_open_ = false;
}

}  // namespace flankwright::studies
