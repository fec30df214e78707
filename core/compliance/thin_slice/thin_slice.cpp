#include "core/compliance/thin_slice/thin_slice.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "core/compliance/local/contact_law.hpp"
#include "core/compliance/local/hertz_line.hpp"
#include "core/compliance/thin_slice/tooth_bending.hpp"

namespace flankwright {
namespace {

/// Line load at which ISO's stiffness is taken [N/mm].
constexpr double kReferenceLoad = 300;

double roll_length(double radius, double base_radius) { return std::sqrt(std::max(0.0, (radius - base_radius) * (radius + base_radius))); }

/// c(w)/w at the pinion's roll length rho_1, depths to the tooth centre planes, without tip factor [mm^2/N].
double hertz_compliance(const GearPair& pair, const Material& pinion, const Material& wheel, double rho_1) {
  const double cos_base = std::cos(pair.base_helix_angle);
  const double rho_2 = pair.path_length - rho_1;
  const auto side = [&](Member member, const Material& material, double rho) {
    const Gear& gear = pair[member];
    const double radius = std::hypot(gear.base_radius, rho);
    const double cos_alpha = gear.base_radius / radius;
    return ContactSide::of(material, gear.tooth_thickness_at(radius) / 2 * cos_base / cos_alpha);
  };
  const double relative_radius = rho_1 * rho_2 / (rho_1 + rho_2) / cos_base;
  const ContactLaw law(side(Member::Pinion, pinion, rho_1), side(Member::Wheel, wheel, rho_2), relative_radius, contact_modulus(pinion, wheel));
  return law.deflection(kReferenceLoad) / kReferenceLoad;
}

}  // namespace

ToothForm tooth_form(const GearPair& pair, Member member) {
  GearData gear = pair.data[member];
  gear.tip_diameter = 2 * pair[member].tip_radius;
  return ToothForm(gear, pair.data.normal_module, pair.data.pressure_angle, pair.data.helix_angle);
}

ThinSlice::Table::Table(const ToothForm& form, const Material& material)
    : base_radius(form.base_radius()),
      first_roll(roll_length(form.form_radius(), base_radius)),
      last_roll(roll_length(form.tip_radius(), base_radius)) {
  const auto& f = values;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double roll = first_roll + (last_roll - first_roll) * static_cast<double>(i) / (kNodes - 1);
    const double radius = std::clamp(std::hypot(base_radius, roll), form.form_radius(), form.tip_radius());
    values[i] = tooth_compliance(form, radius, material.poissons_ratio).total() / material.youngs_modulus;
  }
  // Five-point differences per interval, central but for the two nodes at each end.
  for (std::size_t i = 2; i + 2 < kNodes; ++i) slopes[i] = (f[i - 2] - 8 * f[i - 1] + 8 * f[i + 1] - f[i + 2]) / 12;
  const auto end = [&](std::size_t first, bool forwards) {
    const auto at = [&](std::size_t i) { return f[forwards ? first + i : first - i]; };
    const double sign = forwards ? 1 : -1;
    slopes[first] = sign * (-25 * at(0) + 48 * at(1) - 36 * at(2) + 16 * at(3) - 3 * at(4)) / 12;
    slopes[forwards ? first + 1 : first - 1] = sign * (-3 * at(0) - 10 * at(1) + 18 * at(2) - 6 * at(3) + at(4)) / 12;
  };
  end(0, true);
  end(kNodes - 1, false);
}

double ThinSlice::Table::operator()(double radius) const {
  const double roll = std::clamp(roll_length(radius, base_radius), first_roll, last_roll);
  const double position = (roll - first_roll) / (last_roll - first_roll) * (kNodes - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(position), kNodes - 2);
  const double t = position - static_cast<double>(i);
  const double u = 1 - t;
  return u * u * ((1 + 2 * t) * values[i] + t * slopes[i]) + t * t * ((1 + 2 * u) * values[i + 1] - u * slopes[i + 1]);
}

ThinSlice::ThinSlice(const GearPair& pair, const Material& pinion, const Material& wheel)
    : pinion_(tooth_form(pair, Member::Pinion), pinion), wheel_(tooth_form(pair, Member::Wheel), wheel), iso_(iso_stiffness(pair, pinion, wheel)) {
  const bool pitch_point_active = pair.pitch_point >= pair.path_start && pair.pitch_point <= pair.path_end;
  const double rho_1 = pitch_point_active ? pair.pitch_point : 0.5 * (pair.path_start + pair.path_end);
  const double rho_2 = pair.path_length - rho_1;

  const double iso_compliance = units::um / iso_.normal_section;
  const double structure = iso_compliance - hertz_compliance(pair, pinion, wheel, rho_1);
  if (structure > 0) {
    calibration_ = structure / compliance(std::hypot(pair.pinion.base_radius, rho_1), std::hypot(pair.wheel.base_radius, rho_2));
  } else {
    status_ = ThinSliceStatus::HertzExceedsIso;
  }
}

double ThinSlice::compliance(double pinion_radius, double wheel_radius) const {
  return calibration_ * (pinion_(pinion_radius) + wheel_(wheel_radius));
}

double ThinSlice::compliance_of(Member member, double radius) const {
  return calibration_ * (member == Member::Pinion ? pinion_(radius) : wheel_(radius));
}

}  // namespace flankwright
