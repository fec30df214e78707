#include "core/contact/unloaded/section_maximum.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/root.hpp"

namespace flankwright {

struct SectionSearch::Range {
  double lo, hi;
  SectionBound at_lo{SectionBound::PinionRoot}, at_hi{SectionBound::PinionTip};
};

struct SectionSearch::Tolerance {
  PeakTolerance peak;  ///< roll length [mm], angle [rad], distance of the two sides of a kink [mm]
  double newton;       ///< mm: length of the last Newton step onto a circle of the wheel, which leaves its square
};

/// One evaluation along the section; the angle itself is computed only where a kink asks for it.
struct SectionSearch::Sample {
  FlankContact at;
  const ContactCondition* contact_condition;

  double position() const { return at.rho; }
  double slope() const { return at.angle.rho; }
  double value() const { return contact_condition->phi2(at); }
};

namespace {

constexpr double bound_tolerance = 1e-12;  // mm: where a circle of the wheel crosses the section, if bracketed
constexpr int pieces_at_root = 8;          // into which the cell of the profile with the wheel's form circle is cut
constexpr double end_round_off = 1e-12;    // half face widths that a point may lie beyond the pinion's face end

SectionMaximum missing(double z) {
  SectionMaximum none;
  none.z = z;
  return none;
}

/// A slope along z, 0 where it points across the wheel's end.
double slope_inwards(const FlankContact& m, double slope) { return m.on_wheel_end && slope * m.wheel_z > 0.0 ? 0.0 : slope; }

bool is_on_wheel_circle(SectionBound bound) { return bound == SectionBound::WheelTip || bound == SectionBound::WheelRoot; }

}  // namespace

Touch touch_at(const FlankContact& m) {
  return {m.rho, m.z, m.wheel_roll + m.wheel_deviation, m.wheel_z, m.angle.rho, m.angle.phi1, 1.0 + m.deviation_slope};
}

SectionMaximum SectionSearch::at(double z, const SectionMaximum& neighbour, SectionAccuracy accuracy) const {
  const Tolerance tolerance = accuracy == SectionAccuracy::Full ? Tolerance{{1e-8, 1e-16, 1e-6}, 1e-7} : Tolerance{{1e-3, 1e-10, 1e-3}, 1e-3};
  return cells_ == 1 ? only_maximum(z, neighbour, tolerance) : highest_maximum(z, tolerance);
}

double SectionSearch::radius_of(SectionBound bound) const {
  const Flank& wheel = condition_.assembly().wheel;
  return bound == SectionBound::WheelTip ? wheel.tip_radius : wheel.form_radius;
}

SectionMaximum SectionSearch::only_maximum(double z, const SectionMaximum& neighbour, const Tolerance& tolerance) const {
  const Flank& pinion = condition_.assembly().pinion;
  const Range range{pinion.lowest_roll(), pinion.highest_roll()};
  double guess = condition_.undisturbed_roll(z);
  if (neighbour.exists && neighbour.bound == SectionBound::None) {
    guess += neighbour.at.rho - condition_.undisturbed_roll(neighbour.z);
  } else if (neighbour.exists && is_on_wheel_circle(neighbour.bound)) {
    // Is it on the same circle again? With one maximum, the slope there shows on which side it lies.
    FlankContact m = condition_.at(neighbour.at.rho, z, &neighbour.at);
    if (move_to_radius(z, range, tolerance, radius_of(neighbour.bound), m)) {
      if (neighbour.bound == SectionBound::WheelTip ? m.angle.rho < 0.0 : m.angle.rho > 0.0) return finish(z, m, neighbour.bound);
      guess = m.rho + m.angle.rho / condition_.undisturbed_curvature(m.rho);
    }
  }
  const auto evaluate = [&](double rho, const Sample* previous) {
    return Sample{condition_.at(rho, z, previous ? &previous->at : neighbour.exists ? &neighbour.at : nullptr), &condition_};
  };
  guess = std::clamp(guess, range.lo, range.hi);
  const double curvature = condition_.undisturbed_curvature(guess);
  return settle(z, range, tolerance, find_peak<Sample>(evaluate, range.lo, range.hi, guess, curvature, tolerance.peak));
}

SectionMaximum SectionSearch::highest_maximum(double z, const Tolerance& tolerance) const {
  const Flank& pinion = condition_.assembly().pinion;
  const double lowest = pinion.lowest_roll(), highest = pinion.highest_roll();
  std::vector<Sample> samples;
  for (int i = 0; i <= cells_; ++i) {
    const double rho = i == cells_ ? highest : lowest + i * (highest - lowest) / cells_;
    samples.push_back({condition_.at(rho, z, i == 0 ? nullptr : &samples.back().at), &condition_});
  }
  // The part of every piece on the wheel's flank; a circle of the wheel that cuts it off is a bound.
  SectionMaximum best = missing(z);
  const auto consider = [&](const SectionMaximum& other) {
    if (other.exists && other.phi2 > best.phi2) best = other;
  };
  const auto search = [&](const FlankContact& from, const FlankContact& to, const Range& range, bool first, bool last) {
    const Sample lower{from, &condition_}, upper{to, &condition_};
    if (first && lower.slope() <= 0.0) consider(finish(z, from, range.at_lo));
    if (last && upper.slope() >= 0.0) consider(finish(z, to, range.at_hi));
    if (!(lower.slope() > 0.0 && upper.slope() < 0.0)) return;
    const auto evaluate = [&](double rho, const Sample* previous) {
      return Sample{condition_.at(rho, z, previous ? &previous->at : &from), &condition_};
    };
    const double curvature = (lower.slope() - upper.slope()) / (range.hi - range.lo);
    const double guess = std::clamp(range.lo + lower.slope() / curvature, range.lo, range.hi);
    consider(settle(z, range, tolerance, find_peak<Sample>(evaluate, range.lo, range.hi, guess, curvature, tolerance.peak, lower, upper)));
  };
  for (int i = 0; i < cells_; ++i) {
    Range range{samples[i].position(), samples[i + 1].position()};
    FlankContact a = samples[i].at, b = samples[i + 1].at;
    if (!move_onto_wheel(z, range, tolerance, a, range.at_lo) || !move_onto_wheel(z, range, tolerance, b, range.at_hi)) continue;
    if (!(a.rho < b.rho)) continue;
    const bool first = i == 0 || a.rho > range.lo, last = i + 1 == cells_ || b.rho < range.hi;
    // Towards the wheel's base circle its roll length changes as the root of the distance.
    const int pieces = range.at_hi == SectionBound::WheelRoot ? pieces_at_root : 1;
    const double length = b.rho - a.rho;
    for (int piece = 1; piece <= pieces; ++piece) {
      const double left = 1.0 - static_cast<double>(piece) / pieces;
      const FlankContact end = piece == pieces ? b : condition_.at(b.rho - left * left * length, z, &a);
      range.lo = a.rho;
      range.hi = end.rho;
      search(a, end, range, first && piece == 1, last && piece == pieces);
      a = end;
    }
  }
  return best;
}

/// The maximum that a search along the profile has led to, held by the wheel's circles.
SectionMaximum SectionSearch::settle(double z, const Range& range, const Tolerance& tolerance, const Peak<Sample>& peak) const {
  FlankContact m = peak.top.at;
  const SectionBound of_profile = !peak.at_end ? SectionBound::None : m.angle.rho > 0.0 ? range.at_hi : range.at_lo;
  SectionBound bound = of_profile;
  if (!move_onto_wheel(z, range, tolerance, m, bound)) return missing(z);
  SectionMaximum best = finish(z, m, bound);
  if (bound != SectionBound::None || !best.exists) return best;
  best.phi2 += peak.gain;
  if (const auto share = peak.share_of_falling()) {
    // On a kink (start of a linear relief, of the wheel's too) the maximum moves along it: continuity of phi2 across it makes
    // the slopes the mean of both sides' that also makes the slope along rho zero.
    const ContactGradient &below = peak.rising->at.angle, &above = peak.falling->at.angle;
    best.slope_z = (1.0 - *share) * slope_inwards(peak.rising->at, below.z) + *share * slope_inwards(peak.falling->at, above.z);
    best.slope_phi1 = (1.0 - *share) * below.phi1 + *share * above.phi1;
    const bool top_is_below = peak.rising->at.rho == m.rho;
    best.beyond = touch_at(top_is_below ? peak.falling->at : peak.rising->at);
    best.share_beyond = top_is_below ? *share : 1.0 - *share;
  }
  return best;
}

SectionMaximum SectionSearch::finish(double z, const FlankContact& m, SectionBound bound) const {
  SectionMaximum best = missing(z);
  // Where the faces do not overlap the wheel's end lies beyond the pinion's.
  best.exists = condition_.assembly().pinion.face.holds(m.z, end_round_off);
  if (!best.exists) return best;
  best.at = m;
  best.bound = bound;
  best.phi2 = condition_.phi2(m);
  // Envelope theorem: how phi2 changes along the path of the maximum (d rho/dz, d rho/d phi1). On a bound that path is exact;
  // inside, the undisturbed one makes an error of second order in the distance from the maximum.
  ContactGradient path{0.0, condition_.roll_rate(), condition_.assembly().pinion.base_radius};
  if (bound == SectionBound::PinionRoot || bound == SectionBound::PinionTip) path = {};
  if (is_on_wheel_circle(bound)) {
    const ContactGradient g = condition_.radius_gradient(m);
    path = {0.0, -g.z / g.rho, -g.phi1 / g.rho};
  }
  const double slope = m.angle.z + m.angle.rho * path.z;
  best.slope_z = slope_inwards(m, slope);
  best.held_by_wheel_end = m.on_wheel_end && best.slope_z != slope;
  best.slope_phi1 = m.angle.phi1 + m.angle.rho * path.phi1;
  return best;
}

/// Takes a point that lies beyond the wheel's tip or form circle to where the section crosses that. False where the section
/// misses the wheel's flank.
bool SectionSearch::move_onto_wheel(double z, const Range& range, const Tolerance& tolerance, FlankContact& m, SectionBound& bound) const {
  const Flank& wheel = condition_.assembly().wheel;
  const bool above_tip = m.wheel_radius > wheel.tip_radius;
  if (!above_tip && m.wheel_radius >= wheel.form_radius) return true;
  bound = above_tip ? SectionBound::WheelTip : SectionBound::WheelRoot;
  const double radius = radius_of(bound);
  const FlankContact start = m;
  if (move_to_radius(z, range, tolerance, radius, m)) return true;
  // Towards the pinion's tip the point approaches the wheel's axis, so its radius is monotone in rho.
  const double far = above_tip ? range.hi : range.lo;
  const double far_excess = condition_.at(far, z, &m).wheel_radius - radius;
  if (above_tip ? far_excess > 0.0 : far_excess < 0.0) return false;
  const auto excess = [&](double rho) { return condition_.at(rho, z, &start).wheel_radius - radius; };
  const Root root = bracketed_root(excess, start.rho, start.wheel_radius - radius, far, far_excess, bound_tolerance);
  m = condition_.at(root.x, z, &start);
  return true;
}

/// Newton on the wheel's radius over rho^2, the arc length of the involute but for a factor. False where that leaves the range
/// or takes more than five steps.
bool SectionSearch::move_to_radius(double z, const Range& range, const Tolerance& tolerance, double radius, FlankContact& m) const {
  for (int i = 0; i < 5; ++i) {
    const double square = m.rho * m.rho - 2.0 * m.rho * (m.wheel_radius - radius) / condition_.radius_gradient(m).rho;
    if (!(square >= range.lo * range.lo && square <= range.hi * range.hi)) return false;
    const double step = std::sqrt(square) - m.rho;
    if (step != 0.0) m = condition_.at(m.rho + step, z, &m);
    if (std::abs(step) <= tolerance.newton) return true;
  }
  return false;
}

}  // namespace flankwright
