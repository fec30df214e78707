#pragma once

#include <fenv.h>

namespace flankwright::hard_cases {

/// While it lives, an invalid operation (0/0, inf - inf, an ordered comparison with NaN, the root of a negative number) or a division by
/// zero in this thread ends the program with SIGFPE, which Catch2 reports with the test. Copies of NaN and comparisons for equality stay
/// quiet. Without glibc it does nothing, nor with clang++, which may divide before the test that guards the division.
class FloatingPointTraps {
 public:
#if defined(__GLIBC__) && !defined(__clang__)
  FloatingPointTraps() : before_(fegetexcept()) {
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(FE_INVALID | FE_DIVBYZERO);
  }
  ~FloatingPointTraps() {
    fedisableexcept(FE_ALL_EXCEPT);
    feclearexcept(FE_ALL_EXCEPT);  // enabling one that is pending would trap
    feenableexcept(before_);
  }
#else
  FloatingPointTraps() {}
  ~FloatingPointTraps() {}
#endif
  FloatingPointTraps(const FloatingPointTraps&) = delete;
  FloatingPointTraps& operator=(const FloatingPointTraps&) = delete;

 private:
  [[maybe_unused]] int before_{0};
};

}  // namespace flankwright::hard_cases
