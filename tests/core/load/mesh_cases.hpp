#pragma once

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <utility>

#include "core/rating/contact_peaks.hpp"
#include "core/load/cycle/mesh_cycle.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/core/gear/pair_cases.hpp"

/// Gear pairs and readings of a loaded cycle that several tests share.
namespace flankwright::mesh_cases {

inline const Material steel{};

using pair_cases::pair;
using pair_cases::pair_data;

inline MeshModel model(const GearPair& gears, const MeshResolution& resolution, const MeshEffects& effects = {}) {
  return make_mesh_model(gears, {steel, steel}, resolution, effects);
}

/// The pair's mesh at whatever phases are asked for.
inline MeshAt mesh_of(const GearPair& gears, const Quadrature& quadrature = {QuadratureRule::Graded, 5}) {
  return [gears, quadrature](const std::vector<double>& phases) { return model(gears, {quadrature, phases}); };
}

/// Torque on the pinion that gives a mean line load over b / cos(beta_b) [N mm].
inline double torque_for(const GearPair& gears, double line_load) { return line_load * gears.face_width * gears.pinion.base_radius; }

/// A condition with something of everything.
inline FlankCondition worked_condition() {
  FlankCondition condition;
  condition.modification.pinion.lead_crowning = 6 * units::um;
  condition.modification.pinion.lead_slope = -4 * units::um;
  condition.modification.pinion.tip_relief = {10 * units::um, 0.4, ReliefShape::Linear};
  condition.modification.pinion.twist = 3 * units::um;
  condition.modification.wheel.addendum_crowning = 5 * units::um;
  condition.modification.wheel.end_relief = {8 * units::um, 1.0};
  condition.error.pinion.helix_slope = 3 * units::um;
  condition.error.wheel.profile_slope = -2 * units::um;
  condition.misalignment.mesh_misalignment = 9 * units::um;
  condition.misalignment.crossing = 20 * units::arcsec;
  condition.misalignment.intersecting = -30 * units::arcsec;
  condition.misalignment.centre_distance = 0.02;
  return condition;
}

/// The condition with one parameter of its modifications moved.
inline FlankCondition moved(FlankCondition condition, const GearParameter& parameter, double by) {
  Modification& modification = condition.modification[parameter.member];
  set(modification, parameter.parameter, get(modification, parameter.parameter) + by);
  return condition;
}

/// Line loads of a position by tooth pair and axial position in whole micrometres, so that positions can be compared
/// point by point; z is mirrored and teeth counted backwards where asked.
using Loads = std::map<std::pair<int, long>, double>;
inline Loads loads_by_point(const MeshPosition& at, const LoadedPosition& loaded, int z_sign = 1, int tooth_sign = 1) {
  Loads loads;
  for (std::size_t i = 0; i < at.points.size(); ++i) {
    loads[{tooth_sign * at.points[i].tooth, z_sign * std::lround(at.points[i].z / units::um)}] = loaded.load.line_load[static_cast<Eigen::Index>(i)];
  }
  return loads;
}

/// Largest difference of two positions' line loads [N/mm]; a point that only one of them has counts as unloaded in the
/// other.
inline double largest_difference(const Loads& a, const Loads& b) {
  double largest = 0.0;
  for (const auto& [point, load] : a) {
    const auto other = b.find(point);
    largest = std::max(largest, std::abs(load - (other == b.end() ? 0.0 : other->second)));
  }
  for (const auto& [point, load] : b) {
    if (a.find(point) == a.end()) largest = std::max(largest, load);
  }
  return largest;
}

}  // namespace flankwright::mesh_cases
