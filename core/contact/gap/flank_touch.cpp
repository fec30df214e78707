#include "core/contact/gap/flank_touch.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/peak.hpp"

namespace flankwright {

namespace {

/// Of x [mm], g [mm] and the distance of a kink's two sides [mm]; a step short of the touch costs its square over 2 R.
constexpr PeakTolerance touch_tolerance{1e-8, 1e-15, 1e-8};
constexpr double smooth_step = 1e-6;  // mm: a longer step by the curvature, where the search has ended, shows a kink

double radius_of(const ContactPoint& point, Member m) { return m == Member::Pinion ? point.pinion_radius : point.wheel_radius; }

/// Axial position on the gear's own face: the wheel carries its flank along when it is displaced.
double own_z(const ContactPoint& point, Member m, const Misalignment& misalignment) {
  return m == Member::Pinion ? point.z : point.z - misalignment.axial_offset;
}

/// Towards the wheel's tip is towards the pinion's root.
double towards_own_tip(Member m) { return m == Member::Wheel ? 1.0 : -1.0; }

/// Flanks with the predesigned parabola as the lag that it gives in the plane of action, see removal().
Flank flank_in_plane_of_action(const GearPair& pair, Member m, const FlankCondition& condition) {
  Modification modification = condition.modification[m];
  modification.parabolic_te = 0.0;
  Flank flank = make_flank(pair, m, modification, condition.error[m]);
  flank.modification.parabolic_te = condition.modification[m].parabolic_te;
  return flank;
}

/// Both flanks in the transverse section of a point.
class Section {
 public:
  /// Where the flanks end.
  struct End {
    double x;         ///< [mm]
    double rounding;  ///< radius of the edge [mm], 0: sharp
  };

  Section(const GearPair& pair, const ContactPoint& point, bool before_path) : pair_(pair), point_(point) {
    const double sharp = point.clearance + point.tip_edge.rounded_off;
    // The clearance that two parabolas have at an edge that lies so far from where the involutes would touch.
    if (sharp > 0.0) place_ = (before_path ? -1.0 : 1.0) * std::sqrt(2.0 * point.relative_radius * sharp);
    const End pinion_tip{reach(Member::Pinion, pair.pinion.tip_form_radius), pair.pinion.tip_edge_radius};
    const End wheel_tip{reach(Member::Wheel, pair.wheel.tip_form_radius), pair.wheel.tip_edge_radius};
    const End pinion_root{reach(Member::Pinion, lower_end(pair.pinion)), 0.0}, wheel_root{reach(Member::Wheel, lower_end(pair.wheel)), 0.0};
    upper_ = wheel_tip.x <= pinion_root.x ? wheel_tip : pinion_root;
    lower_ = pinion_tip.x >= wheel_root.x ? pinion_tip : wheel_root;
    const End passed{place_, std::isless(point.tip_edge.distance, 0.0) ? point.tip_edge.radius : 0.0};
    if (place_ < 0.0) upper_ = passed;
    if (place_ > 0.0) lower_ = passed;
    upper_.x = std::max(upper_.x, place_);
    lower_.x = std::min(lower_.x, place_);
  }

  double place() const { return place_; }
  const End& upper() const { return upper_; }
  const End& lower() const { return lower_; }

  double radius(Member m, double x) const {
    const double radius = radius_of(point_, m), rb = pair_[m].base_radius;
    return std::sqrt(std::max(rb * rb, radius * radius + 2.0 * towards_own_tip(m) * rb * (x - place_)));
  }

 private:
  static double lower_end(const Gear& gear) { return std::max(gear.base_radius, gear.form_radius); }
  double reach(Member m, double end) const {
    const double radius = radius_of(point_, m);
    return place_ + towards_own_tip(m) * (end - radius) * (end + radius) / (2.0 * pair_[m].base_radius);
  }

  const GearPair& pair_;
  const ContactPoint& point_;
  double place_{0.0};  ///< of the point, x [mm]
  End lower_, upper_;
};

/// h(x) = h + slope dx + curvature dx^2/2 [mm], and with it the gap of both parabolas as find_peak() asks for it, upside down.
struct Sample {
  double x, relative_radius;
  ToothDeviation::AlongProfile h;

  double position() const { return x; }
  double value() const { return -(0.5 * x * x / relative_radius + h.value); }
  double slope() const { return -(x / relative_radius + h.slope); }
};

FlankTouch::Side side_at(const Section& section, double x, double share) {
  return {{section.radius(Member::Pinion, x), section.radius(Member::Wheel, x)}, share};
}

/// Where the parabola's vertex is, and the touch with it.
/// @param deviation_at  h at x
template <class Deviation>
FlankTouch touch_in(const Section& section, double relative_radius, const Deviation& deviation_at) {
  const auto evaluate = [&](double x, const Sample*) { return Sample{x, relative_radius, deviation_at(x)}; };
  const Peak<Sample> peak =
      find_peak<Sample>(evaluate, section.lower().x, section.upper().x, section.place(), 1.0 / relative_radius, touch_tolerance);
  const Sample& top = peak.top;
  FlankTouch touch;
  touch.sides[0] = side_at(section, top.x, 1.0);
  if (peak.at_end) {
    // Straight on beyond the edge, where the rounding keeps off.
    const Section::End& edge = top.slope() > 0.0 ? section.upper() : section.lower();
    const double vertex = -relative_radius * top.h.slope, beyond = vertex - edge.x, both = relative_radius + edge.rounding;
    touch.gap = top.h.value + top.h.slope * beyond + 0.5 * vertex * vertex / relative_radius + 0.5 * beyond * beyond / both;
    touch.along = vertex;
    touch.along_by_slope = -relative_radius;
    touch.on_rounding = beyond * edge.rounding / both;
    touch.rounded_off = 0.5 * beyond * touch.on_rounding / relative_radius;
    return touch;
  }
  touch.gap = -(top.value() + peak.gain);
  touch.along = top.x;
  // Near a smooth vertex a step by the curvature leads to it, on a kink far away.
  const double curvature = 1.0 / relative_radius + top.h.curvature, step = top.slope() / curvature;
  const auto falling = peak.share_of_falling();
  if (!falling || std::abs(step) <= smooth_step) {
    touch.along += step;
    touch.sides[0] = side_at(section, touch.along, 1.0);
    touch.along_by_slope = -1.0 / curvature;
    return touch;
  }
  touch.sides[0] = side_at(section, peak.rising->x, 1.0 - *falling);
  touch.sides[1] = side_at(section, peak.falling->x, *falling);
  return touch;
}

}  // namespace

FlankTouchSearch::FlankTouchSearch(const GearPair& pair, const FlankCondition& condition)
    : pair_(pair),
      path_(pair),
      misalignment_(condition.misalignment),
      flanks_{flank_in_plane_of_action(pair, Member::Pinion, condition), flank_in_plane_of_action(pair, Member::Wheel, condition)} {}

std::vector<FlankTouch> FlankTouchSearch::at(const std::vector<ContactPoint>& points) const {
  const double cos_base_helix = std::cos(pair_.base_helix_angle);
  std::vector<FlankTouch> touches;
  touches.reserve(points.size());
  std::optional<ToothDeviation> pinion, wheel;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& point = points[i];
    if (i == 0 || point.tooth != points[i - 1].tooth) {
      pinion.emplace(flanks_.pinion, point.tooth);
      wheel.emplace(flanks_.wheel, point.tooth);
    }
    const double pinion_z = own_z(point, Member::Pinion, misalignment_), wheel_z = own_z(point, Member::Wheel, misalignment_);
    const auto both = [&](double pinion_radius, double wheel_radius) {
      const auto p = pinion->at(pinion_radius, pinion_z), w = wheel->at(wheel_radius, wheel_z);
      return ToothDeviation::AlongProfile{cos_base_helix * (p.value + w.value), cos_base_helix * (w.slope - p.slope),
                                          cos_base_helix * (p.curvature + w.curvature)};
    };
    if (!std::isgreater(point.relative_radius, 0.0)) {
      touches.push_back({.gap = point.clearance + both(point.pinion_radius, point.wheel_radius).value,
                         .sides = {FlankTouch::Side{{point.pinion_radius, point.wheel_radius}, 1.0}}});
      continue;
    }
    const Section section(pair_, point, path_.roll_at(point.phase) < pair_.path_start);
    touches.push_back(touch_in(section, point.relative_radius,
                               [&](double x) { return both(section.radius(Member::Pinion, x), section.radius(Member::Wheel, x)); }));
  }
  return touches;
}

TouchDerivative::TouchDerivative(const GearPair& pair, const FlankCondition& condition, Member member, ModificationParameter parameter)
    : pair_(pair),
      misalignment_(condition.misalignment),
      member_(member),
      removed_(ground_derivative(pair, member, condition.modification[member], parameter)) {}

/// d(dh/dx)/dp, by a central difference over the radius.
double TouchDerivative::slope_along(const ContactPoint& point, const FlankTouch& touch) const {
  const double step = 1e-3 * pair_.data.normal_module, radius = touch.sides[0].radius[member_], z = own_z(point, member_, misalignment_);
  const double by_radius = (removed_.at(radius + step, z) - removed_.at(radius - step, z)) / (2.0 * step);
  return std::cos(pair_.base_helix_angle) * towards_own_tip(member_) * pair_[member_].base_radius / radius * by_radius;
}

double TouchDerivative::of_rounding(const ContactPoint& point, const FlankTouch& touch) const {
  return touch.on_rounding == 0.0 ? 0.0 : touch.on_rounding * slope_along(point, touch);
}

double TouchDerivative::of_gap(const ContactPoint& point, const FlankTouch& touch) const {
  const double z = own_z(point, member_, misalignment_);
  double removed = 0.0;
  for (const FlankTouch::Side& side : touch.sides) {
    if (side.share != 0.0) removed += side.share * removed_.at(side.radius[member_], z);
  }
  return std::cos(pair_.base_helix_angle) * removed + of_rounding(point, touch);
}

double TouchDerivative::of_edge(const ContactPoint& point, const FlankTouch& touch) const {
  const double towards_edge = towards_own_tip(point.tip_edge.gear);
  return touch.along_by_slope == 0.0 ? 0.0 : -towards_edge * touch.along_by_slope * slope_along(point, touch);
}

double edge_moved_by(const ContactPoint& point, const FlankTouch& touch) { return -towards_own_tip(point.tip_edge.gear) * touch.along; }

}  // namespace flankwright
