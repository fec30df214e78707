#include "core/gear/flank_tolerances.hpp"

#include <cmath>

#include "core/base/error.hpp"

namespace flankwright {

namespace {

void check(const char* field, double value, double low, double high, const char* unit) {
  if (value >= low && value <= high) return;
  throw InvalidInput(field, in_words(value), in_words(low) + " .. " + in_words(high) + unit + " (ISO 1328-1:2013)");
}

}  // namespace

ToleranceData ToleranceData::of(const GearPair& pair, Member member) {
  const Gear& gear = pair[member];
  return {gear.data.teeth, 2.0 * gear.reference_radius, pair.data.normal_module, gear.data.face_width, std::abs(pair.data.helix_angle)};
}

FlankTolerances flank_tolerances(const ToleranceData& gear, int tolerance_class) {
  check("iso_1328_class", tolerance_class, 1, 11, "");
  check("teeth", gear.teeth, 5, 1000, "");
  check("reference_diameter", gear.reference_diameter, 5.0, 15000.0, " mm");
  check("normal_module", gear.normal_module, 0.5, 70.0, " mm");
  check("face_width", gear.face_width, 4.0, 1200.0, " mm");
  constexpr double round_off = 1e-12;  // of 45 deg converted to rad and back [deg]
  check("helix_angle", gear.helix_angle / units::deg, 0.0, 45.0 + round_off, " deg");

  const double d = gear.reference_diameter, m = gear.normal_module, b = gear.face_width;
  const double root_d = std::sqrt(d), root_b = std::sqrt(b);
  const double step = std::exp2(0.5 * (tolerance_class - 5)) * units::um;
  FlankTolerances t;
  t.single_pitch = (0.001 * d + 0.4 * m + 5.0) * step;
  t.cumulative_pitch = (0.002 * d + 0.55 * root_d + 0.7 * m + 12.0) * step;
  t.profile_slope = (0.4 * m + 0.001 * d + 4.0) * step;
  t.profile_form = (0.55 * m + 5.0) * step;
  t.profile_total = std::hypot(t.profile_slope, t.profile_form);
  t.helix_slope = (0.05 * root_d + 0.35 * root_b + 4.0) * step;
  t.helix_form = (0.07 * root_d + 0.45 * root_b + 4.0) * step;
  t.helix_total = std::hypot(t.helix_slope, t.helix_form);
  return t;
}

double rounded_tolerance(double tolerance) {
  const double um = tolerance / units::um;
  if (um > 10.0) return std::round(um) * units::um;
  if (um >= 5.0) return std::round(2.0 * um) / 2.0 * units::um;
  return std::round(10.0 * um) / 10.0 * units::um;
}

}  // namespace flankwright
