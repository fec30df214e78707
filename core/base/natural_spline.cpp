#include "core/base/natural_spline.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace flankwright {

NaturalSpline::NaturalSpline(std::vector<double> x, std::vector<double> y) : x_(std::move(x)), y_(std::move(y)), second_(x_.size(), 0.0) {
  // Tridiagonal elimination for the second derivatives, continuity of slope at the inner points.
  const std::size_t n = x_.size();
  std::vector<double> diagonal(n, 1.0), right(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = x_[i] - x_[i - 1], after = x_[i + 1] - x_[i];
    const double below = i > 1 ? before / diagonal[i - 1] : 0.0;
    diagonal[i] = 2.0 * (before + after) - below * before;
    right[i] = 6.0 * ((y_[i + 1] - y_[i]) / after - (y_[i] - y_[i - 1]) / before) - below * right[i - 1];
  }
  for (std::size_t i = n; i-- > 1;) {
    if (i + 1 < n) second_[i] = (right[i] - (x_[i + 1] - x_[i]) * second_[i + 1]) / diagonal[i];
  }
}

double NaturalSpline::operator()(double x) const {
  if (x_.size() == 1) return y_.front();
  const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
  const std::size_t i = static_cast<std::size_t>(above - x_.begin()) - 1;
  const double h = x_[i + 1] - x_[i], b = (x - x_[i]) / h, a = 1.0 - b;
  return a * y_[i] + b * y_[i + 1] + ((a * a * a - a) * second_[i] + (b * b * b - b) * second_[i + 1]) * h * h / 6.0;
}

}  // namespace flankwright
