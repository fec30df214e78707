#pragma once

#include <string_view>

#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// Base oils that the pressure-viscosity coefficient distinguishes.
enum class BaseOil { Mineral, Polyalphaolefin, Polyglycol };

/// "mineral", "polyalphaolefin", "polyglycol".
std::string_view to_string(BaseOil oil);

/// A gear oil. Temperatures in deg C.
struct Lubricant {
  BaseOil base{BaseOil::Mineral};
  double viscosity_40{not_given};   ///< kinematic, at 40 deg C [mm^2/s], above viscosity_100
  double viscosity_100{not_given};  ///< at 100 deg C [mm^2/s], >= 1
  double density_15{890.0};         ///< at 15 deg C [kg/m^3], > 0
  double temperature{not_given};    ///< of the oil in the gearbox

  /// A property and its derivative by the temperature.
  struct Property {
    double value, slope;
  };
  /// nu: log10 log10(nu + 0.7) = A + B log10(T), T in K, through both viscosities [Ubbelohde-Walther; ISO/TR 15144-1:2014, 7] [mm^2/s].
  Property kinematic_viscosity(double temperature_C) const;
  /// density_15 - 0.7 (T - 289 K) [kg/m^3].
  Property density(double temperature_C) const;
  /// eta [Pa s].
  Property dynamic_viscosity(double temperature_C) const;
  /// alpha, with eta_38 in Pa s and T in K [ISO/TR 15144-1:2014, 7]:
  ///
  ///     alpha_38 = 2.657e-8 eta_38^0.1348 (mineral),  1.466e-8 eta_38^0.0507 (polyalphaolefin),  1.392e-8 eta_38^0.1572 (polyglycol)
  ///     alpha    = alpha_38 (1 + 516 (1/T - 1/311))                                                                         [m^2/N]
  Property pressure_viscosity(double temperature_C) const;

  /// Kinematic viscosities that ASTM D341 covers. Below 2 mm^2/s it has further terms, which are left out here [mm^2/s].
  static constexpr double least_viscosity = 0.21, largest_viscosity = 2e7;
  bool has_viscosity_at(double temperature_C) const;

  /// @throws InvalidInput "viscosity_40", "viscosity_100" or "density_15"
  void validate() const;
};

}  // namespace flankwright
