#include "core/gear/tooth_form.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/root.hpp"
#include "core/base/units.hpp"

namespace flankwright {
namespace {

using units::pi;

[[noreturn]] void reject(const char* field, double value, const std::string& allowed) { throw InvalidInput(field, std::to_string(value), allowed); }

/// Where the increasing or decreasing f changes sign between a and b, to the last few bits; without a change of sign
/// the end where f is nearest to zero, so that a radius that misses an end by round-off finds that end.
template <typename F>
double crossing(F&& f, double a, double b) {
  const double fa = f(a), fb = f(b);
  if ((fa > 0) == (fb > 0) && fa != 0 && fb != 0) return std::abs(fa) < std::abs(fb) ? a : b;
  const double tolerance = 2 * std::numeric_limits<double>::epsilon() * std::max(std::abs(a), std::abs(b));
  return bracketed_root(f, a, fa, b, fb, tolerance).x;
}

}  // namespace

double full_tip_rounding(double dedendum, double pressure_angle) {
  return (pi / 4 - dedendum * std::tan(pressure_angle)) * std::cos(pressure_angle) / (1 - std::sin(pressure_angle));
}

double generating_profile_shift(const GearData& gear, double normal_module, double pressure_angle) {
  return gear.profile_shift + gear.tooth_thickness_allowance / (2 * normal_module * std::tan(pressure_angle));
}

GearData as_generated(GearData gear, double normal_module, double pressure_angle) {
  const double nominal = std::exchange(gear.profile_shift, generating_profile_shift(gear, normal_module, pressure_angle));
  gear.tooth_thickness_allowance = 0;
  gear.rack.addendum += nominal - gear.profile_shift;
  return gear;
}

ToothForm::ToothForm(NoTip, const GearData& gear, double normal_module, double pressure_angle, double helix_angle) : helix_angle_(helix_angle) {
  if (gear.teeth < 5) reject("teeth", gear.teeth, "an integer of at least 5");
  if (!(normal_module > 0) || !std::isfinite(normal_module)) reject("normal_module", normal_module, "more than 0 mm");
  if (!(pressure_angle > 0 && pressure_angle < pi / 4)) {
    reject("pressure_angle", pressure_angle / units::deg, "more than 0 and less than 45 deg");
  }
  if (!(helix_angle >= 0 && helix_angle < pi / 3)) {
    reject("helix_angle", helix_angle / units::deg, "at least 0 and less than 60 deg");
  }
  if (!std::isfinite(gear.profile_shift)) reject("profile_shift", gear.profile_shift, "a finite number");
  if (!std::isfinite(gear.tooth_thickness_allowance)) reject("tooth_thickness_allowance", gear.tooth_thickness_allowance, "a finite number");

  const double h = gear.rack.dedendum;
  const double rho = gear.rack.root_radius;
  const double largest = full_tip_rounding(h, pressure_angle);
  if (!(h > 0 && largest >= 0)) {
    reject("rack.dedendum", h, "more than 0 and at most " + std::to_string(pi / 4 / std::tan(pressure_angle)) + ", where the tool is pointed");
  }
  // A full rounding is usually given to a few digits; the excess allowed is round-off.
  constexpr double kRoundOff = 1e-12;
  if (!(rho >= 0 && rho <= largest + kRoundOff)) {
    reject("rack.root_radius", rho, "from 0 to the tool's full tip rounding, " + std::to_string(largest));
  }

  const double cos_beta = std::cos(helix_angle);
  transverse_pressure_angle_ = std::atan(std::tan(pressure_angle) / cos_beta);
  reference_radius_ = gear.teeth * normal_module / (2 * cos_beta);
  base_radius_ = reference_radius_ * std::cos(transverse_pressure_angle_);
  const double tan_alpha_t = std::tan(transverse_pressure_angle_);
  const double shift = generating_profile_shift(gear, normal_module, pressure_angle);
  base_half_angle_ = (pi / 2 + 2 * shift * std::tan(pressure_angle)) / gear.teeth + tan_alpha_t - transverse_pressure_angle_;
  rounding_ = rho * normal_module;
  tool_depth_ = (h - shift) * normal_module;
  rounding_centre_ =
      (pi / 4 + h * std::tan(pressure_angle) + rho * (1 - std::sin(pressure_angle)) / std::cos(pressure_angle)) * normal_module / cos_beta;
  root_radius_ = reference_radius_ - tool_depth_;
  if (!(root_radius_ > 0)) reject("rack.dedendum", h, "less than leaves the root circle a positive radius");
  locate_form_radius();
  if (undercut_ && !(waist() > 0)) {
    reject("profile_shift", gear.profile_shift, "large enough that the undercut from both sides does not sever the tooth");
  }
}

ToothForm::ToothForm(const GearData& gear, double normal_module, double pressure_angle, double helix_angle)
    : ToothForm(NoTip{}, gear, normal_module, pressure_angle, helix_angle) {
  tip_radius_ = std::isnan(gear.tip_diameter) ? reference_radius_ + (gear.rack.addendum + gear.profile_shift) * normal_module : gear.tip_diameter / 2;
  if (!(tip_radius_ > form_radius_) || !std::isfinite(tip_radius_)) {
    reject("tip_diameter", 2 * tip_radius_, "more than the form diameter, " + std::to_string(2 * form_radius_) + " mm");
  }
}

GeneratedProfile generated_profile(const GearData& gear, double normal_module, double pressure_angle, double helix_angle) {
  const ToothForm form(ToothForm::NoTip{}, gear, normal_module, pressure_angle, helix_angle);
  return {form.form_radius_, form.root_radius_, form.undercut_};
}

ToothForm::Trochoid ToothForm::trochoid(double lambda) const {
  const double cos_beta = std::cos(helix_angle_);
  // lambda_n from its sine and cosine, which stay finite at lambda = pi/2.
  const double lambda_n = std::atan2(std::sin(lambda) * cos_beta, std::cos(lambda));
  const double depth = tool_depth_ - rounding_ * (1 - std::sin(lambda_n));
  const double theta =
      (rounding_centre_ + depth * std::cos(lambda) / std::sin(lambda) - rounding_ * std::cos(lambda_n) / cos_beta) / reference_radius_;
  return {depth, theta};
}

ProfilePoint ToothForm::fillet_point(double lambda) const {
  const auto [depth, theta] = trochoid(lambda);
  const double distance = depth / std::sin(lambda);  // from the pitch point, along the common normal
  return {reference_radius_ * std::sin(theta) - distance * std::cos(theta - lambda),
          reference_radius_ * std::cos(theta) + distance * std::sin(theta - lambda), lambda - theta};
}

double ToothForm::fillet_rise(double lambda) const {
  const auto [depth, theta] = trochoid(lambda);
  const double cos_beta = std::cos(helix_angle_), sine = std::sin(lambda), cosine = std::cos(lambda);
  const double length = std::hypot(sine * cos_beta, cosine);  // of (sin, cos) lambda_n before scaling
  const double by_lambda = cos_beta / (length * length);      // d(lambda_n)/d(lambda)
  const double depth_slope = rounding_ * cosine / length * by_lambda;
  const double theta_slope = (depth_slope * cosine / sine - depth / (sine * sine) + rounding_ * sine / length * by_lambda) / reference_radius_;
  const double downwards = reference_radius_ * theta_slope * sine - depth / sine * (theta_slope - 1);  // along the tangent
  return -downwards * std::cos(lambda - theta);
}

double ToothForm::fillet_radius(double lambda) const {
  const double depth = trochoid(lambda).depth;
  return std::hypot(reference_radius_ - depth, depth * std::cos(lambda) / std::sin(lambda));
}

double ToothForm::roll_length(double radius) const { return std::sqrt(std::max(0.0, (radius - base_radius_) * (radius + base_radius_))); }

double ToothForm::involute_half_angle(double roll_length) const {
  const double roll_angle = roll_length / base_radius_;
  return base_half_angle_ - (roll_angle - std::atan(roll_angle));
}

ProfilePoint ToothForm::involute_point(double roll_length) const {
  const double radius = std::hypot(base_radius_, roll_length);
  const double half_angle = involute_half_angle(roll_length);
  return {radius * std::sin(half_angle), radius * std::cos(half_angle), std::atan(roll_length / base_radius_) - half_angle};
}

double ToothForm::involute_rise(double roll_length) const { return roll_length / base_radius_ * std::cos(involute_point(roll_length).tangent_angle); }

void ToothForm::locate_form_radius() {
  // The tool's flank ends at depth d: it cuts the involute down to the roll length r sin(alpha_t) - d / sin(alpha_t).
  const double alpha_t = transverse_pressure_angle_;
  const double start = reference_radius_ * std::sin(alpha_t) - trochoid(alpha_t).depth / std::sin(alpha_t);
  undercut_ = start < 0;
  fillet_start_ = alpha_t;
  form_radius_ = std::hypot(base_radius_, start);
  if (!undercut_) return;

  // The fillet rises from inside the base circle, cuts off the foot of the involute and leaves the tooth where its half
  // angle exceeds the involute's, which at lambda = alpha_t it does by twice the involute function.
  const double at_base = crossing([&](double l) { return fillet_radius(l) - base_radius_; }, pi / 2, alpha_t);
  const auto excess = [&](double lambda) {
    const ProfilePoint p = fillet_point(lambda);
    return std::atan2(p.x, p.y) - involute_half_angle(roll_length(std::hypot(p.x, p.y)));
  };
  // An undercut too slight to be resolved (excess of the order of the cube of the lost roll length) starts at the base
  // circle to within round-off, and any point between the two is as good.
  fillet_start_ = crossing(excess, at_base, alpha_t);
  form_radius_ = std::max(base_radius_, fillet_radius(fillet_start_));
}

double ToothForm::waist() const { return root_tangent_point(0).x; }

double ToothForm::half_angle(double radius) const {
  const ProfilePoint p = at_radius(radius);
  return std::atan2(p.x, p.y);
}

ProfilePoint ToothForm::at_radius(double radius) const {
  if (radius >= form_radius_) return involute_point(roll_length(radius));
  return fillet_point(crossing([&](double lambda) { return fillet_radius(lambda) - radius; }, pi / 2, fillet_start_));
}

double ToothForm::fillet_at_height(double y) const {
  return crossing([&](double lambda) { return fillet_point(lambda).y - y; }, pi / 2, fillet_start_);
}

double ToothForm::involute_at_height(double y) const {
  return crossing([&](double roll) { return involute_point(roll).y - y; }, involute_start(), roll_length(tip_radius_));
}

ProfilePoint ToothForm::at_height(double y) const {
  const bool on_involute = y >= involute_point(involute_start()).y;
  return on_involute ? involute_point(involute_at_height(y)) : fillet_point(fillet_at_height(y));
}

ProfilePoint ToothForm::root_tangent_point(double normal_tangent_angle) const {
  const double wanted = std::atan(std::tan(normal_tangent_angle) / std::cos(helix_angle_));
  const auto excess = [&](double lambda) { return fillet_point(lambda).tangent_angle - wanted; };
  if (excess(fillet_start_) >= 0) return fillet_point(fillet_start_);
  return fillet_point(crossing(excess, fillet_start_, pi / 2));
}

std::vector<ProfilePoint> ToothForm::profile(int points) const {
  assert(points >= 4);
  const int on_fillet = points / 2;
  const int on_involute = points - on_fillet;
  std::vector<ProfilePoint> result;
  result.reserve(static_cast<std::size_t>(points));
  for (int i = 0; i < on_fillet; ++i) {
    result.push_back(fillet_point(pi / 2 + (fillet_start_ - pi / 2) * i / on_fillet));
  }
  const double first = roll_length(form_radius_);
  const double last = roll_length(tip_radius_);
  for (int i = 0; i < on_involute; ++i) {
    result.push_back(involute_point(first + (last - first) * i / (on_involute - 1)));
  }
  return result;
}

}  // namespace flankwright
