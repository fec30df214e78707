#include "core/gear/involute.hpp"

#include <cmath>
#include <string>

#include "core/base/error.hpp"

namespace flankwright {

namespace {

/// t - atan(t) for t >= 0. Below 0.1 the difference would cancel; the series t^3/3 - t^5/5 + ... ends where t^18/21 < 1e-19.
double tangent_excess(double t) {
  if (t >= 0.1) return t - std::atan(t);
  double sum = 0.0;
  for (int k = 19; k >= 3; k -= 2) sum = 1.0 / k - t * t * sum;
  return t * t * t * sum;
}

}  // namespace

double involute(double angle) { return std::tan(angle) - angle; }

double inverse_involute(double value) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    throw InvalidInput("involute value", std::to_string(value), "finite and >= 0");
  }
  if (value == 0.0) return 0.0;
  // Newton on t - atan(t) = value, t = tan(alpha): convex and increasing for t > 0, so it converges from any start
  // right of the root; t = cbrt(3 v) (small v) and v + pi/2 (large v) both lie there or next to it.
  double t = value < 1.0 ? std::cbrt(3.0 * value) * (1.0 + 0.4 * std::cbrt(value * value)) : value + 1.5707963267948966;
  for (int i = 0; i < 100; ++i) {
    const double step = (tangent_excess(t) - value) / (t * t) * (1.0 + t * t);
    t -= step;
    if (std::abs(step) <= 1e-16 * t) break;  // |step| <= eps * t: the next digit is round-off
  }
  return std::atan(t);
}

}  // namespace flankwright
