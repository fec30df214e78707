#pragma once

#include <string>
#include <string_view>

/// The boundary where units are converted: outside a study file's numbers and "12 um" texts, inside mm, N mm, rad, MPa.
namespace flankwright::studies {

/// Quantity of a number in a study file. It fixes the unit of a bare number and the units that a text may carry.
enum class Quantity {
  Number,              ///< no unit [-]
  Length,              ///< bare: mm; inside mm
  Deviation,           ///< modification, error, transmission error; bare: um; inside mm
  Angle,               ///< bare: deg; inside rad
  SmallAngle,          ///< misalignment; bare: arcmin; inside rad
  Torque,              ///< bare: N·m; inside N mm
  Force,               ///< bare: N; inside N
  Stress,              ///< bare: MPa; inside MPa
  LineLoad,            ///< bare: N/mm; inside N/mm
  Stiffness,           ///< of a bearing; bare: N/um; inside N/mm
  MeshStiffness,       ///< of teeth per face width, c_gamma; bare: N/(mm um); inside N/mm^2
  DiametralPitch,      ///< bare: 1/in; inside 1/mm
  Curvature,           ///< bare: 1/mm; inside 1/mm
  ParabolicTe,         ///< a in delta_phi2 = -a phi1^2; bare: arcsec/deg^2; inside 1/rad
  Time,                ///< bare: s; inside s
  Duration,            ///< of a load; bare: h; inside s
  RotationalSpeed,     ///< bare: rpm; inside rad/s
  Temperature,         ///< bare: degC; inside degC
  KinematicViscosity,  ///< bare: mm2/s; inside mm^2/s
  Density              ///< bare: kg/m3; inside kg/m^3
};

/// Unit of a bare number, as the documentation writes it: "mm", "um", "N·m"; "-" for Quantity::Number.
std::string_view default_unit(Quantity quantity);

/// A bare number of a study file in internal units; may overflow to infinity, which callers refuse.
double internal_value(double bare, Quantity quantity);

/// Inverse of internal_value().
double outside_value(double internal, Quantity quantity);

/// A text such as "3 arcmin", "1.6 in", "120 lbf in" or "1e-3 rad" in internal units. The space before the unit may be
/// left out; "µm" and "μm" mean "um"; "N·m", "N m", "N*m" and "Nm" are the same unit. Upper and lower case differ.
///
/// @throws InvalidInput with an empty field where the text is not a finite number followed by a unit of this quantity
double parse_value_with_unit(std::string_view text, Quantity quantity);

/// "2 %" -> 0.02. A number without the sign is not a percentage.
///
/// @throws InvalidInput with an empty field where the text is not a finite number followed by %
double parse_percentage(std::string_view text);

}  // namespace flankwright::studies
