#include "studies/tasks/optimise/scatter_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "core/gear/flank_tolerances.hpp"
#include "optimize/sampling/sobol_sequence.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

namespace {

constexpr const char* scatter_name = "optimise.scatter";

SceneTolerance within(const std::string& path, double tolerance, int tolerance_class, bool added) {
  const double um = tolerance / units::um;
  SceneTolerance made{path,
                      fmt::format("ISO 1328-1 class {}: normal, mean 0, deviation {:.4g}, cut off at \u00b1{:.4g}", tolerance_class, um / 3.0, um),
                      Distribution::within_tolerance(um),
                      added,
                      {}};
  made.of_class = true;
  return made;
}

void check_statistic(StudyReading& reading) {
  const std::string names[]{"quantile", "cvar", "mean_plus_sigma"};
  int given = 0;
  for (const std::string& name : names) {
    const std::string path = std::string(scatter_name) + ".statistic." + name;
    if (reading.find(path) != nullptr && ++given > 1) reading.refuse_key(path, "another statistic is given as well: allowed is one of them");
  }
}

/// The statistic of a draw's output is bounded from above. A lower limit bounds that of its reciprocal.
void check_over_draws(StudyReading& reading, const OutputConstraint& bound) {
  const DesignOutput& row = design_output(bound.output.output);
  const std::string key = "optimise.constraints." + bound.output.name;
  if (bound.is_least() && !(has_reciprocal(row) && bound.minimum > 0.0)) {
    reading.refuse_key(
        key,
        "with optimise.scatter a lower limit bounds the reciprocal of an output in the draws, and this output may be 0 there or has no "
        "smooth reciprocal: allowed is { max = ... }");
  }
  if (!bound.is_least() && row.is_least) {
    reading.refuse_key(
        key,
        "with optimise.scatter the largest value of an output in a draw is bounded, and this output is the least of its values: allowed "
        "is { min = ... }");
  }
}

/// Each class is searched for once.
void check_classes(StudyReading& reading) {
  const std::string path = std::string(scatter_name) + ".classes";
  const auto* match = reading.find(path);
  if (match == nullptr || !match->node->is_array()) return;
  const std::vector<int>& classes = reading.builder.study.table<OptimiseTable>().scatter.classes;
  const bool repeats = std::set<int>(classes.begin(), classes.end()).size() < classes.size();
  const bool has_parts = std::ranges::any_of(*match->node->as_array(), [](const toml::node& entry) { return !entry.is_integer(); });
  if (repeats || has_parts) reading.refuse_key(path, "allowed are integers 1 .. 11, each once");
}

/// A seed that is not given is the first from its usual one on that makes other draws.
void settle_seeds(StudyReading& reading) {
  ScatterTable& scatter = reading.builder.study.table<OptimiseTable>().scatter;
  const auto is_given = [&](const char* key) { return reading.find(std::string(scatter_name) + "." + key) != nullptr; };
  const auto settle = [&](const char* key, unsigned long& seed, unsigned long one, unsigned long other) {
    while (!is_given(key) && (seed == one || seed == other)) ++seed;
  };
  settle("fresh_seed", scatter.fresh_seed, scatter.seed, is_given("predicted_seed") ? scatter.predicted_seed : scatter.seed);
  settle("predicted_seed", scatter.predicted_seed, scatter.seed, scatter.fresh_seed);
}

void check_task(StudyReading& reading) {
  const OptimiseTable& optimise = reading.builder.study.table<OptimiseTable>();
  const auto refuse = [&](const std::string& path, const char* allowed) { reading.refuse_key(path, allowed); };
  if (!optimise.later_objectives.empty()) refuse("optimise.objective", "one objective with optimise.scatter, no list");
  if (!optimise.pareto_objectives.empty()) refuse("optimise.pareto.objectives", "none with optimise.scatter");
  for (const OutputConstraint& bound : optimise.constraints) check_over_draws(reading, bound);
  check_classes(reading);
  const ScatterTable& asked = optimise.scatter;
  if (asked.predicted_from > 0 && (asked.predicted_seed == asked.seed || (asked.fresh > 0 && asked.predicted_seed == asked.fresh_seed))) {
    refuse("optimise.scatter.predicted_seed", "makes the same draws as another seed: allowed is another than optimise.scatter.seed and fresh_seed");
  }
  if (optimise.scatter.fresh > 0 && optimise.scatter.fresh_seed == optimise.scatter.seed) {
    refuse("optimise.scatter.fresh_seed", "that of the search makes the same draws: allowed is another than optimise.scatter.seed");
  }
}

}  // namespace

std::vector<SceneTolerance> class_tolerances(const GearPair& pair, int tolerance_class) {
  std::vector<SceneTolerance> all;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const ToleranceData data = ToleranceData::of(pair, member);
    const FlankTolerances t = flank_tolerances(data, tolerance_class);
    const std::string gear(name_of(member));
    all.push_back(within(gear + ".error.helix_slope", t.helix_slope, tolerance_class, false));
    all.push_back(within(gear + ".error.profile_slope", t.profile_slope, tolerance_class, false));
    all.push_back({gear + ".error.pitch",
                   fmt::format("ISO 1328-1 class {}: a gear drawn tooth by tooth, single pitch within \u00b1{:.4g} um, cumulative within {:.4g} um",
                               tolerance_class, t.single_pitch / units::um, t.cumulative_pitch / units::um),
                   Distribution::uniform(0.0, 0x1p32), false, PitchTolerance{data.teeth, t.single_pitch, t.cumulative_pitch}});
    all.back().of_class = true;
    all.push_back(within(gear + ".modification.lead_crowning", t.helix_form, tolerance_class, true));
    all.push_back(within(gear + ".modification.profile_crowning", t.profile_form, tolerance_class, true));
  }
  return all;
}

std::vector<SceneTolerance> with_class(const std::vector<SceneTolerance>& tolerances, const GearPair& pair, int tolerance_class) {
  std::vector<SceneTolerance> all;
  std::ranges::copy_if(tolerances, std::back_inserter(all), [](const SceneTolerance& t) { return !t.of_class; });
  for (SceneTolerance& t : class_tolerances(pair, tolerance_class)) {
    if (std::ranges::find(all, t.path, &SceneTolerance::path) == all.end()) all.push_back(std::move(t));
  }
  std::ranges::stable_partition(all, [](const SceneTolerance& t) { return !t.added; });
  return all;
}

void read_scatter(StudyReading& reading) {
  Study& study = reading.builder.study;
  const ScatterTable& scatter = study.table<OptimiseTable>().scatter;
  check_statistic(reading);
  if (!scatter.asked()) {
    const auto refuse_without_draws = [&](const char* key) {
      reading.refuse_key(std::string(scatter_name) + "." + key, "has a meaning with optimise.scatter.draws above 0 only");
    };
    for (const char* key : {"iso_1328_class", "classes"}) {
      if (reading.find(std::string(scatter_name) + "." + key) != nullptr) refuse_without_draws(key);
    }
    if (scatter.fresh > 0) refuse_without_draws("fresh");
    return;
  }
  settle_seeds(reading);
  check_task(reading);
  const PairData& data = study.pair;
  if (!reading.problems.empty() || !find_problems(data).empty()) return;
  const GearPair pair = make_gear_pair(data);
  std::vector<int> classes = scatter.classes;
  if (study.tolerance_class) classes.insert(classes.begin(), *study.tolerance_class);
  try {
    for (const int c : classes) class_tolerances(pair, c);
    if (study.tolerance_class) study.tolerances = with_class(study.tolerances, pair, *study.tolerance_class);
  } catch (const InvalidInput& problem) {
    return reading.refuse_key("optimise.scatter.iso_1328_class",
                              "a gear that ISO 1328-1 covers: " + problem.field() + " is " + problem.value() + ", covered is " + problem.allowed());
  }
  if (study.tolerances.empty()) {
    reading.refuse_key("optimise.scatter.draws", "set optimise.tolerances or optimise.scatter.iso_1328_class: the draws are made from them");
  }
  constexpr int of_class = 10;  // coordinates that a class adds at most
  if (static_cast<int>(study.tolerances.size()) + (scatter.classes.empty() ? 0 : of_class) > sobol_dimensions) {
    reading.refuse_key(scatter_name, "at most " + std::to_string(sobol_dimensions) + " quantities that scatter");
  }
}

}  // namespace flankwright::studies
