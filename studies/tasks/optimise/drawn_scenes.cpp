#include "studies/tasks/optimise/drawn_scenes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "optimize/sampling/sample_design.hpp"
#include "studies/study_file/scene_placement.hpp"
#include "studies/study_file/sweep_value.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

namespace {

/// What the scene has where values are added to it; misalignments only.
double present(const Scene& scene, const std::string& path) {
  for (const NamedMisalignmentParameter& p : misalignment_parameters) {
    if (path == "misalignment." + std::string(p.name)) return scene.misalignment.*(p.parameter);
  }
  return 0.0;
}

void put(Scene& scene, const SceneTolerance& tolerance, double value) {
  const SchemaKey& key = *study_keys().at(tolerance.path);
  if (tolerance.pitch) return set_drawn_pitch(scene.error[key.member], *tolerance.pitch, value);
  double inside = internal_value(value, key.quantity);
  if (tolerance.added) inside += present(scene, tolerance.path);
  if (const auto* parameter = std::get_if<ModificationParameter>(&key.store)) {
    scene.deviations.push_back({key.member, *parameter, inside});
    return;
  }
  std::get<StoreInScene>(key.store)(scene, key.member, Value{.number = inside, .numbers = {inside}});
}

bool is_accepted(const Scene& scene, const SceneTolerance& tolerance, double value) {
  const SchemaKey& key = *study_keys().at(tolerance.path);
  if (tolerance.pitch) return true;
  if (std::holds_alternative<ModificationParameter>(key.store)) return std::abs(value) <= key.range.high;
  return is_in_range(key, tolerance.added ? value + outside_value(present(scene, tolerance.path), key.quantity) : value);
}

bool are_of_same_state(const Scene& a, const Scene& b, WorkingFlank of_pair) {
  const bool same_speed = a.speed == b.speed || (std::isnan(a.speed) && std::isnan(b.speed));
  return a.torques == b.torques && same_speed && a.working_flank.value_or(of_pair) == b.working_flank.value_or(of_pair);
}

}  // namespace

std::vector<OperatingState> operating_states(const Study& study, const std::vector<SceneTolerance>& tolerances) {
  // What is drawn is no part of a state: every scene has the same value of it here.
  const auto with_medians = [&](Scene scene) {
    for (const SceneTolerance& tolerance : tolerances) put(scene, tolerance, tolerance.distribution.quantile(0.5));
    return scene;
  };
  std::vector<Scene> compared;
  std::vector<OperatingState> states;
  for (const Scene& scene : study.scenes) {
    const Scene drawn = with_medians(scene);
    const auto known = std::ranges::find_if(compared, [&](const Scene& other) { return are_of_same_state(drawn, other, study.pair.working_flank); });
    if (known == compared.end()) {
      compared.push_back(drawn);
      states.push_back({scene, scene.weight});
    } else {
      states[static_cast<std::size_t>(known - compared.begin())].weight += scene.weight;
    }
  }
  const double first = states.front().weight;
  for (OperatingState& state : states) state.weight /= first;
  return states;
}

std::vector<Scene> draw_scenes(const Study& study, const DrawnScenes& drawn) { return draw_scenes(study, study.tolerances, drawn); }

std::vector<Scene> draw_scenes(const Study& study, const std::vector<SceneTolerance>& tolerances, const DrawnScenes& drawn) {
  std::vector<Scene> scenes;
  if (drawn.samples == 0) return scenes;
  const std::vector<OperatingState> states = operating_states(study, tolerances);
  const SampleDesign design(Sampler::Sobol, drawn.samples, static_cast<int>(tolerances.size()), drawn.seed);
  for (int i = 0; i < drawn.samples; ++i) {
    const std::vector<double> point = design.point(i);
    for (const OperatingState& state : states) {
      Scene scene = state.scene;
      scene.name = states.size() == 1 ? name_of_draw(i) : name_of_draw(i) + ", " + state.scene.name;
      scene.weight = state.weight;
      scene.draw = i;
      for (std::size_t k = 0; k < tolerances.size(); ++k) put(scene, tolerances[k], tolerances[k].distribution.quantile(point[k]));
      scenes.push_back(std::move(scene));
    }
  }
  return scenes;
}

Scene widest_scene(const Study& study) {
  Scene scene = study.scenes.front();
  for (const SceneTolerance& tolerance : study.tolerances) put(scene, tolerance, tolerance.distribution.widest());
  return scene;
}

std::optional<RefusedDraw> find_refused_draw(const Study& study, const DrawnScenes& drawn) {
  const std::vector<SceneTolerance>& tolerances = study.tolerances;
  if (drawn.samples == 0 || tolerances.empty()) return std::nullopt;
  const std::vector<OperatingState> states = operating_states(study, tolerances);
  const SampleDesign design(Sampler::Sobol, drawn.samples, static_cast<int>(tolerances.size()), drawn.seed);
  const GearPair pair = make_gear_pair(study.pair);
  for (int i = 0; i < drawn.samples; ++i) {
    const std::vector<double> point = design.point(i);
    for (std::size_t k = 0; k < tolerances.size(); ++k) {
      const double value = tolerances[k].distribution.quantile(point[k]);
      const auto refuses = [&](const OperatingState& state) { return !is_accepted(state.scene, tolerances[k], value); };
      if (std::ranges::any_of(states, refuses))
        return RefusedDraw{tolerances[k].path, i, value, allowed_values(*study_keys().at(tolerances[k].path))};
    }
    for (const OperatingState& state : states) {
      Scene scene = state.scene;
      for (std::size_t k = 0; k < tolerances.size(); ++k) put(scene, tolerances[k], tolerances[k].distribution.quantile(point[k]));
      const std::vector<PlacementProblem> problems = placement_problems(pair, scene.misalignment);
      if (!problems.empty()) return RefusedDraw{problems.front().key, i, problems.front().value, problems.front().allowed};
    }
  }
  return std::nullopt;
}

std::string name_of_draw(int draw) { return "drawn " + std::to_string(draw + 1); }

std::string load_cases_in_words(const Study& study) {
  const std::vector<OperatingState> states = operating_states(study, study.tolerances);
  std::vector<std::string> names;
  std::ptrdiff_t load_cases = 0;
  const bool is_summed = Objective{study.table<OptimiseTable>().objective, {}}.over_spectrum();  // the load spectrum is then one load case
  for (const OperatingState& state : states) {
    names.push_back(state.scene.name);
    load_cases += is_summed ? 1 : std::ranges::count_if(state.scene.torques, [](double torque) { return torque > 0.0; });
  }
  if (load_cases <= 1) return "";
  const bool has_torques = load_cases > std::ssize(states), has_states = states.size() > 1;
  std::string words = ", each";
  if (has_states) words += fmt::format(" in {} operating states ({})", states.size(), fmt::join(names, ", "));
  if (has_torques) words += fmt::format(" with {} load cases", load_cases);
  const Aggregation& within = study.table<OptimiseTable>().over;
  if (within == Aggregate::Worst) return words + ", the worst of which counts";
  if (within == Aggregate::Nominal) return words + ", the first of which counts";
  return words + ", of which the " + to_string(within) + " counts";
}

}  // namespace flankwright::studies
