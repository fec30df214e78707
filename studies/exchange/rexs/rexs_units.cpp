#include "studies/exchange/rexs/rexs_units.hpp"

#include <array>

#include "core/base/units.hpp"

namespace flankwright::studies::rexs {

namespace {

struct Unit {
  Dimension dimension;
  std::string_view name;  ///< without spaces, points and asterisks
  double size;
};

using enum Dimension;
constexpr std::array<Unit, 66> known_units{{{None, "none", 1.0},
                                            {Force, "N", 1.0},
                                            {Force, "kN", 1e3},
                                            {None, "", 1.0},
                                            {None, "-", 1.0},
                                            {None, "%", 0.01},
                                            {Length, "mm", 1.0},
                                            {Length, "m", 1e3},
                                            {Length, "cm", 10.0},
                                            {Length, "mum", 1e-3},
                                            {Length, "um", 1e-3},
                                            {Length, "\xc2\xb5m", 1e-3},
                                            {Length, "\xce\xbcm", 1e-3},
                                            {Length, "in", units::inch},
                                            {Angle, "deg", units::deg},
                                            {Angle, "\xc2\xb0", units::deg},
                                            {Angle, "rad", 1.0},
                                            {Angle, "arcmin", units::arcmin},
                                            {Angle, "'", units::arcmin},
                                            {Torque, "Nm", 1e3},
                                            {Torque, "Nmm", 1.0},
                                            {Torque, "kNm", 1e6},
                                            {Torque, "lbfin", 4.4482216152605 * units::inch},
                                            {Stress, "MPa", 1.0},
                                            {Stress, "N/mm^2", 1.0},
                                            {Stress, "N/mm2", 1.0},
                                            {Stress, "N/mm\xc2\xb2", 1.0},
                                            {Stress, "GPa", 1e3},
                                            {Stress, "kPa", 1e-3},
                                            {Stress, "Pa", 1e-6},
                                            {Stress, "N/m^2", 1e-6},
                                            {Power, "kW", 1.0},
                                            {Power, "W", 1e-3},
                                            {Power, "MW", 1e3},
                                            {Power, "PS", 0.73549875},
                                            {Speed, "1/min", 1.0},
                                            {Speed, "rpm", 1.0},
                                            {Speed, "min^-1", 1.0},
                                            {Speed, "1/s", 60.0},
                                            {Speed, "rad/s", 30.0 / units::pi},
                                            {Speed, "Hz", 60.0},
                                            {Stiffness, "N/m", 1e-3},
                                            {Stiffness, "N/mm", 1.0},
                                            {Stiffness, "N/mum", 1e3},
                                            {Stiffness, "kN/mm", 1e3},
                                            {TiltingStiffness, "Nmm/rad", 1.0},
                                            {TiltingStiffness, "Nm/rad", 1e3},
                                            {Share, "%", 0.01},
                                            {Share, "1/100", 0.01},
                                            {Time, "h", 1.0},
                                            {Time, "min", 1.0 / 60.0},
                                            {Time, "s", 1.0 / 3600.0},
                                            {Time, "d", 24.0},
                                            {Temperature, "C", 1.0},
                                            {Temperature,
                                             "\xc2\xb0"
                                             "C",
                                             1.0},
                                            {Temperature, "degC", 1.0},
                                            {Temperature, "K", 1.0},
                                            {Viscosity, "mm^2/s", 1.0},
                                            {Viscosity, "mm2/s", 1.0},
                                            {Viscosity, "mm\xc2\xb2/s", 1.0},
                                            {Viscosity, "cSt", 1.0},
                                            {Viscosity, "m^2/s", 1e6},
                                            {Density, "kg/dm^3", 1e3},
                                            {Density, "kg/m^3", 1.0},
                                            {Density, "g/cm^3", 1e3},
                                            {Density, "kg/l", 1e3}}};

}  // namespace

std::optional<double> unit_size(std::string_view unit, Dimension dimension) {
  std::string name;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const bool middle_dot = unit.substr(i).starts_with("\xc2\xb7");
    if (middle_dot) ++i;
    if (!middle_dot && unit[i] != ' ' && unit[i] != '*' && unit[i] != '.') name += unit[i];
  }
  for (const Unit& known : known_units) {
    if (known.dimension == dimension && known.name == name) return known.size;
  }
  return std::nullopt;
}

double unit_offset(std::string_view unit) { return unit == "K" ? -273.15 : 0.0; }

std::string units_in_words(Dimension dimension) {
  std::string words;
  for (const Unit& known : known_units) {
    if (known.dimension == dimension && !known.name.empty()) words.append(words.empty() ? "" : ", ").append(known.name);
  }
  return words;
}

}  // namespace flankwright::studies::rexs
