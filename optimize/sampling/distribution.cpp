#include "optimize/sampling/distribution.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace flankwright {

namespace {

void require(bool holds, const char* name, double value, const char* allowed) {
  if (!holds || !std::isfinite(value)) throw InvalidInput(name, std::to_string(value), allowed);
}

/// x <= 0 with Phi(x) = p, 0 < p <= 1/2.
double lower_quantile(double p) {
  // Abramowitz & Stegun 26.2.23, wrong by less than 4.5e-4; each of Halley's steps cubes that error.
  const double t = std::sqrt(-2.0 * std::log(p));
  double x = -(t - (2.515517 + 0.802853 * t + 0.010328 * t * t) / (1.0 + 1.432788 * t + 0.189269 * t * t + 0.001308 * t * t * t));
  for (int step = 0; step < 2; ++step) {
    const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
    const double newton = (normal_probability(x) - p) / density;
    x -= newton / (1.0 + 0.5 * x * newton);
  }
  return x;
}

}  // namespace

double normal_probability(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

double normal_quantile(double p) {
  assert(p > 0.0 && p < 1.0);
  return p <= 0.5 ? lower_quantile(p) : -lower_quantile(1.0 - p);
}

Distribution Distribution::normal(double mean, double deviation) {
  require(true, "mean", mean, "a finite number");
  require(deviation > 0.0, "deviation", deviation, "a number above 0");
  Distribution d;
  d.kind_ = Kind::Normal;
  d.mean_ = mean;
  d.deviation_ = deviation;
  return d;
}

Distribution Distribution::truncated_normal(double mean, double deviation, double low, double high) {
  Distribution d = normal(mean, deviation);
  require(true, "low", low, "a finite number");
  require(high > low, "high", high, "a number above the lower bound");
  d.kind_ = Kind::TruncatedNormal;
  d.low_ = low;
  d.high_ = high;
  constexpr double least_share = 1e-12;  // of the normal distribution between the bounds
  const double share = normal_probability((high - mean) / deviation) - normal_probability((low - mean) / deviation);
  require(share >= least_share, "bounds", share, "bounds between which the normal distribution has a share of at least 1e-12");
  return d;
}

Distribution Distribution::uniform(double low, double high) {
  require(true, "low", low, "a finite number");
  require(high > low, "high", high, "a number above the lower bound");
  Distribution d;
  d.kind_ = Kind::Uniform;
  d.low_ = low;
  d.high_ = high;
  return d;
}

Distribution Distribution::values(std::vector<double> values) {
  require(!values.empty(), "values", 0.0, "at least one value");
  for (const double value : values) require(true, "values", value, "finite numbers");
  Distribution d;
  d.kind_ = Kind::Values;
  d.values_ = std::move(values);
  return d;
}

Distribution Distribution::grid(double low, double high, int n) {
  require(true, "low", low, "a finite number");
  require(high > low, "high", high, "a number above the lower bound");
  require(n >= 2, "levels", n, "at least 2 levels");
  std::vector<double> levels(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) levels[static_cast<std::size_t>(k)] = ((n - 1 - k) * low + k * high) / (n - 1);
  return values(std::move(levels));
}

double Distribution::widest() const {
  constexpr double outer_share = 1e-6;
  const std::vector<double> ends = levels() > 0 ? values_ : std::vector{quantile(outer_share), quantile(1.0 - outer_share)};
  return *std::ranges::max_element(ends, {}, [](double value) { return std::abs(value); });
}

double Distribution::quantile(double u) const {
  assert(u > 0.0 && u < 1.0);
  switch (kind_) {
    case Kind::Normal:
      return mean_ + deviation_ * normal_quantile(u);
    case Kind::TruncatedNormal: {
      const double below_low = normal_probability((low_ - mean_) / deviation_);
      const double above_high = normal_probability((mean_ - high_) / deviation_);
      // From the end that is nearer: the other one's probability rounds to 1.
      const double from_low = below_low + u * (1.0 - below_low - above_high);
      const double from_high = above_high + (1.0 - u) * (1.0 - below_low - above_high);
      const double x = from_low <= from_high ? normal_quantile(from_low) : -normal_quantile(from_high);
      return std::clamp(mean_ + deviation_ * x, low_, high_);
    }
    case Kind::Uniform:
      return low_ + u * (high_ - low_);
    case Kind::Values: {
      const auto level = static_cast<std::size_t>(u * static_cast<double>(values_.size()));
      return values_[std::min(level, values_.size() - 1)];
    }
  }
  __builtin_unreachable();
}

}  // namespace flankwright
