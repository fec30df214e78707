#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace flankwright {

/// A sample of a curve.
struct CurveSample {
  double x, y;
};

/// The height to which a curve may rise, and where.
struct CurveRise {
  double height{-std::numeric_limits<double>::infinity()}, x{std::numeric_limits<double>::quiet_NaN()};
};

namespace detail {

/// Slope into the interval behind `near`, from the last secant or extrapolated from the last two, whichever is steeper.
inline double slope_into(const CurveSample& far, const CurveSample& middle, const CurveSample& near) {
  const double before = (middle.y - far.y) / std::abs(middle.x - far.x), last = (near.y - middle.y) / std::abs(near.x - middle.x);
  return std::max(last, last + (last - before) * (near.x - middle.x) / (near.x - far.x));
}

/// The top of the parabola through three samples; nothing above them where it opens upwards.
inline CurveRise vertex(const CurveSample& a, const CurveSample& b, const CurveSample& c) {
  const double before = (b.y - a.y) / (b.x - a.x), after = (c.y - b.y) / (c.x - b.x);
  const double curvature = 2.0 * (after - before) / (c.x - a.x);
  if (!(curvature < 0.0)) return {};
  const double slope = before + 0.5 * curvature * (b.x - a.x), step = -slope / curvature;  // at b
  return {b.y + 0.5 * slope * step, b.x + step};
}

/// By how much the curve may rise beyond a sample that lies above what both sides promise; nothing where it does not.
/// @param after_1  towards which it rises
inline double rise_of_lone(const CurveSample& before_3, const CurveSample& before_2, const CurveSample& before_1, const CurveSample& sample,
                           const CurveSample& after_1, const CurveSample& after_2, const CurveSample& after_3) {
  const double step = std::abs(sample.x - before_1.x), next = std::abs(after_1.x - sample.x);
  const double promised =
      std::max(before_1.y + slope_into(before_3, before_2, before_1) * step, after_1.y + slope_into(after_3, after_2, after_1) * next);
  return sample.y > promised ? 0.5 * next * std::max(0.0, (sample.y - before_1.y) / step) : 0.0;
}

}  // namespace detail

/// How high a curve may rise between two neighbouring samples. It consists of smooth pieces with kinks: both sides are continued straight until they
/// meet, by the last secant or by the slope extrapolated from the last two, whichever is steeper, because curves grow steeper towards a kink. On a smooth
/// top the parabola through three neighbours is taken.
///
/// A sample that lies above what both of its sides promise is the only one on its piece of the curve, for example where a tip edge carries for a thirtieth of a
/// pitch. How the piece goes on is then not known. The curve is taken to rise half way to the next sample, along the secant from the other side.
/// @param curve  by rising x
/// @param left   the interval's first sample; three more lie beyond either end
inline CurveRise rise_between(std::span<const CurveSample> curve, std::size_t left) {
  const CurveSample a = curve[left], b = curve[left + 1];
  const double length = b.x - a.x;
  const double from_left = detail::slope_into(curve[left - 2], curve[left - 1], a),
               from_right = detail::slope_into(curve[left + 3], curve[left + 2], b);
  double t = 0.5, height = std::max(a.y, b.y);
  if (from_left > 0.0 && from_right > 0.0) {
    t = std::clamp((b.y + from_right * length - a.y) / ((from_left + from_right) * length), 0.0, 1.0);
    height = std::min(a.y + from_left * t * length, b.y + from_right * (1.0 - t) * length);
  } else if (from_left > 0.0 && b.y < a.y) {
    height = a.y + from_left * length;
  } else if (from_right > 0.0 && a.y < b.y) {
    height = b.y + from_right * length;
  }
  CurveRise rise{height, a.x + t * length};
  for (const CurveRise& top : {detail::vertex(curve[left - 1], a, b), detail::vertex(a, b, curve[left + 2])}) {
    if (top.height > rise.height && top.x > a.x && top.x < b.x) rise = top;
  }
  const double past_a = detail::rise_of_lone(curve[left - 3], curve[left - 2], curve[left - 1], a, b, curve[left + 2], curve[left + 3]),
               past_b = detail::rise_of_lone(curve[left + 4], curve[left + 3], curve[left + 2], b, a, curve[left - 1], curve[left - 2]);
  for (const double lone : {a.y + past_a, b.y + past_b}) {
    if (lone > rise.height) rise = {lone, a.x + 0.5 * length};
  }
  return rise;
}

}  // namespace flankwright
