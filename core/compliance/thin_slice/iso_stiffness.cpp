#include "core/compliance/thin_slice/iso_stiffness.hpp"

#include <cmath>

#include "core/base/units.hpp"
#include "core/compliance/local/hertz_line.hpp"

namespace flankwright {
namespace {

constexpr double kSteelModulus = 206000;  // the modulus that ISO 6336-1's values hold for [MPa]

/// C_B of one rack.
double rack_factor(const RackProfile& rack, double pressure_angle) {
  return (1 + 0.5 * (1.2 - rack.dedendum)) * (1 - 0.02 * (20 - pressure_angle / units::deg));
}

}  // namespace

double iso_flexibility(double virtual_teeth_pinion, double virtual_teeth_wheel, double shift_pinion, double shift_wheel) {
  const double z1 = virtual_teeth_pinion, z2 = virtual_teeth_wheel;
  const double x1 = shift_pinion, x2 = shift_wheel;
  return 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 * x1 - 0.11654 * x1 / z1 - 0.00193 * x2 - 0.24188 * x2 / z2 + 0.00529 * x1 * x1 +
         0.00182 * x2 * x2;
}

IsoStiffness iso_stiffness(const GearPair& pair, const Material& pinion, const Material& wheel) {
  validate(pinion);
  validate(wheel);
  const PairData& data = pair.data;
  const double cos_beta = std::cos(data.helix_angle);
  const double cos_base = std::cos(pair.base_helix_angle);
  const double x1 = pair.pinion.generating_profile_shift, x2 = pair.wheel.generating_profile_shift;

  IsoStiffness iso;
  iso.virtual_teeth_pinion = data.pinion.teeth / (cos_base * cos_base * cos_beta);
  iso.virtual_teeth_wheel = data.wheel.teeth / (cos_base * cos_base * cos_beta);
  // The standard's pinion is the smaller gear, whichever of the two a study calls so; of equal ones that with the larger shift.
  const bool is_smaller = data.pinion.teeth != data.wheel.teeth ? data.pinion.teeth < data.wheel.teeth : x1 >= x2;
  iso.q_prime = is_smaller ? iso_flexibility(iso.virtual_teeth_pinion, iso.virtual_teeth_wheel, x1, x2)
                           : iso_flexibility(iso.virtual_teeth_wheel, iso.virtual_teeth_pinion, x2, x1);
  iso.c_theoretical = 1 / iso.q_prime;
  iso.correction_factor = 0.8;
  iso.blank_factor = 1;
  iso.rack_factor = 0.5 * (rack_factor(data.pinion.rack, data.pressure_angle) + rack_factor(data.wheel.rack, data.pressure_angle));
  const double e1 = pinion.youngs_modulus, e2 = wheel.youngs_modulus;
  iso.material_factor = 2 * e1 * e2 / (e1 + e2) / kSteelModulus;
  iso.normal_section = iso.c_theoretical * iso.correction_factor * iso.blank_factor * iso.rack_factor * iso.material_factor;
  iso.c_prime = iso.normal_section * cos_beta;
  iso.c_gamma = iso.c_prime * (0.75 * pair.transverse_contact_ratio + 0.25);
  iso.within_range = (is_smaller ? x1 >= x2 : x2 >= x1) && x1 + x2 >= -0.5 && x1 + x2 <= 2 && data.helix_angle <= 45 * units::deg;
  iso.mean_within_range = iso.within_range && pair.transverse_contact_ratio >= 1.2;
  return iso;
}

}  // namespace flankwright
