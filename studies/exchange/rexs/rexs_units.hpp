#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace flankwright::studies::rexs {

/// What an attribute measures; says which units it may carry and what a number becomes inside.
enum class Dimension {
  None,              ///< "none" or no unit; also "%" as 1/100
  Length,            ///< mm
  Angle,             ///< rad
  Torque,            ///< N mm
  Stress,            ///< MPa
  Power,             ///< kW
  Speed,             ///< 1/min
  Stiffness,         ///< N/mm
  TiltingStiffness,  ///< N mm/rad
  Force,             ///< N
  Share,             ///< of a whole, 0 .. 1; a bare number is per cent
  Time,              ///< h
  Temperature,       ///< deg C
  Viscosity,         ///< kinematic, mm^2/s
  Density            ///< kg/m^3
};

/// Size of one such unit inside. Spaces, points and asterisks within it do not count: "N / mm^2" (up to 1.7) and "MPa" (2.0), "°" (up
/// to 1.3) and "deg" are alike.
/// @return  nullopt where the unit is none of this dimension
std::optional<double> unit_size(std::string_view unit, Dimension dimension);

/// What a number in such a unit lacks to the zero of its dimension, inside: -273.15 of K, 0 of all that are proportional.
double unit_offset(std::string_view unit);

/// Units that are understood, for messages: "mm, m, cm, mum, in".
std::string units_in_words(Dimension dimension);

}  // namespace flankwright::studies::rexs
