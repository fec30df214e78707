#include "core/compliance/local/hertz_line.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

namespace flankwright {
namespace {

void require(bool holds, const char* field, double value, const char* allowed) {
  if (!holds) throw InvalidInput(field, std::to_string(value), allowed);
}

}  // namespace

void validate(const Material& material) {
  const double e = material.youngs_modulus;
  const double nu = material.poissons_ratio;
  require(e > 0 && std::isfinite(e), "youngs_modulus", e, "more than 0 MPa");
  require(nu >= 0 && nu < 0.5, "poissons_ratio", nu, "at least 0 and less than 0.5");
}

double contact_modulus(const Material& first, const Material& second) {
  validate(first);
  validate(second);
  const auto compliance = [](const Material& m) { return (1 - m.poissons_ratio * m.poissons_ratio) / m.youngs_modulus; };
  return 1 / (compliance(first) + compliance(second));
}

HertzLine hertz_line(double line_load, double relative_radius, double contact_modulus) {
  require(line_load >= 0 && std::isfinite(line_load), "line_load", line_load, "at least 0 N/mm");
  require(relative_radius > 0 && std::isfinite(relative_radius), "relative_radius", relative_radius, "more than 0 mm");
  require(contact_modulus > 0 && std::isfinite(contact_modulus), "contact_modulus", contact_modulus, "more than 0 MPa");

  HertzLine contact;
  contact.half_width = std::sqrt(4 * line_load * relative_radius / (units::pi * contact_modulus));
  contact.peak_pressure = std::sqrt(line_load * contact_modulus / (units::pi * relative_radius));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  contact.half_width_slope = line_load > 0 ? contact.half_width / (2 * line_load) : infinity;
  contact.peak_pressure_slope = line_load > 0 ? contact.peak_pressure / (2 * line_load) : infinity;
  return contact;
}

}  // namespace flankwright
