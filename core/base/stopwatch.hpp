#pragma once

#include <chrono>

namespace flankwright {

/// Wall time since construction [s]; for the times in results, never for a decision.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_{std::chrono::steady_clock::now()};
};

}  // namespace flankwright
