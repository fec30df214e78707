#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace flankwright {

/// When find_peak() may stop, in the units of x and of the function.
struct PeakTolerance {
  double step;   ///< the next step is at most this long, > 0 ...
  double gain;   ///< ... and the function would rise by at most this, >= 0
  double close;  ///< a kink's two sides are sampled at most this far apart, >= step
};

/// Outcome of find_peak().
template <class Sample>
struct Peak {
  Sample top;                             ///< the sample at the maximum; on a kink the higher of its two sides
  std::optional<Sample> rising, falling;  ///< nearest samples before and after the maximum; none where that side was not sampled
  bool at_end{false};                     ///< the function still rises where its interval ends
  double gain{0.0};                       ///< by how much the last step, too short to take, would rise; 0 on kinks and at ends

  /// Weight of the falling side in the mean of both sides' slopes that vanishes. Other values of the samples, weighted
  /// alike, give those at the maximum: on a kink the weights are Lagrange's multipliers, on a smooth maximum this is
  /// linear interpolation. Nothing where a side was not sampled or the slope at the top itself is 0.
  std::optional<double> share_of_falling() const {
    if (at_end || !rising || !falling || top.slope() == 0.0) return std::nullopt;
    return rising->slope() / (rising->slope() - falling->slope());
  }
};

/// The maximum of a continuous function that has one in [lo, hi], from samples with slopes.
///
/// It takes secant steps on the slope. Where one does not halve the bracket, it steps to where the tangents of both
/// sides meet, which finds a kink as fast as the secant finds a smooth maximum; where that is not a number it bisects.
/// An end is sampled only when a step points beyond it. `Sample` offers position(), value() and slope().
/// @param evaluate   Sample at a position; it is also given the last sample, null at first
/// @param guess      first position sampled, in [lo, hi]
/// @param curvature  estimate of -f'' for the first step, > 0
/// @param rising, falling  samples already known on either side of the maximum
template <class Sample, class Evaluate>
Peak<Sample> find_peak(const Evaluate& evaluate, double lo, double hi, double guess, double curvature, const PeakTolerance& tolerance,
                       std::optional<Sample> rising = std::nullopt, std::optional<Sample> falling = std::nullopt) {
  constexpr int most_samples = 200;  // bisection alone needs 60 or so
  Peak<Sample> peak{evaluate(guess, static_cast<const Sample*>(nullptr)), std::move(rising), std::move(falling)};
  double last_position = guess, last_slope = 0.0;  // of the sample before; none yet
  double width = hi - lo;
  int slow = 0, same_side = 0;
  bool was_rising = false;
  for (int samples = 1;; ++samples) {
    const double x = peak.top.position(), slope = peak.top.slope();
    const bool rises = slope > 0.0;
    same_side = samples > 1 && rises == was_rising ? same_side + 1 : 0;
    was_rising = rises;
    std::optional<Sample>& side = rises ? peak.rising : peak.falling;
    if (samples == 1 && side) {
      last_position = side->position();
      last_slope = side->slope();
    }
    side = peak.top;
    peak.at_end = slope != 0.0 && (rises ? x >= hi : x <= lo);
    if (slope == 0.0 || peak.at_end || samples >= most_samples) return peak;

    if (x != last_position) {
      const double secant = (last_slope - slope) / (x - last_position);
      if (secant > 0.0 && std::isfinite(secant)) curvature = secant;
    }
    last_position = x;
    last_slope = slope;
    double step = slope / curvature;
    if (std::abs(step) <= tolerance.step && std::abs(step * slope) <= tolerance.gain) {
      peak.gain = 0.5 * step * slope;
      return peak;
    }
    if (!peak.rising || !peak.falling) {
      if (samples % 8 == 0) step = rises ? hi - x : lo - x;
      peak.top = evaluate(std::clamp(x + step, lo, hi), &peak.top);
      continue;
    }

    const Sample &a = *peak.rising, &b = *peak.falling;
    const double bracket = b.position() - a.position();
    slow = bracket > 0.5 * width ? slow + 1 : 0;
    if (slow == 0) width = bracket;
    if (slow >= 1 || !(x + step > a.position() && x + step < b.position())) {
      // Where the tangents meet, from a. A kink that was not passed is stepped over with growing steps.
      const double meet = ((b.value() - a.value()) - b.slope() * bracket) / (a.slope() - b.slope());
      const double gain = rises ? a.slope() * meet : -b.slope() * (bracket - meet);
      const double towards = rises ? 1.0 : -1.0, further = std::ldexp(1.0, 2 * std::min(same_side, 20));
      if (!(meet >= 0.0 && meet <= bracket)) {
        step = towards * 0.5 * bracket;
      } else {
        const bool arrived = gain <= tolerance.gain;
        if (arrived && bracket <= tolerance.close) break;
        const double way = arrived ? 0.5 * tolerance.close : rises ? meet : bracket - meet;
        step = towards * (same_side > 0 ? std::min(further * way, 0.5 * bracket) : way);
      }
    }
    double next = x + step;
    if (!(next > a.position() && next < b.position())) next = a.position() + 0.5 * bracket;
    if (!(next > a.position() && next < b.position())) break;  // no number left between the ends
    peak.top = evaluate(next, &peak.top);
  }
  peak.top = peak.falling->value() > peak.rising->value() ? *peak.falling : *peak.rising;
  return peak;
}

}  // namespace flankwright
