#include "optimize/sampling/sobol_indices.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace flankwright {

void SobolEstimate::Sums::add(double term, double v) {
  g += term;
  gg += term * term;
  gv += term * v;
}

void SobolEstimate::add_block(std::span<const double> outputs) {
  assert(outputs.size() == sums_.size() + 2);
  const double a = outputs[0] - centre_, b = outputs[1] - centre_;
  const double v = 0.5 * (a * a + b * b);
  ++blocks_;
  v_ += v;
  vv_ += v * v;
  for (std::size_t j = 0; j < sums_.size(); ++j) {
    const double mixed = outputs[j + 2] - centre_;
    sums_[j].first.add(b * (mixed - a), v);
    sums_[j].total.add(0.5 * (a - mixed) * (a - mixed), v);
  }
}

std::vector<SobolIndex> SobolEstimate::indices() const {
  std::vector<SobolIndex> indices(sums_.size());
  if (blocks_ < 2 || !(v_ > 0.0)) return indices;
  const auto n = static_cast<double>(blocks_);
  const double mean_v = v_ / n;
  // The ratio s = mean(g)/mean(v) scatters as the mean of (g - s v)/mean(v), whose own mean is 0.
  const auto ratio = [&](const Sums& sums, double& value, double& error) {
    value = sums.g / v_;
    const double square = (sums.gg - 2.0 * value * sums.gv + value * value * vv_) / n;
    error = std::sqrt(std::max(0.0, square) / (n - 1.0)) / mean_v;
  };
  for (std::size_t j = 0; j < sums_.size(); ++j) {
    ratio(sums_[j].first, indices[j].first, indices[j].first_error);
    ratio(sums_[j].total, indices[j].total, indices[j].total_error);
  }
  return indices;
}

}  // namespace flankwright
