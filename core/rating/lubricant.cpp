#include "core/rating/lubricant.hpp"

#include <cmath>

#include "core/base/error.hpp"

namespace flankwright {

namespace {

constexpr double kelvin = 273.0;  // as the standard rounds it

/// Coefficient and exponent of the pressure-viscosity coefficient at 38 deg C.
struct PressureViscosity {
  double coefficient, exponent;
};

constexpr PressureViscosity pressure_viscosity_of(BaseOil oil) {
  switch (oil) {
    case BaseOil::Mineral:
      return {2.657e-8, 0.1348};
    case BaseOil::Polyalphaolefin:
      return {1.466e-8, 0.0507};
    case BaseOil::Polyglycol:
      return {1.392e-8, 0.1572};
  }
  return {};
}

}  // namespace

std::string_view to_string(BaseOil oil) {
  switch (oil) {
    case BaseOil::Mineral:
      return "mineral";
    case BaseOil::Polyalphaolefin:
      return "polyalphaolefin";
    case BaseOil::Polyglycol:
      return "polyglycol";
  }
  return "";
}

void Lubricant::validate() const {
  if (!(viscosity_100 >= 1.0)) throw InvalidInput("viscosity_100", in_words(viscosity_100), "at least 1 mm2/s");
  if (!(viscosity_40 > viscosity_100)) throw InvalidInput("viscosity_40", in_words(viscosity_40), "above viscosity_100");
  if (!(density_15 > 0.0)) throw InvalidInput("density_15", in_words(density_15), "above 0 kg/m3");
}

Lubricant::Property Lubricant::kinematic_viscosity(double temperature_C) const {
  const auto twice_log = [](double viscosity) { return std::log10(std::log10(viscosity + 0.7)); };
  const double log_40 = std::log10(40.0 + kelvin), log_100 = std::log10(100.0 + kelvin), T = temperature_C + kelvin;
  const double B = (twice_log(viscosity_100) - twice_log(viscosity_40)) / (log_100 - log_40);
  const double once = std::pow(10.0, twice_log(viscosity_40) + B * (std::log10(T) - log_40));  // log10(nu + 0.7)
  const double sum = std::pow(10.0, once);
  return {sum - 0.7, sum * std::log(10.0) * once * B / T};
}

bool Lubricant::has_viscosity_at(double temperature_C) const {
  const double viscosity = kinematic_viscosity(temperature_C).value;
  return viscosity >= least_viscosity && viscosity <= largest_viscosity;
}

Lubricant::Property Lubricant::density(double temperature_C) const { return {density_15 - 0.7 * (temperature_C + kelvin - 289.0), -0.7}; }

Lubricant::Property Lubricant::dynamic_viscosity(double temperature_C) const {
  constexpr double square_metre = 1e-6;  // in mm^2
  const Property nu = kinematic_viscosity(temperature_C), rho = density(temperature_C);
  return {square_metre * nu.value * rho.value, square_metre * (nu.slope * rho.value + nu.value * rho.slope)};
}

Lubricant::Property Lubricant::pressure_viscosity(double temperature_C) const {
  const PressureViscosity of_base = pressure_viscosity_of(base);
  const double alpha_38 = of_base.coefficient * std::pow(dynamic_viscosity(38.0).value, of_base.exponent), T = temperature_C + kelvin;
  return {alpha_38 * (1.0 + 516.0 * (1.0 / T - 1.0 / 311.0)), -alpha_38 * 516.0 / (T * T)};
}

}  // namespace flankwright
