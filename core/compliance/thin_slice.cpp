#include "core/compliance/thin_slice.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "core/compliance/contact_law.hpp"
#include "core/compliance/hertz_line.hpp"
#include "core/compliance/tooth_bending.hpp"

namespace flankwright {
namespace {

/// Line load at which ISO's stiffness is taken [N/mm].
constexpr double kReferenceLoad = 300;

double roll_length(double radius, double base_radius) {
  return std::sqrt(std::max(0.0, (radius - base_radius) * (radius + base_radius)));
}

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
  const ContactLaw law(side(Member::Pinion, pinion, rho_1), side(Member::Wheel, wheel, rho_2), relative_radius,
                       contact_modulus(pinion, wheel));
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
  // Values at the Chebyshev points, then their discrete cosine transform.
  std::array<double, kCoefficients> values;
  const auto angle = [](int i) { return units::pi * (i + 0.5) / kCoefficients; };
  for (int i = 0; i < kCoefficients; ++i) {
    const double roll = 0.5 * (first_roll + last_roll) + 0.5 * (last_roll - first_roll) * std::cos(angle(i));
    const double radius = std::clamp(std::hypot(base_radius, roll), form.form_radius(), form.tip_radius());
    values[static_cast<std::size_t>(i)] =
        tooth_compliance(form, radius, material.poissons_ratio).total() / material.youngs_modulus;
  }
  for (int k = 0; k < kCoefficients; ++k) {
    double sum = 0;
    for (int i = 0; i < kCoefficients; ++i) sum += values[static_cast<std::size_t>(i)] * std::cos(k * angle(i));
    coefficients[static_cast<std::size_t>(k)] = sum * (k == 0 ? 1.0 : 2.0) / kCoefficients;
  }
}

double ThinSlice::Table::operator()(double radius) const {
  const double roll = std::clamp(roll_length(radius, base_radius), first_roll, last_roll);
  const double t = (2 * roll - first_roll - last_roll) / (last_roll - first_roll);
  double b1 = 0, b2 = 0;  // Clenshaw's recurrence
  for (std::size_t k = kCoefficients - 1; k > 0; --k) {
    const double b = coefficients[k] + 2 * t * b1 - b2;
    b2 = b1;
    b1 = b;
  }
  return coefficients[0] + t * b1 - b2;
}

ThinSlice::ThinSlice(const GearPair& pair, const Material& pinion, const Material& wheel)
    : pinion_(tooth_form(pair, Member::Pinion), pinion),
      wheel_(tooth_form(pair, Member::Wheel), wheel),
      iso_(iso_stiffness(pair, pinion, wheel)) {
  const bool pitch_point_active = pair.pitch_point >= pair.path_start && pair.pitch_point <= pair.path_end;
  calibration_roll_length_ = pitch_point_active ? pair.pitch_point : 0.5 * (pair.path_start + pair.path_end);
  const double rho_1 = calibration_roll_length_;
  const double rho_2 = pair.path_length - rho_1;

  const double iso_compliance = units::um / iso_.normal_section;
  const double structure = iso_compliance - hertz_compliance(pair, pinion, wheel, rho_1);
  if (structure > 0) {
    calibration_ =
        structure / compliance(std::hypot(pair.pinion.base_radius, rho_1), std::hypot(pair.wheel.base_radius, rho_2));
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
