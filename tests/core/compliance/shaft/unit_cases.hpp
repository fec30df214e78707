#pragma once

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/compliance/shaft/shaft_pair.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/core/gear/pair_cases.hpp"

/// A unit of two stages, of which the second one is the pair.
namespace unit_cases {

using namespace flankwright;

inline constexpr double in_unit = 1e-9;  // round-off of a system of three shafts

inline GearPair second_stage(WorkingFlank flank = WorkingFlank::Left, Hand hand = Hand::Left) {
  PairData data = pair_cases::pair_data(23, 34, 10, 6.5, 74);
  data.pinion_hand = hand;
  data.working_flank = flank;
  return make_gear_pair(data);
}

inline ShaftData shaft_of_unit(double length, std::vector<double> bearings, double stiffness = std::numeric_limits<double>::infinity()) {
  ShaftData shaft;
  shaft.sections = {{length, 80}};
  for (const double position : bearings) shaft.bearings.push_back({.position = position, .radial_stiffness = stiffness});
  shaft.bearings.front().axial_stiffness = std::numeric_limits<double>::infinity();
  return shaft;
}

/// Input, intermediate and output shaft; the second stage is the pair.
inline ShaftsOfPair two_stages(double stiffness = 5e5) {
  ShaftsOfPair all;
  all.shaft.pinion = shaft_of_unit(270, {20, 250}, stiffness);
  all.shaft.pinion->gear_position = 180;
  all.shaft.wheel = shaft_of_unit(320, {60, 215}, stiffness);
  all.shaft.wheel->gear_position = 140;
  all.shaft.wheel->torque_position = 310;
  all.unit.shafts = {shaft_of_unit(220, {65, 205}, stiffness)};
  all.unit.shafts[0].name = "input";
  all.unit.shafts[0].torque_position = 0;
  UnitMesh mesh;
  mesh.name = "first stage";
  mesh.gears = {UnitGear{"input", 117, 27, 50}, UnitGear{"pinion", 72, 51, 50}};
  mesh.normal_module = 4.5;
  mesh.helix_angle = 21 * units::deg;
  mesh.hand = Hand::Right;
  mesh.centre_distance = 190;
  mesh.angle = -60 * units::deg;
  all.unit.meshes = {mesh};
  return all;
}

inline constexpr PerGear<GearBodyIn> on_shafts{GearBodyIn::Shaft, GearBodyIn::Shaft};

inline std::vector<ContactPoint> unit_points(const GearPair& pair) {
  return contact_points(pair, PathOfContact(pair), {QuadratureRule::Gauss2, 4}, 1.2, true, -37, 37);
}

}  // namespace unit_cases
