#include "studies/exchange/rexs/unit_scaling.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace flankwright::studies::rexs {

using Eigen::Vector3d;

void mark_constant_loads(UnitData& reference, const std::vector<UnitData>& others) {
  constexpr double rounded = 1e-3;  // of the force and of the moment: they come rounded
  const auto at_other_torque = [&](const UnitData& unit) {
    return std::abs(unit.reference_torque - reference.reference_torque) > rounded * reference.reference_torque;
  };
  if (std::ranges::none_of(others, at_other_torque)) return;
  for (UnitLoad& load : reference.loads) {
    const auto is_same = [&](const UnitLoad& other) {
      return other.shaft == load.shaft && other.position == load.position && (other.force - load.force).norm() <= rounded * load.force.norm() &&
             (other.moment - load.moment).norm() <= rounded * load.moment.norm();
    };
    load.constant =
        load.moment.z() == 0.0 && std::ranges::all_of(others, [&](const UnitData& unit) { return std::ranges::any_of(unit.loads, is_same); });
  }
}

bool are_scaled(const UnitData& unit, const UnitData& reference) {
  constexpr double rounded = 1e-3;  // of the largest force, moment or torque: they come rounded
  const double scale = unit.reference_torque / reference.reference_torque;
  std::map<std::pair<std::string, double>, std::pair<Vector3d, Vector3d>> left;  // by shaft and position
  double force = 0.0, moment = 0.0;
  const auto add = [&](const UnitData& from, double sign, double scaled) {
    for (const UnitLoad& load : from.loads) {
      const double factor = sign * (load.constant ? 1.0 : scaled);
      auto& [forces, moments] = left.try_emplace({load.shaft, load.position}, Vector3d::Zero(), Vector3d::Zero()).first->second;
      forces += factor * load.force;
      moments += factor * load.moment;
      force = std::max(force, load.force.norm());
      moment = std::max(moment, load.moment.norm());
    }
  };
  add(unit, 1.0, 1.0);
  add(reference, -1.0, scale);
  const bool loads_scale = std::ranges::all_of(
      left, [&](const auto& load) { return load.second.first.norm() <= rounded * force && load.second.second.norm() <= rounded * moment; });
  bool torques_scale = true;
  for (std::size_t i = 0; i < unit.meshes.size(); ++i) {
    const double own = unit.meshes[i].torque, expected = scale * reference.meshes[i].torque;
    torques_scale = torques_scale && (std::isnan(own) == std::isnan(expected)) && !(std::abs(own - expected) > rounded * std::abs(own));
  }
  return loads_scale && torques_scale;
}

}  // namespace flankwright::studies::rexs
