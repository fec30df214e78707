#pragma once

#include <algorithm>
#include <cmath>

namespace flankwright {

/// How far the last of three values, each from half the step of the one before, is from where they are going, by their own differences
/// d1, d2:
///
///     order p = log2(d1/d2),   error = d / (2^p' - 1),   d = max(d2, d1/2^most),   p' = log2(d1/d) within least .. most.
///
/// A value that passes its neighbour by chance makes d2 small and p large; `most` keeps it from being taken for an order.
struct LimitEstimate {
  static constexpr double least = 0.75, most = 2.0;  ///< orders that errors are computed with

  double error;  ///< of the last value, >= 0, in its unit
  double order;  ///< observed; infinite where d2 = 0, NaN where both are 0
  /// d1 and d2 are of one sign and least <= order: the sequence comes closer as a power of the step. An irregular
  /// sequence also has an estimate, by its last change.
  bool regular;
};

inline LimitEstimate estimate_limit(double coarse, double middle, double fine) {
  const double d1 = std::abs(middle - coarse), d2 = std::abs(fine - middle);
  const double order = std::log2(d1 / d2);
  const bool regular = (middle - coarse) * (fine - middle) > 0.0 && order >= LimitEstimate::least;
  const double change = std::max(d2, d1 / std::exp2(LimitEstimate::most));
  if (change == 0.0) return {0.0, order, regular};
  const double used = std::clamp(std::log2(d1 / change), LimitEstimate::least, LimitEstimate::most);
  return {change / (std::exp2(used) - 1.0), order, regular};
}

}  // namespace flankwright
