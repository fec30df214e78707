#include "studies/tasks/optimise/optimise_checks.hpp"

#include <algorithm>

#include "optimize/solvers/solver.hpp"
#include "studies/compliance/study_compliance.hpp"

namespace flankwright::studies {

bool minimises_root_stress(const Study& study) {
  const auto is_root_stress = [](const ObjectiveTerm& term) { return term.output == Output::PeakRootStress; };
  const auto in_objective = [&](const Objective& objective) { return std::ranges::any_of(objective.terms, is_root_stress); };
  const OptimiseTable& optimise = study.optimise;
  return std::ranges::any_of(optimise.objective, is_root_stress) ||
         std::ranges::any_of(optimise.constraints, is_root_stress, &OutputConstraint::output) ||
         std::ranges::any_of(optimise.later_objectives, in_objective) || std::ranges::any_of(optimise.pareto_objectives, in_objective);
}

void check_variables(StudyReading& reading) {
  const OptimiseTable& optimise = reading.builder.study.optimise;
  const auto is_variable = [&](const std::string& path) {
    return std::ranges::any_of(optimise.variables, [&](const DesignVariable& v) { return v.path == path; });
  };
  for (const ExclusiveKeys& keys : exclusive_keys()) {
    if (!is_variable(keys.first) || !is_variable(keys.second)) continue;
    reading.refuse_key("optimise.variables." + keys.second, "overlaps the variable " + keys.first + "; allowed is one of them");
  }
}

void check_optimise(StudyReading& reading) {
  const Study& study = reading.builder.study;
  const Match* variables = reading.find("optimise.variables");
  const bool has_entry = variables != nullptr && (!variables->node->is_table() || !variables->node->as_table()->empty());
  if (!has_entry) reading.refuse_key("optimise.variables", "task \"optimise\" needs at least one variable");
  if (!study.optimise.constraints.empty() && !accepts_constraints(study.optimise.solver)) {
    reading.refuse_key("optimise.solver", "this solver takes no constraints; one that does: \"ipopt\"");
  }
  if (study.fidelity.compliance == ComplianceModel::Rigid) {
    reading.refuse_key("fidelity.compliance", "task \"optimise\" needs a compliance: allowed is \"thin_slice\", \"fitted\" or \"fe\"");
  }
  const bool smooth = uses_gradients(study.optimise.solver) && accepts_constraints(study.optimise.solver);  // the epigraph is
  if (!study.optimise.pareto_objectives.empty() && !smooth) {
    reading.refuse_key("optimise.solver",
                       "a Pareto front needs gradients and constraints: allowed is \"ipopt\", \"nlopt:slsqp\", \"nlopt:mma\" or \"nlopt:ccsaq\"");
  }
  if (study.optimise.later_objectives.size() > 0 && !accepts_constraints(study.optimise.solver)) {
    reading.refuse_key("optimise.solver",
                       "a list of objectives bounds the earlier ones: allowed is a solver that takes constraints, such as \"ipopt\"");
  }
  if (reading.find("optimise.finisher") != nullptr && !smooth) {
    reading.refuse_key("optimise.finisher",
                       "has a meaning with a solver of gradients and constraints only: \"ipopt\", \"nlopt:slsqp\", \"nlopt:mma\" or \"nlopt:ccsaq\"");
  }
  const Match* over = reading.find("optimise.over");
  const bool free_sigmas = over != nullptr && over->node->is_string() && over->node->as_string()->get() == "mean+sigmas";
  if (reading.find("optimise.sigmas") != nullptr && !free_sigmas) {
    reading.refuse_key("optimise.sigmas", "has a meaning with optimise.over = \"mean+sigmas\" only");
  }
  if (minimises_root_stress(study) && !wants_root_stress(study)) {
    reading.refuse_key("fidelity.effects", "peak_root_stress is asked for: allowed is \"auto\" or a list with \"root_stress\"");
  }
  for (const Scene& scene : study.scenes) {
    if (std::ranges::any_of(scene.torques, [](double torque) { return torque > 0.0; })) continue;
    return reading.refuse_key("load.torque", "task \"optimise\" needs a torque above 0 in every scene: " + scene.name);
  }
}

}  // namespace flankwright::studies
