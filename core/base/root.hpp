#pragma once

#include <algorithm>
#include <cmath>

namespace flankwright {

/// Outcome of bracketed_root().
struct Root {
  double x{0.0};      ///< where the sign changes
  double lower{0.0};  ///< last bracket: f(lower) > 0 >= f(upper), or the mirror image
  double upper{0.0};
};

/// Where a function changes sign in [a, b], given f(a) and f(b) of opposite sign (a zero counts as either).
///
/// Regula falsi with the Illinois weight, safeguarded by bisection whenever the bracket has not halved in two steps, so
/// that it needs at most three times the steps of bisection, superlinearly few where f is smooth, and also locates a
/// jump (the slope of a flank with a linear relief has them). Stops when upper - lower <= tolerance.
/// @param tolerance  width of the final bracket, > 0, in units of x
template <class Function>
Root bracketed_root(const Function& f, double a, double fa, double b, double fb, double tolerance) {
  if (fa == 0.0) return {a, a, a};
  if (fb == 0.0) return {b, b, b};
  double width = std::abs(b - a);
  int side = 0, slow_steps = 0;
  while (std::abs(b - a) > tolerance) {
    const bool has_secant = std::isfinite(fa) && std::isfinite(fb);  // a function may be infinite on one side
    double x = has_secant ? (a * fb - b * fa) / (fb - fa) : 0.5 * (a + b);
    const double lo = std::min(a, b), hi = std::max(a, b);
    // A step of at least half the tolerance inside the bracket lets a converged end close in from the other side.
    const double inset = std::min(0.5 * tolerance, 0.25 * (hi - lo));
    if (slow_steps >= 2 || !has_secant || !std::isfinite(x)) {
      x = 0.5 * (a + b);
      slow_steps = 0;
      side = 0;
    } else {
      x = std::clamp(x, lo + inset, hi - inset);
    }
    if (x <= lo || x >= hi) break;  // no number left between the ends
    const double fx = f(x);
    if (fx == 0.0) return {x, x, x};
    if ((fx > 0.0) == (fa > 0.0)) {
      a = x;
      fa = fx;
      if (side == 1) fb *= 0.5;
      side = 1;
    } else {
      b = x;
      fb = fx;
      if (side == -1) fa *= 0.5;
      side = -1;
    }
    slow_steps = std::abs(b - a) > 0.5 * width ? slow_steps + 1 : 0;
    if (slow_steps == 0) width = std::abs(b - a);
  }
  return {std::abs(fa) < std::abs(fb) ? a : b, std::min(a, b), std::max(a, b)};
}

/// The last accepted number between one that is accepted and one that is not, to round-off.
template <class Predicate>
double limit_between(double accepted, double refused, const Predicate& is_accepted) {
  for (;;) {
    const double middle = 0.5 * (accepted + refused);
    if (middle == accepted || middle == refused) return accepted;
    (is_accepted(middle) ? accepted : refused) = middle;
  }
}

}  // namespace flankwright
