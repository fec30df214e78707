#include "optimize/sampling/drawn_pitch.hpp"

#include <cmath>
#include <numbers>

#include "optimize/sampling/distribution.hpp"
#include "optimize/sampling/random_numbers.hpp"

namespace flankwright {

namespace {

enum Stream : std::uint64_t { RunOut, Phase, SingleTeeth };

/// Normal about zero, cut off at +-limit; 0 where nothing is left.
double cut_normal(double deviation, double limit, double u) {
  return limit > 0.0 ? Distribution::truncated_normal(0.0, deviation, -limit, limit).quantile(u) : 0.0;
}

}  // namespace

std::vector<double> drawn_pitch(const PitchTolerance& tolerance, std::uint64_t draw) {
  using std::numbers::pi;
  const double left = tolerance.cumulative - tolerance.single;
  const double run_out = std::abs(cut_normal(left / 3.0, left, random_uniform(draw, RunOut, 0)));
  const double phase = 2.0 * pi * random_uniform(draw, Phase, 0);
  // What run-out takes of a single pitch at its steepest.
  const double step = run_out * std::sin(pi / tolerance.teeth);
  const double limit = 0.5 * (tolerance.single - step);
  std::vector<double> deviations;
  for (int k = 0; k < tolerance.teeth; ++k) {
    const double single =
        cut_normal(tolerance.single / (3.0 * std::numbers::sqrt2), limit, random_uniform(draw, SingleTeeth, static_cast<std::uint64_t>(k)));
    deviations.push_back(0.5 * run_out * std::cos(2.0 * pi * k / tolerance.teeth + phase) + single);
  }
  return deviations;
}

}  // namespace flankwright
