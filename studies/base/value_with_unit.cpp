#include "studies/base/value_with_unit.hpp"

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "studies/base/printable.hpp"

namespace flankwright::studies {

namespace {

enum class Dimension {
  None,
  Length,
  Angle,
  Torque,
  Force,
  Stress,
  LineLoad,
  InverseLength,
  InverseAngle,
  Time,
  RotationalSpeed,
  Temperature,
  KinematicViscosity,
  Density
};

constexpr double pound_force = 4.4482216152605;  // N, exact by definition
constexpr double foot = 12.0 * units::inch;      // mm

struct Unit {
  std::string_view name;  ///< as tidy_unit() leaves it
  Dimension dimension;
  double factor;  ///< internal = outside * factor
};

constexpr std::array known_units{
    Unit{"mm", Dimension::Length, 1.0},
    Unit{"um", Dimension::Length, units::um},
    Unit{"mum", Dimension::Length, units::um},
    Unit{"nm", Dimension::Length, 1e-6},
    Unit{"cm", Dimension::Length, 10.0},
    Unit{"m", Dimension::Length, 1000.0},
    Unit{"in", Dimension::Length, units::inch},
    Unit{"mil", Dimension::Length, 1e-3 * units::inch},
    Unit{"ft", Dimension::Length, foot},
    Unit{"deg", Dimension::Angle, units::deg},
    Unit{"arcmin", Dimension::Angle, units::arcmin},
    Unit{"arcsec", Dimension::Angle, units::arcsec},
    Unit{"rad", Dimension::Angle, 1.0},
    Unit{"mrad", Dimension::Angle, 1e-3},
    Unit{"urad", Dimension::Angle, 1e-6},
    Unit{"Nm", Dimension::Torque, units::newton_metre},
    Unit{"kNm", Dimension::Torque, 1e3 * units::newton_metre},
    Unit{"Nmm", Dimension::Torque, 1.0},
    Unit{"lbfin", Dimension::Torque, pound_force* units::inch},
    Unit{"inlbf", Dimension::Torque, pound_force* units::inch},
    Unit{"lbfft", Dimension::Torque, pound_force* foot},
    Unit{"ftlbf", Dimension::Torque, pound_force* foot},
    Unit{"N", Dimension::Force, 1.0},
    Unit{"kN", Dimension::Force, 1e3},
    Unit{"lbf", Dimension::Force, pound_force},
    Unit{"MPa", Dimension::Stress, 1.0},
    Unit{"GPa", Dimension::Stress, 1e3},
    Unit{"Pa", Dimension::Stress, 1e-6},
    Unit{"N/mm2", Dimension::Stress, 1.0},
    Unit{"N/mm^2", Dimension::Stress, 1.0},
    Unit{"psi", Dimension::Stress, pound_force / (units::inch * units::inch)},
    Unit{"ksi", Dimension::Stress, 1e3 * pound_force / (units::inch * units::inch)},
    Unit{"N/mm", Dimension::LineLoad, 1.0},
    Unit{"N/m", Dimension::LineLoad, 1e-3},
    Unit{"kN/m", Dimension::LineLoad, 1.0},
    Unit{"N/um", Dimension::LineLoad, 1.0 / units::um},
    Unit{"kN/mm", Dimension::LineLoad, 1e3},
    Unit{"lbf/in", Dimension::LineLoad, pound_force / units::inch},
    Unit{"N/(mmum)", Dimension::Stress, 1.0 / units::um},
    Unit{"1/in", Dimension::InverseLength, 1.0 / units::inch},
    Unit{"/in", Dimension::InverseLength, 1.0 / units::inch},
    Unit{"1/mm", Dimension::InverseLength, 1.0},
    Unit{"/mm", Dimension::InverseLength, 1.0},
    Unit{"arcsec/deg^2", Dimension::InverseAngle, units::arcsec_per_square_deg},
    Unit{"arcsec/deg2", Dimension::InverseAngle, units::arcsec_per_square_deg},
    Unit{"1/rad", Dimension::InverseAngle, 1.0},
    Unit{"/rad", Dimension::InverseAngle, 1.0},
    Unit{"s", Dimension::Time, 1.0},
    Unit{"ms", Dimension::Time, 1e-3},
    Unit{"min", Dimension::Time, 60.0},
    Unit{"h", Dimension::Time, 3600.0},
    Unit{"rpm", Dimension::RotationalSpeed, 2.0 * units::pi / 60.0},
    Unit{"1/min", Dimension::RotationalSpeed, 2.0 * units::pi / 60.0},
    Unit{"rad/s", Dimension::RotationalSpeed, 1.0},
    Unit{"degC", Dimension::Temperature, 1.0},
    Unit{"mm2/s", Dimension::KinematicViscosity, 1.0},
    Unit{"mm^2/s", Dimension::KinematicViscosity, 1.0},
    Unit{"cSt", Dimension::KinematicViscosity, 1.0},
    Unit{"kg/m3", Dimension::Density, 1.0},
    Unit{"kg/m^3", Dimension::Density, 1.0},
};

/// Notation of a quantity: the unit of a bare number, and the units an error message proposes.
struct Convention {
  Dimension dimension;
  std::string_view bare_unit;  ///< tidy name
  std::string_view shown;      ///< for documentation
  std::string_view proposed;   ///< for error messages
};

constexpr Convention convention(Quantity quantity) {
  switch (quantity) {
    case Quantity::Number:
      return {Dimension::None, "", "-", "no unit"};
    case Quantity::Length:
      return {Dimension::Length, "mm", "mm", "mm, um, cm, m, in, mil"};
    case Quantity::Deviation:
      return {Dimension::Length, "um", "um", "um, mm, in, mil"};
    case Quantity::Angle:
      return {Dimension::Angle, "deg", "deg", "deg, arcmin, arcsec, rad, mrad"};
    case Quantity::SmallAngle:
      return {Dimension::Angle, "arcmin", "arcmin", "arcmin, arcsec, deg, rad, mrad, urad"};
    case Quantity::Torque:
      return {Dimension::Torque, "Nm", "N·m", "N·m, kN·m, N·mm, lbf in, lbf ft"};
    case Quantity::Force:
      return {Dimension::Force, "N", "N", "N, kN, lbf"};
    case Quantity::Stress:
      return {Dimension::Stress, "MPa", "MPa", "MPa, GPa, Pa, N/mm2, psi, ksi"};
    case Quantity::LineLoad:
      return {Dimension::LineLoad, "N/mm", "N/mm", "N/mm, kN/m, lbf/in"};
    case Quantity::Stiffness:
      return {Dimension::LineLoad, "N/um", "N/um", "N/um, N/mm, kN/mm, lbf/in"};
    case Quantity::MeshStiffness:
      return {Dimension::Stress, "N/(mmum)", "N/(mm um)", "N/(mm um), N/mm2"};
    case Quantity::DiametralPitch:
      return {Dimension::InverseLength, "1/in", "1/in", "1/in, 1/mm"};
    case Quantity::Curvature:
      return {Dimension::InverseLength, "1/mm", "1/mm", "1/mm, 1/in"};
    case Quantity::ParabolicTe:
      return {Dimension::InverseAngle, "arcsec/deg^2", "arcsec/deg^2", "arcsec/deg^2, 1/rad"};
    case Quantity::Time:
      return {Dimension::Time, "s", "s", "s, min, h"};
    case Quantity::Duration:
      return {Dimension::Time, "h", "h", "h, min, s"};
    case Quantity::RotationalSpeed:
      return {Dimension::RotationalSpeed, "rpm", "rpm", "rpm, rad/s"};
    case Quantity::Temperature:
      return {Dimension::Temperature, "degC", "degC", "degC"};
    case Quantity::KinematicViscosity:
      return {Dimension::KinematicViscosity, "mm2/s", "mm2/s", "mm2/s, cSt"};
    case Quantity::Density:
      return {Dimension::Density, "kg/m3", "kg/m3", "kg/m3"};
  }
  return {Dimension::None, "", "-", "no unit"};
}

std::optional<Unit> find_unit(std::string_view tidy_name, Dimension dimension) {
  for (const Unit& unit : known_units) {
    if (unit.name == tidy_name && unit.dimension == dimension) return unit;
  }
  return std::nullopt;
}

double factor_of(Quantity quantity) {
  const Convention c = convention(quantity);
  if (c.dimension == Dimension::None) return 1.0;
  const std::optional<Unit> unit = find_unit(c.bare_unit, c.dimension);
  assert(unit);
  return unit->factor;
}

std::string replaced_all(std::string_view text, std::string_view from, std::string_view to) {
  std::string result;
  for (std::size_t at = text.find(from); at != std::string_view::npos; at = text.find(from)) {
    result.append(text.substr(0, at)).append(to);
    text.remove_prefix(at + from.size());
  }
  return result.append(text);
}

/// One spelling for every way to write a unit: without blanks and product signs, u for micro, deg for the degree sign.
std::string tidy_unit(std::string_view written) {
  std::string unit(written);
  unit = replaced_all(unit, "\u00b5", "u");    // micro sign
  unit = replaced_all(unit, "\u03bc", "u");    // Greek mu
  unit = replaced_all(unit, "\u00b0", "deg");  // degree sign
  unit = replaced_all(unit, "\u00b2", "2");    // superscript two
  unit = replaced_all(unit, "\u00b3", "3");    // superscript three
  for (const std::string_view sign : {" ", "\t", "\u00a0", "\u00b7", "\u22c5", "*"}) unit = replaced_all(unit, sign, "");
  return unit;
}

/// Leading finite number of a text and the rest; nullopt where there is none. Independent of the locale.
std::optional<std::pair<double, std::string_view>> split_number(std::string_view text) {
  text = trimmed(text);
  const bool has_plus = text.starts_with('+');
  if (has_plus) text.remove_prefix(1);
  // A digit or a point must follow the sign: from_chars would also read "inf", "nan" and the second sign of "+-1".
  const std::size_t digit = !has_plus && text.starts_with('-') ? 1 : 0;
  if (digit >= text.size() || !((text[digit] >= '0' && text[digit] <= '9') || text[digit] == '.')) return std::nullopt;
  double number = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status != std::errc{} || !std::isfinite(number)) return std::nullopt;
  return std::pair{number, text.substr(static_cast<std::size_t>(end - text.data()))};
}

}  // namespace

std::string_view default_unit(Quantity quantity) { return convention(quantity).shown; }

double internal_value(double bare, Quantity quantity) { return bare * factor_of(quantity); }

double outside_value(double internal, Quantity quantity) { return internal / factor_of(quantity); }

double parse_value_with_unit(std::string_view text, Quantity quantity) {
  const Convention c = convention(quantity);
  if (c.dimension == Dimension::None) throw InvalidInput("", std::string(text), "a number without quotes and unit");
  const std::string allowed = "a number and its unit (" + std::string(c.proposed) + ")";
  const auto parts = split_number(text);
  if (!parts) throw InvalidInput("", std::string(text), allowed);
  const std::optional<Unit> unit = find_unit(tidy_unit(parts->second), c.dimension);
  if (!unit) throw InvalidInput("", std::string(text), allowed);
  const double value = parts->first * unit->factor;
  if (!std::isfinite(value)) throw InvalidInput("", std::string(text), "a finite number");
  return value;
}

double parse_percentage(std::string_view text) {
  const auto parts = split_number(text);
  if (!parts || trimmed(parts->second) != "%") throw InvalidInput("", std::string(text), "a percentage such as \"2 %\"");
  return parts->first / 100.0;
}

}  // namespace flankwright::studies
