#include "studies/base/value_with_unit.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "core/base/error.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

constexpr double round_off = 1e-14;  // relative: a product of three rounded factors

constexpr double full_turn = 2.0 * std::numbers::pi;

}  // namespace

TEST_CASE("A text with a unit gives the same quantity as its definition", "[studies][units]") {
  using Row = std::tuple<std::string, Quantity, double>;
  const auto [text, quantity, expected] = GENERATE(table<std::string, Quantity, double>({
      Row{"3 arcmin", Quantity::SmallAngle, 3.0 * full_turn / (360.0 * 60.0)},
      Row{"30 arcsec", Quantity::SmallAngle, 30.0 * full_turn / (360.0 * 3600.0)},
      Row{"20 deg", Quantity::Angle, full_turn / 18.0},
      Row{"20°", Quantity::Angle, full_turn / 18.0},
      Row{"1e-3 rad", Quantity::SmallAngle, 1e-3},
      Row{"-1.5mrad", Quantity::SmallAngle, -1.5e-3},
      Row{"12 um", Quantity::Deviation, 0.012},
      Row{"12 \u00b5m", Quantity::Deviation, 0.012},  // micro sign
      Row{"12 \u03bcm", Quantity::Deviation, 0.012},  // Greek letter
      Row{"0.5 mm", Quantity::Deviation, 0.5},
      Row{"+0.5mm", Quantity::Length, 0.5},
      Row{"1.6 in", Quantity::Length, 40.64},
      Row{" 2 m ", Quantity::Length, 2000.0},
      Row{"1 mil", Quantity::Deviation, 0.0254},
      Row{"20 N/(mm um)", Quantity::MeshStiffness, 20000.0},
      Row{"5 1/in", Quantity::DiametralPitch, 5.0 / 25.4},
      Row{"2 N·m", Quantity::Torque, 2000.0},
      Row{"2 Nm", Quantity::Torque, 2000.0},
      Row{"2 N m", Quantity::Torque, 2000.0},
      Row{"2 N*m", Quantity::Torque, 2000.0},
      Row{"2 kN·m", Quantity::Torque, 2e6},
      // A pound force is 0.45359237 kg at 9.80665 m/s2.
      Row{"120 lbf in", Quantity::Torque, 120.0 * 0.45359237 * 9.80665 * 25.4},
      Row{"10 lbf·ft", Quantity::Torque, 120.0 * 0.45359237 * 9.80665 * 25.4},
      Row{"206 GPa", Quantity::Stress, 206000.0},
      Row{"30e6 psi", Quantity::Stress, 30e6 * 0.45359237 * 9.80665 / (25.4 * 25.4)},
      Row{"10 min", Quantity::Time, 600.0},
      Row{"2 1/mm", Quantity::Curvature, 2.0},
      Row{"25.4 1/in", Quantity::Curvature, 1.0},
      // (full_turn/1296000) / (full_turn/360)^2
      Row{"1 arcsec/deg^2", Quantity::ParabolicTe, 1.0 / (10.0 * full_turn)},
      Row{"1 arcsec/deg²", Quantity::ParabolicTe, 1.0 / (10.0 * full_turn)},
      Row{"0.5 1/rad", Quantity::ParabolicTe, 0.5},
  }));
  CAPTURE(text);
  CHECK(parse_value_with_unit(text, quantity) == Approx(expected).epsilon(round_off));
}

TEST_CASE("A bare number and the same number with its default unit are one value", "[studies][units]") {
  const Quantity quantity = GENERATE(Quantity::Length, Quantity::Deviation, Quantity::Angle, Quantity::SmallAngle, Quantity::Torque, Quantity::Stress,
                                     Quantity::LineLoad, Quantity::DiametralPitch, Quantity::Curvature, Quantity::ParabolicTe, Quantity::Time);
  const std::string text = "7.25 " + std::string(default_unit(quantity));
  CAPTURE(text);
  CHECK(internal_value(7.25, quantity) == parse_value_with_unit(text, quantity));
  CHECK(outside_value(internal_value(7.25, quantity), quantity) == Approx(7.25).epsilon(round_off));
}

TEST_CASE("A unit of another dimension is refused, and so is a number without one", "[studies][units]") {
  using Row = std::tuple<std::string, Quantity>;
  const auto [text, quantity] = GENERATE(table<std::string, Quantity>({
      Row{"3 mm", Quantity::SmallAngle},
      Row{"3 deg", Quantity::Length},
      Row{"3 N", Quantity::Torque},
      Row{"3 nm", Quantity::Torque},  // a nanometre
      Row{"3", Quantity::Deviation},
      Row{"um", Quantity::Deviation},
      Row{"", Quantity::Deviation},
      Row{"-", Quantity::Deviation},
      Row{"+-3 um", Quantity::Deviation},
      Row{"1,5 mm", Quantity::Length},
      Row{"inf mm", Quantity::Length},
      Row{"nan mm", Quantity::Length},
      Row{"1e999 mm", Quantity::Length},
      Row{"1e308 m", Quantity::Length},
      Row{"0x10 mm", Quantity::Length},
      Row{"0.3 m", Quantity::Number},
      Row{"0.3 mm", Quantity::Curvature},
      Row{"0.3 arcsec", Quantity::ParabolicTe},
  }));
  CAPTURE(text);
  CHECK_THROWS_AS(parse_value_with_unit(text, quantity), InvalidInput);
}

TEST_CASE("A percentage is a hundredth and needs its sign", "[studies][units]") {
  CHECK(parse_percentage("2 %") == Approx(0.02).epsilon(round_off));
  CHECK(parse_percentage("0.5%") == Approx(0.005).epsilon(round_off));
  CHECK_THROWS_AS(parse_percentage("2"), InvalidInput);
  CHECK_THROWS_AS(parse_percentage("% 2"), InvalidInput);
}
