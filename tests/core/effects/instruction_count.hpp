#pragma once

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>

namespace flankwright {

/// Instructions of this thread outside the kernel, where the machine lets one count them.
class InstructionCount {
 public:
  InstructionCount() {
    perf_event_attr event{};
    event.type = PERF_TYPE_HARDWARE;
    event.size = sizeof(event);
    event.config = PERF_COUNT_HW_INSTRUCTIONS;
    event.disabled = 1;
    event.exclude_kernel = 1;
    event.exclude_hv = 1;
    file_ = static_cast<int>(syscall(SYS_perf_event_open, &event, 0, -1, -1, 0));
    if (file_ < 0) why_not_ = std::strerror(errno);
  }
  ~InstructionCount() {
    if (file_ >= 0) close(file_);
  }
  InstructionCount(const InstructionCount&) = delete;
  InstructionCount& operator=(const InstructionCount&) = delete;

  bool permitted() const { return file_ >= 0; }
  const std::string& why_not() const { return why_not_; }

  void start() {
    ioctl(file_, PERF_EVENT_IOC_RESET, 0);
    ioctl(file_, PERF_EVENT_IOC_ENABLE, 0);
  }
  std::int64_t stop() {
    ioctl(file_, PERF_EVENT_IOC_DISABLE, 0);
    std::int64_t count = -1;
    return read(file_, &count, sizeof(count)) == sizeof(count) ? count : -1;
  }

 private:
  int file_{-1};
  std::string why_not_;
};

}  // namespace flankwright
