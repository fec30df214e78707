#include "optimize/design/problem/joined_loads.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <ranges>
#include <utility>

#include "optimize/design/outputs/design_output.hpp"
#include "optimize/design/problem/task_checks.hpp"

namespace flankwright {

namespace {

/// Whether two load cases are one at different torques.
bool is_same_but_for_torque(const DesignScene& a, const DesignScene& b) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  const Operation &of_a = a.operation, &of_b = b.operation;
  return a.spectrum >= 0 && a.spectrum == b.spectrum && a.draw == b.draw && a.condition == b.condition && same(of_a.speed, of_b.speed) &&
         same(of_a.temperature, of_b.temperature) && of_a.same_teeth == of_b.same_teeth &&
         of_a.meshes_per_revolution.pinion == of_b.meshes_per_revolution.pinion &&
         of_a.meshes_per_revolution.wheel == of_b.meshes_per_revolution.wheel && of_a.application_factor == of_b.application_factor &&
         of_a.dynamic_factor == of_b.dynamic_factor;
}

/// Several load cases in one, by the power that damage grows with.
DesignScene joined(const std::vector<DesignScene>& scenes, const std::vector<std::size_t>& group, double growth) {
  DesignScene one = scenes[group.front()];
  if (group.size() == 1) return one;
  one.weight = one.operation.revolutions = one.operation.duration = 0.0;
  double sum = 0.0;
  for (const std::size_t s : group) {
    const DesignScene& of = scenes[s];
    one.weight += of.weight;
    one.operation.revolutions += of.operation.revolutions;
    one.operation.duration += of.operation.duration;
    sum += of.operation.revolutions * std::pow(of.torque, growth);
  }
  one.torque = std::pow(sum / one.operation.revolutions, 1.0 / growth);
  return one;
}

/// Of the outputs of a task that are sums over a spectrum; 0 where one is not.
double load_growth_of(const DesignTask& task) {
  double growth = 0.0;
  for (const ObjectiveTerm& term : terms_of(task)) {
    const DesignOutput& output = design_output(term.output);
    if (!output.over_spectrum) return 0.0;
    growth = std::max(growth, output.load_growth);
  }
  return growth;
}

}  // namespace

std::vector<double> JoinedLoads::of_scenes(const std::vector<double>& of_joined) const {
  std::vector<double> values;
  for (const std::size_t s : joined_into) values.push_back(of_joined[s]);
  return values;
}

JoinedLoads with_joined_loads(DesignTask task, double widest) {
  const std::vector<DesignScene> scenes = std::exchange(task.scenes, {});
  const double growth = load_growth_of(task);
  std::vector<std::size_t> by_torque(scenes.size());
  std::iota(by_torque.begin(), by_torque.end(), std::size_t{0});
  std::ranges::stable_sort(by_torque, std::ranges::greater{}, [&](std::size_t s) { return scenes[s].torque; });
  std::vector<std::vector<std::size_t>> groups;  // each from its largest torque down
  for (const std::size_t s : by_torque) {
    const auto takes = [&](const std::vector<std::size_t>& group) {
      const DesignScene& largest = scenes[group.front()];
      return growth > 0.0 && scenes[s].operation.revolutions > 0.0 && largest.torque <= widest * scenes[s].torque &&
             is_same_but_for_torque(largest, scenes[s]);
    };
    const auto found = std::ranges::find_if(groups, takes);
    (found != groups.end() ? *found : groups.emplace_back()).push_back(s);
  }
  // In the order of the scenes, of which the first is the nominal one.
  std::ranges::sort(groups, {}, [](const std::vector<std::size_t>& group) { return std::ranges::min(group); });
  JoinedLoads result{std::move(task), std::vector<std::size_t>(scenes.size())};
  for (const std::vector<std::size_t>& group : groups) {
    for (const std::size_t s : group) result.joined_into[s] = result.task.scenes.size();
    result.task.scenes.push_back(joined(scenes, group, growth));
  }
  std::map<int, int> loads;
  for (const DesignScene& scene : result.task.scenes) ++loads[scene.spectrum];
  for (DesignScene& scene : result.task.scenes) {
    if (scene.spectrum >= 0) scene.spectrum_loads = loads[scene.spectrum];
  }
  return result;
}

}  // namespace flankwright
