#include "optimize/design/problem/task_checks.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "core/base/error.hpp"
#include "core/load/cycle/mesh_model.hpp"
#include "optimize/design/outputs/design_output.hpp"

namespace flankwright {

std::vector<ObjectiveTerm> terms_of(const DesignTask& task) {
  std::vector<ObjectiveTerm> terms = task.objective;
  const auto add = [&](const Objective& objective) { terms.insert(terms.end(), objective.terms.begin(), objective.terms.end()); };
  for (const ObjectiveBound& bound : task.objective_bounds) add(bound.objective);
  for (const ScalarisedObjective& scalarised : task.scalarisation) add(scalarised.objective);
  for (const Objective& objective : task.later_objectives) add(objective);
  for (const OutputConstraint& constraint : task.constraints) terms.push_back(constraint.output);
  return terms;
}

bool asks_for_root_stress(const DesignTask& task) {
  const std::vector<ObjectiveTerm> terms = terms_of(task);
  return std::ranges::any_of(terms, [](const ObjectiveTerm& t) { return design_output(t.output).of_roots; });
}

namespace {

/// Harmonics can be separated only where positions are equally spaced over a pitch and more than two to a period.
void check_harmonics(const DesignTask& task) {
  const std::vector<double>& phases = task.resolution.phases;
  const int n = static_cast<int>(phases.size());
  const auto check = [&](const ObjectiveTerm& term) {
    if (term.output != Output::TeHarmonic) return;
    if (phases != equally_spaced_phases(n)) {
      throw InvalidInput("cycle.phases", "a list", "none for " + term.name + ": set cycle.positions");
    }
    const int least = 2 * term.harmonic + 1;
    if (n < least) {
      throw InvalidInput("cycle.positions", std::to_string(n), "at least " + std::to_string(least) + " for " + term.name);
    }
  };
  for (const ObjectiveTerm& term : terms_of(task)) check(term);
}

void check_root_stress(const DesignTask& task) {
  if (asks_for_root_stress(task) && !task.root_stress) {
    throw InvalidInput("peak_root_stress", "no model of root stress", "the effect root_stress");
  }
}

/// Sums over a load spectrum are not added to what each of its load cases has by itself, and a least value is not minimised.
void check_objective(const Objective& objective) {
  const auto over_spectrum = [](const ObjectiveTerm& term) { return design_output(term.output).over_spectrum; };
  if (objective.over_spectrum() && !std::ranges::all_of(objective.terms, over_spectrum)) {
    throw InvalidInput("optimise.objective", objective.name(),
                       "sums over the load spectrum alone, or none of them; a list or a constraint joins both");
  }
  for (const ObjectiveTerm& term : objective.terms) {
    const DesignOutput& row = design_output(term.output);
    if (row.is_least && !term.reciprocal)
      throw InvalidInput("optimise.objective", term.name, "an output that is better where it is small; bound this one");
    if (term.reciprocal && !has_reciprocal(row))
      throw InvalidInput("optimise.constraints", term.name,
                         "an upper bound: the reciprocal of the largest of several points is not the largest of theirs");
  }
}

/// The load cases of a spectrum share the points of one mesh.
void check_spectra(const DesignTask& task) {
  const std::vector<ObjectiveTerm> terms = terms_of(task);
  if (!std::ranges::any_of(terms, [](const ObjectiveTerm& term) { return design_output(term.output).over_spectrum; })) return;
  std::map<int, MeshPlacement> placements;
  for (const DesignScene& scene : task.scenes) {
    if (scene.spectrum < 0) throw InvalidInput("load.spectrum", "none", "one for a sum over it");
    const MeshPlacement placement = placement_of(task.gap, scene.condition, nullptr, scene.torque);
    if (!(placements.try_emplace(scene.spectrum, placement).first->second <=> placement == 0)) {
      throw InvalidInput("load.spectrum", "a misalignment of its own in a bin",
                         "none with the gap \"whole_surface\": its points move with the misalignment");
    }
  }
}

}  // namespace

void check(const DesignTask& task) {
  if (task.objective.empty()) throw InvalidInput("optimise.objective", "none", "at least one output");
  check_objective(task.combined_objective());
  for (const ObjectiveBound& bound : task.objective_bounds) check_objective(bound.objective);
  for (const Objective& objective : task.later_objectives) check_objective(objective);
  check_spectra(task);
  check_harmonics(task);
  check_root_stress(task);
}

}  // namespace flankwright
