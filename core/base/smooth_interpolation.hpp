#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace flankwright {

/// Weights of values at some places in a value between them; those beyond `count` are 0.
struct InterpolationWeights {
  std::size_t first{0}, count{0};  ///< of the places
  std::array<double, 4> weight{};
};

namespace detail {

/// Weights that continue values at three places to x by their parabola, or its slope there.
inline std::array<double, 3> parabola_weights(std::span<const double, 3> z, double x, bool slope) {
  std::array<double, 3> weights{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double to_one = x - z[(k + 1) % 3], to_other = x - z[(k + 2) % 3];
    weights[k] = (slope ? to_one + to_other : to_one * to_other) / ((z[k] - z[(k + 1) % 3]) * (z[k] - z[(k + 2) % 3]));
  }
  return weights;
}

}  // namespace detail

/// Between places[left] and the next: the cubic that has there the values and the slopes of parabolas through three neighbours, third order and of
/// continuous slope; a straight line between two places.
/// @param places  rising, left + 1 < places.size()
inline InterpolationWeights smooth_interpolation(std::span<const double> places, std::size_t left, double x) {
  const std::size_t n = places.size();
  const double length = places[left + 1] - places[left], t = (x - places[left]) / length;
  if (n < 3) return {left, 2, {1.0 - t, t}};
  InterpolationWeights sum{left > 0 ? left - 1 : 0, 0, {}};
  sum.count = (left + 2 < n ? left + 3 : n) - sum.first;
  const auto add_slope = [&](std::size_t at, double by) {
    const std::size_t from = at == 0 ? 0 : at + 1 == n ? n - 3 : at - 1;
    const auto slopes = detail::parabola_weights(places.subspan(from).first<3>(), places[at], true);
    for (std::size_t k = 0; k < 3; ++k) sum.weight[from + k - sum.first] += by * slopes[k];
  };
  sum.weight[left - sum.first] += (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t);
  sum.weight[left + 1 - sum.first] += t * t * (3.0 - 2.0 * t);
  add_slope(left, length * t * (1.0 - t) * (1.0 - t));
  add_slope(left + 1, -length * t * t * (1.0 - t));
  return sum;
}

/// Beyond the first or last places, or between them: the parabola through three, the straight line through two.
/// @param places  two or three, in order
inline std::array<double, 3> continued(std::span<const double> places, double x) {
  if (places.size() == 3) return detail::parabola_weights(places.first<3>(), x, false);
  const double t = (x - places[0]) / (places[1] - places[0]);
  return {1.0 - t, t, 0.0};
}

}  // namespace flankwright
