#pragma once

#include <ctime>

namespace flankwright {

/// Processor time of the calling thread since construction [s]: the cost of work, whatever else the machine does. For
/// the times in results, never for a decision.
class ThreadStopwatch {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  double start_{now()};
};

}  // namespace flankwright
