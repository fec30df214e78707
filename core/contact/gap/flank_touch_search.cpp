#include "core/contact/gap/flank_touch_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/peak.hpp"
#include "core/contact/path/passed_edge.hpp"

namespace flankwright {

namespace {

/// Newton's last step [relative radius]: it is taken, and leaves a share of it by which the curvature is off.
constexpr double last_step = 3e-8;
/// More are needed only where slopes jump.
constexpr int most_newton_steps = 5;
/// Of x, of g and of the distance of a kink's two sides [mm].
PeakTolerance kink_tolerance(double relative_radius) { return {3e-10 * relative_radius, 3e-17 * relative_radius, 3e-10 * relative_radius}; }

double radius_of(const ContactPoint& point, Member m) { return m == Member::Pinion ? point.pinion_radius : point.wheel_radius; }

/// Axial position on the gear's own face: the wheel carries its flank along when it is displaced.
double own_z(const ContactPoint& point, Member m, const Misalignment& misalignment) {
  return m == Member::Pinion ? point.z : point.z - misalignment.axial_offset;
}

/// Towards the wheel's tip is towards the pinion's root.
double towards_own_tip(Member m) { return m == Member::Wheel ? 1.0 : -1.0; }

Flank without_parabola(const GearPair& pair, Member m, const FlankCondition& condition) {
  Modification modification = condition.modification[m];
  modification.parabolic_te = 0.0;
  return make_flank(pair, m, modification, condition.error[m]);
}

Flank parabola_alone(const GearPair& pair, Member m, const FlankCondition& condition) {
  Flank flank = make_flank(pair, m, {}, {});
  flank.fields.clear();  // of the generation: without_parabola() has it
  flank.modification.parabolic_te = condition.modification[m].parabolic_te;
  return flank;
}

/// The part of a misalignment by which the wheel is displaced since the points were made.
Misalignment less(Misalignment all, const Misalignment& placed) {
  all.crossing -= placed.crossing;
  all.intersecting -= placed.intersecting;
  all.centre_distance -= placed.centre_distance;
  return all;
}

double curvature_radius(const ContactPoint& point, Member m, double base_radius) {
  const double radius = radius_of(point, m);
  return std::sqrt(std::max(0.0, (radius - base_radius) * (radius + base_radius)));
}

/// Both flanks in the transverse section of a point.
class Section {
 public:
  /// Where the flanks end.
  struct End {
    double x;         ///< [mm]
    double rounding;  ///< radius of the edge [mm], 0: sharp
  };

  /// The wheel's displacement in the section [mm].
  struct Displacement {
    double along_profile, along_action;
  };

  Section(const GearPair& pair, const ContactPoint& point, bool before_path, const Displacement& displacement) : pair_(pair), point_(point) {
    const double sharp = point.clearance + point.tip_edge.rounded_off;
    if (sharp > 0.0) place_ = (before_path ? -1.0 : 1.0) * PassedEdge::beyond(sharp, point.relative_radius);
    if (displacement.along_profile != 0.0 || displacement.along_action != 0.0) {
      const double rho_1 = curvature_radius(point, Member::Pinion, pair.pinion.base_radius);
      const double rho_2 = curvature_radius(point, Member::Wheel, pair.wheel.base_radius);
      const double s = displacement.along_profile, sum = rho_1 + rho_2;
      slid_ = {s * rho_1 / sum, -s * rho_2 / sum + displacement.along_action * rho_2 / pair.wheel.base_radius};
      opened_ = 0.5 * std::cos(pair.base_helix_angle) * s * s / sum;
    }
    const End pinion_tip{reach(Member::Pinion, pair.pinion.tip_form_radius), pair.pinion.tip_edge_radius};
    const End wheel_tip{reach(Member::Wheel, pair.wheel.tip_form_radius), pair.wheel.tip_edge_radius};
    const End pinion_root{reach(Member::Pinion, lower_end(pair.pinion)), 0.0}, wheel_root{reach(Member::Wheel, lower_end(pair.wheel)), 0.0};
    upper_ = wheel_tip.x <= pinion_root.x ? wheel_tip : pinion_root;
    lower_ = pinion_tip.x >= wheel_root.x ? pinion_tip : wheel_root;
    if (lower_.x > upper_.x) lower_.x = upper_.x = 0.5 * (lower_.x + upper_.x);  // edges that pass each other
  }

  /// Where the involutes touch, or on the edge that keeps them from it.
  double start() const { return std::clamp(place_, lower_.x, upper_.x); }
  const PerGear<double>& slid() const { return slid_; }
  double opened() const { return opened_; }
  const End& upper() const { return upper_; }
  const End& lower() const { return lower_; }

  double radius(Member m, double x) const {
    const double radius = radius_of(point_, m), rb = pair_[m].base_radius;
    return std::sqrt(std::max(rb * rb, radius * radius + 2.0 * towards_own_tip(m) * rb * (x + slid_[m] - place_)));
  }

 private:
  static double lower_end(const Gear& gear) { return std::max(gear.base_radius, gear.form_radius); }
  double reach(Member m, double end) const {
    const double radius = radius_of(point_, m);
    return place_ - slid_[m] + towards_own_tip(m) * (end - radius) * (end + radius) / (2.0 * pair_[m].base_radius);
  }

  const GearPair& pair_;
  const ContactPoint& point_;
  double place_{0.0};               ///< of the point on both flanks [mm]
  PerGear<double> slid_{0.0, 0.0};  ///< place on either flank less x [mm]
  double opened_{0.0};              ///< by the displacement along the profile [mm]
  End lower_, upper_;
};

using AlongProfile = ToothDeviation::AlongProfile;

/// h with its derivatives by x.
struct Deviation {
  AlongProfile h;
  double by_lag{0.0}, by_lag_change{0.0};

  /// What the flank with a lag L deviates by; the third derivative of L is left out of the curvature.
  void add_lag(const AlongProfile& lag, double relative_radius) {
    by_lag = relative_radius * lag.slope;
    by_lag_change = relative_radius * lag.curvature;
    h.value += lag.value + 0.5 * by_lag * lag.slope;
    h.slope += lag.slope + by_lag * lag.curvature;
    h.curvature += lag.curvature + relative_radius * lag.curvature * lag.curvature;
  }
};

/// The gap of both parabolas and the deviations at x as find_peak() asks for it, upside down.
struct Sample {
  double x, relative_radius;
  AlongProfile h;
  double by_lag, by_lag_change;

  double position() const { return x; }
  double value() const { return -(0.5 * x * x / relative_radius + h.value); }
  double slope() const { return -(x / relative_radius + h.slope); }
  double curvature() const { return 1.0 / relative_radius + h.curvature; }
};

FlankTouch::Side side_at(const Section& section, double x, double share) {
  return {{section.radius(Member::Pinion, x), section.radius(Member::Wheel, x)}, share};
}

/// Straight on beyond the edge, where the rounding keeps off.
FlankTouch touch_beyond(const Section& section, const Sample& top) {
  const Section::End& edge = top.slope() > 0.0 ? section.upper() : section.lower();
  const double R = top.relative_radius, vertex = -R * top.h.slope, beyond = vertex - edge.x;
  const PassedEdge passed = PassedEdge::at(beyond, R, edge.rounding);
  FlankTouch touch;
  touch.sides[0] = side_at(section, top.x, 1.0);
  touch.gap = top.h.value + top.h.slope * beyond + 0.5 * vertex * vertex / R + passed.rounded;
  touch.along = vertex;
  touch.along_by_slope = -R;
  touch.on_rounding = beyond * edge.rounding / (R + edge.rounding);
  touch.rounded_off = passed.rounded_off;
  touch.by_lag = top.by_lag;
  touch.by_lag_change = top.by_lag_change;
  return touch;
}

/// A step short of the vertex.
FlankTouch touch_near(const Section& section, const Sample& top, double step) {
  FlankTouch touch;
  touch.along = top.x + step;
  touch.sides[0] = side_at(section, touch.along, 1.0);
  touch.gap = -(top.value() + 0.5 * step * top.slope());
  touch.along_by_slope = -1.0 / top.curvature();
  touch.by_lag = top.by_lag;
  touch.by_lag_change = top.by_lag_change;
  return touch;
}

FlankTouch touch_on_kink(const Section& section, const Peak<Sample>& peak, double share_of_falling) {
  FlankTouch touch;
  touch.along = peak.top.x;
  touch.sides[0] = side_at(section, peak.rising->x, 1.0 - share_of_falling);
  touch.sides[1] = side_at(section, peak.falling->x, share_of_falling);
  touch.gap = -peak.top.value();
  touch.by_lag = peak.top.by_lag;
  return touch;
}

/// Where the parabola's vertex is, and the touch with it. Newton's steps find it in two or three evaluations where slopes do not jump.
/// @param deviation_at  h at x
template <class DeviationAt>
FlankTouch touch_in(const Section& section, double relative_radius, const DeviationAt& deviation_at) {
  const double lower = section.lower().x, upper = section.upper().x;
  const auto evaluate = [&](double x, const Sample*) {
    const Deviation d = deviation_at(x);
    return Sample{x, relative_radius, d.h, d.by_lag, d.by_lag_change};
  };
  const auto points_beyond = [&](const Sample& s) { return s.slope() > 0.0 ? s.x >= upper : s.slope() < 0.0 && s.x <= lower; };
  Sample top = evaluate(section.start(), nullptr);
  for (int steps = 0; top.curvature() > 0.0 && steps < most_newton_steps; ++steps) {
    if (points_beyond(top)) return touch_beyond(section, top);
    const double step = top.slope() / top.curvature();
    if (std::abs(step) <= last_step * relative_radius) return touch_near(section, top, step);
    top = evaluate(std::clamp(top.x + step, lower, upper), nullptr);
  }
  const Peak<Sample> peak = find_peak<Sample>(evaluate, lower, upper, section.start(), 1.0 / relative_radius, kink_tolerance(relative_radius));
  if (peak.at_end) return touch_beyond(section, peak.top);
  // Near a smooth vertex a step by the curvature leads to it, on a kink far away.
  const double step = peak.top.slope() / peak.top.curvature();
  const auto share_of_falling = peak.share_of_falling();
  if (!share_of_falling || std::abs(step) <= last_step * relative_radius) return touch_near(section, peak.top, step);
  return touch_on_kink(section, peak, *share_of_falling);
}

}  // namespace

FlankTouchSearch::FlankTouchSearch(const GearPair& pair, const FlankCondition& condition, const Misalignment& placed)
    : pair_(pair),
      path_(pair),
      misalignment_(condition.misalignment),
      displaced_(pair, less(condition.misalignment, placed)),
      flanks_{without_parabola(pair, Member::Pinion, condition), without_parabola(pair, Member::Wheel, condition)},
      lags_{parabola_alone(pair, Member::Pinion, condition), parabola_alone(pair, Member::Wheel, condition)},
      has_lag_(condition.modification.pinion.parabolic_te != 0.0 || condition.modification.wheel.parabolic_te != 0.0) {}

FlankTouchSearch::OnTooth::OnTooth(const FlankTouchSearch& search, int tooth)
    : search_(search), deviations_{{search.flanks_.pinion, tooth}, {search.flanks_.wheel, tooth}} {
  if (search.has_lag_) lags_.emplace(Teeth{{search.lags_.pinion, tooth}, {search.lags_.wheel, tooth}});
}

FlankTouch FlankTouchSearch::OnTooth::at(const ContactPoint& point) const {
  const GearPair& pair = search_.pair_;
  const double cos_base_helix = std::cos(pair.base_helix_angle);
  const double pinion_z = own_z(point, Member::Pinion, search_.misalignment_), wheel_z = own_z(point, Member::Wheel, search_.misalignment_);
  const auto along = [&](const Teeth& of, double pinion_radius, double wheel_radius) {
    const AlongProfile p = of.pinion.at(pinion_radius, pinion_z), w = of.wheel.at(wheel_radius, wheel_z);
    return AlongProfile{cos_base_helix * (p.value + w.value), cos_base_helix * (w.slope - p.slope), cos_base_helix * (p.curvature + w.curvature)};
  };
  if (!std::isgreater(point.relative_radius, 0.0)) {
    double h = along(deviations_, point.pinion_radius, point.wheel_radius).value;
    if (lags_) h += along(*lags_, point.pinion_radius, point.wheel_radius).value;
    return {.gap = point.clearance + h, .sides = {FlankTouch::Side{{point.pinion_radius, point.wheel_radius}, 1.0}}};
  }
  const WheelDisplacement& displaced = search_.displaced_;
  const Section section(pair, point, search_.path_.roll_at(point.phase) < pair.path_start,
                        {displaced.along_profile(point.z), displaced.along_action(point.z)});
  FlankTouch touch = touch_in(section, point.relative_radius, [&](double x) {
    const double pinion_radius = section.radius(Member::Pinion, x), wheel_radius = section.radius(Member::Wheel, x);
    Deviation d{along(deviations_, pinion_radius, wheel_radius)};
    if (lags_) d.add_lag(along(*lags_, pinion_radius, wheel_radius), point.relative_radius);
    return d;
  });
  touch.gap += section.opened();
  touch.slid = section.slid();
  return touch;
}

std::vector<FlankTouch> FlankTouchSearch::at(const std::vector<ContactPoint>& points) const {
  std::vector<FlankTouch> touches;
  touches.reserve(points.size());
  std::optional<OnTooth> search;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == 0 || points[i].tooth != points[i - 1].tooth) search.emplace(*this, points[i].tooth);
    touches.push_back(search->at(points[i]));
  }
  return touches;
}

TouchDerivative::TouchDerivative(const GearPair& pair, const FlankCondition& condition, Member member, ModificationParameter parameter)
    : pair_(pair),
      misalignment_(condition.misalignment),
      member_(member),
      of_lag_(parameter == parameter_of("parabolic_te")),
      removed_(ground_derivative(pair, member, condition.modification[member], parameter, condition.other_flanks)) {}

/// A lag's curvature along the profile is a central difference of its slopes over this [mm].
constexpr double lag_step = 1e-3;

/// dh/dp and d(dh/dx)/dp on one side of a touch, less what a lag adds.
TouchDerivative::Slopes TouchDerivative::slopes(const ContactPoint& point, const FlankTouch::Side& side) const {
  const double radius = side.radius[member_], cos_base_helix = std::cos(pair_.base_helix_angle);
  const RemovalDerivative::WithSlope removed = removed_.with_slope(radius, own_z(point, member_, misalignment_));
  return {cos_base_helix * removed.value, cos_base_helix * towards_own_tip(member_) * pair_[member_].base_radius / radius * removed.slope};
}

double TouchDerivative::of_rounding(const ContactPoint& point, const FlankTouch& touch) const {
  return touch.on_rounding == 0.0 ? 0.0 : touch.on_rounding * slopes(point, touch.sides[0]).slope;
}

double TouchDerivative::of_gap(const ContactPoint& point, const FlankTouch& touch) const {
  const double by_slope = touch.on_rounding + (of_lag_ ? touch.by_lag : 0.0), z = own_z(point, member_, misalignment_);
  double sum = 0.0;
  for (const FlankTouch::Side& side : touch.sides) {
    if (side.share == 0.0) continue;
    if (by_slope == 0.0) {
      sum += side.share * std::cos(pair_.base_helix_angle) * removed_.at(side.radius[member_], z);
    } else {
      const Slopes h = slopes(point, side);
      sum += side.share * (h.value + by_slope * h.slope);
    }
  }
  return sum;
}

double TouchDerivative::of_edge(const ContactPoint& point, const FlankTouch& touch) const {
  if (touch.along_by_slope == 0.0) return 0.0;
  const FlankTouch::Side& side = touch.sides[0];
  double slope = slopes(point, side).slope;
  if (of_lag_) {  // of h' = L' + R L' L''
    FlankTouch::Side before = side, beyond = side;
    const double along = lag_step * towards_own_tip(member_) * pair_[member_].base_radius / side.radius[member_];
    before.radius[member_] -= along;
    beyond.radius[member_] += along;
    const double curvature = (slopes(point, beyond).slope - slopes(point, before).slope) / (2.0 * lag_step);
    slope += slope * touch.by_lag_change + touch.by_lag * curvature;
  }
  return -towards_own_tip(point.tip_edge.gear) * touch.along_by_slope * slope;
}

}  // namespace flankwright
