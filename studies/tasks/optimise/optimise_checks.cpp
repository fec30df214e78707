#include "studies/tasks/optimise/optimise_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "optimize/solvers/solver.hpp"
#include "studies/compliance/study_compliance.hpp"
#include "studies/tasks/optimise/drawn_scenes.hpp"
#include "studies/study_file/left_out_effects.hpp"
#include "studies/study_file/study_life.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

bool minimises_root_stress(const Study& study) {
  const auto is_root_stress = [](const ObjectiveTerm& term) { return design_output(term.output).of_roots; };
  const auto in_objective = [&](const Objective& objective) { return std::ranges::any_of(objective.terms, is_root_stress); };
  const OptimiseTable& optimise = study.table<OptimiseTable>();
  return std::ranges::any_of(optimise.objective, is_root_stress) ||
         std::ranges::any_of(optimise.constraints, is_root_stress, &OutputConstraint::output) ||
         std::ranges::any_of(optimise.later_objectives, in_objective) || std::ranges::any_of(optimise.pareto_objectives, in_objective);
}

void check_variables(StudyReading& reading) {
  const OptimiseTable& optimise = reading.builder.study.table<OptimiseTable>();
  const auto is_variable = [&](const std::string& path) {
    return std::ranges::any_of(optimise.variables, [&](const DesignVariable& v) { return v.path == path; });
  };
  for (const ExclusiveKeys& keys : exclusive_keys()) {
    if (!is_variable(keys.first) || !is_variable(keys.second)) continue;
    reading.refuse_key("optimise.variables." + keys.second, "overlaps the variable " + keys.first + "; allowed is one of them");
  }
}

namespace {

/// All terms of an optimisation, each with the key that names it.
std::vector<std::pair<std::string, ObjectiveTerm>> all_terms(const OptimiseTable& optimise) {
  std::vector<std::pair<std::string, ObjectiveTerm>> terms;
  const auto add = [&](const char* key, const std::vector<ObjectiveTerm>& of) {
    for (const ObjectiveTerm& term : of) terms.emplace_back(key, term);
  };
  add("optimise.objective", optimise.objective);
  for (const Objective& objective : optimise.later_objectives) add("optimise.objective", objective.terms);
  for (const Objective& objective : optimise.pareto_objectives) add("optimise.pareto.objectives", objective.terms);
  for (const OutputConstraint& bound : optimise.constraints) terms.emplace_back("optimise.constraints." + bound.output.name, bound.output);
  return terms;
}

/// Sums over the load spectrum are not added to what each load case has by itself.
void check_sums(StudyReading& reading, const char* key, const std::vector<ObjectiveTerm>& terms) {
  const auto over_spectrum = [](const ObjectiveTerm& term) { return design_output(term.output).over_spectrum; };
  if (std::ranges::any_of(terms, over_spectrum) && !std::ranges::all_of(terms, over_spectrum)) {
    reading.refuse_key(
        key, "adds damage, a sum over the load spectrum, to an output of each load case: allowed is a list of both, or a constraint on one");
  }
}

/// A sharp edge carries load, but its pressure has no bound and is left out of the stress; without the effect no edge has a stress.
void check_edge_outputs(StudyReading& reading) {
  const PairData& pair = reading.builder.study.pair;
  const Fidelity& fidelity = reading.builder.study.fidelity;
  const bool has_effect = fidelity.automatic_effects || std::ranges::find(fidelity.effects, "edge_contact") != fidelity.effects.end();
  for (const auto& [key, term] : all_terms(reading.builder.study.table<OptimiseTable>())) {
    if (term.output != Output::EdgeStress && term.output != Output::TipEdgeShare) continue;
    if (!has_effect)
      return reading.refuse_key(key, term.name + " needs the effect edge_contact: fidelity.effects = \"auto\" or a list with \"edge_contact\"");
    if (term.output != Output::EdgeStress) continue;
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      if (pair[m].tip_rounding == 0.0)
        return reading.refuse_key(key, term.name + " needs rounded tip edges: " + name_of(m) + ".edges.tip_rounding above 0");
    }
  }
}

/// A harmonic needs evenly spaced positions, more than two to a period.
void check_harmonics(StudyReading& reading) {
  const Cycle& cycle = reading.builder.study.cycle;
  const bool is_even = cycle.phases.empty() || cycle.phases == equally_spaced_phases(static_cast<int>(cycle.phases.size()));
  for (const auto& [key, term] : all_terms(reading.builder.study.table<OptimiseTable>())) {
    if (term.output != Output::TeHarmonic) continue;
    if (!is_even) return reading.refuse_key("cycle.phases", "allowed is cycle.positions instead for " + term.name);
    const int least = 2 * term.harmonic + 1;
    if (cycle.phases.empty() && cycle.positions < least)
      return reading.refuse_key("cycle.positions", fmt::format("allowed is at least {} for {}", least, term.name));
  }
}

/// Whether the speed of the study or something of its spectrum is given, but refused already.
bool has_refused_load(const StudyReading& reading) {
  return std::ranges::any_of(reading.problems,
                             [](const StudyProblem& problem) { return problem.key == "load.speed" || problem.key.starts_with("load.spectrum"); });
}

/// What damage, loss and film need must be given.
void check_life_outputs(StudyReading& reading) {
  const Study& study = reading.builder.study;
  const auto refuse = [&](const std::string& key, const ObjectiveTerm& term, const char* needs) {
    reading.refuse_key(key, term.name + " is asked for and needs " + needs);
  };
  check_sums(reading, "optimise.objective", study.table<OptimiseTable>().objective);
  for (const Objective& objective : study.table<OptimiseTable>().later_objectives) check_sums(reading, "optimise.objective", objective.terms);
  const std::shared_ptr<const LifeModel> life = life_model(study);
  const auto named = [&](const char* table) { return reading.find(std::string(table) + "material.strength.kind") != nullptr; };
  const bool is_named = named("") || named("pinion.") || named("wheel.");  // and has curves, or was refused already
  const auto has_curve = [&](auto FatigueStrength::*kind) {
    return is_named || (life && (life->strength.pinion.*kind || life->strength.wheel.*kind));
  };
  for (const auto& [key, term] : all_terms(study.table<OptimiseTable>())) {
    const DesignOutput& row = design_output(term.output);
    if (row.is_least && !key.starts_with("optimise.constraints."))
      reading.refuse_key(
          key,
          term.name +
              " is better where it is large: allowed is { min = ... } in optimise.constraints, or micropitting_utilisation as what is minimised");
    if (row.over_spectrum && study.spectrum.empty()) refuse(key, term, "load.spectrum, which is not given");
    const bool of_flanks = term.output == Output::ContactDamage || term.output == Output::ContactUtilisation;
    const bool of_roots = term.output == Output::RootDamage || term.output == Output::RootUtilisation;
    if (of_flanks && !has_curve(&FatigueStrength::contact)) {
      refuse(key, term, "material.strength or material.contact_endurance_limit, neither of which is given");
    }
    if (of_roots && !has_curve(&FatigueStrength::root))
      refuse(key, term, "material.strength or material.root_endurance_limit, neither of which is given");
    if (term.output == Output::MicropittingUtilisation && !(study.life.permissible_film > 0.0)) {
      refuse(key, term, "lubricant.permissible_film, which is not given");
    }
    if (term.output == Output::ScuffingUtilisation && std::isnan(study.life.scuffing_temperature)) {
      refuse(key, term, "lubricant.scuffing_temperature, which is not given");
    }
    if (!row.needs_oil) continue;
    if (!study.life.has_lubricant) refuse(key, term, "a table [lubricant], which is not given");
    if (has_refused_load(reading)) continue;
    const auto no_speed = [](const auto& of) { return std::isnan(of.speed); };
    if (study.spectrum.empty() ? std::ranges::any_of(study.scenes, no_speed) : std::ranges::any_of(study.spectrum, no_speed)) {
      refuse(key, term, "load.speed, or a speed in every bin of the spectrum, which is not given");
    }
  }
  const bool moves = std::ranges::any_of(study.spectrum, [](const SpectrumBin& bin) { return bin.mesh_misalignment != 0.0; });
  if (moves && study.fidelity.gap == GapModel::WholeSurface) {
    reading.refuse_key("fidelity.gap",
                       "a bin of the spectrum has a misalignment of its own: allowed is \"plane_of_action\", whose points do not move with it");
  }
}

/// Every value that will be drawn is one that its key accepts; where the rest of the study is right.
void check_draws(StudyReading& reading) {
  if (!reading.problems.empty()) return;
  const Study& study = reading.builder.study;
  const AssessmentTable& assessment = study.table<OptimiseTable>().assessment;
  const ScatterTable& scatter = study.table<OptimiseTable>().scatter;
  std::vector<DrawnScenes> all{assessment.scenes, assessment.validation};
  if (scatter.asked()) {
    all.insert(all.end(), {{scatter.draws, scatter.seed}, {scatter.predicted_from, scatter.predicted_seed}, {scatter.fresh, scatter.fresh_seed}});
  }
  for (const DrawnScenes& drawn : all) {
    const std::optional<RefusedDraw> refused = find_refused_draw(study, drawn);
    if (!refused) continue;
    return reading.refuse_key("optimise.tolerances." + refused->path, fmt::format("draw {} of {} has {:.6g}: allowed is {}", refused->draw + 1,
                                                                                  drawn.samples, refused->value, refused->allowed));
  }
}

}  // namespace

void check_optimise(StudyReading& reading) {
  const Study& study = reading.builder.study;
  const Match* variables = reading.find("optimise.variables");
  const bool has_entry = variables != nullptr && (!variables->node->is_table() || !variables->node->as_table()->empty());
  if (!has_entry) reading.refuse_key("optimise.variables", "task \"optimise\" needs at least one variable");
  for (const DesignVariable& v : study.table<OptimiseTable>().variables) require_effect_of(reading, "optimise.variables." + v.path, v.path);
  for (const LinkingConstraint& link : study.table<OptimiseTable>().links)
    require_effect_of(reading, "optimise.ties." + link.linked.path, link.linked.path);
  const bool draws_scenes = study.table<OptimiseTable>().assessment.scenes.samples > 0;
  if (draws_scenes && std::ranges::any_of(study.scenes, [](const Scene& scene) { return scene.name.starts_with("drawn "); })) {
    reading.refuse_key("scenes", "a scene has the name of one that is drawn, \"drawn 1\" and so on: allowed is another name");
  }
  for (const SceneTolerance& t : study.tolerances) {
    const std::string own = "optimise.tolerances." + t.path;  // else of a class or a clearance, which cover several
    require_effect_of(reading, reading.find(own) != nullptr ? own : "optimise.tolerances", t.path);
  }
  if (!study.table<OptimiseTable>().constraints.empty() && !accepts_constraints(study.table<OptimiseTable>().solver.name)) {
    reading.refuse_key("optimise.solver", "this solver takes no constraints; one that does: \"ipopt\"");
  }
  const bool is_elastic = study.fidelity.compliance != ComplianceModel::Rigid;
  if (!is_elastic) {
    const std::string what = minimises_root_stress(study) ? "root stress is asked for and needs" : "task \"optimise\" needs";
    reading.refuse_key("fidelity.compliance", what + " an elastic compliance: allowed is \"thin_slice\", \"fitted\" or \"fe\"");
  }
  const bool smooth =
      uses_gradients(study.table<OptimiseTable>().solver.name) && accepts_constraints(study.table<OptimiseTable>().solver.name);  // the epigraph is
  if (!study.table<OptimiseTable>().pareto_objectives.empty() && !smooth) {
    reading.refuse_key("optimise.solver",
                       "a Pareto front needs gradients and constraints: allowed is \"ipopt\", \"nlopt:slsqp\", \"nlopt:mma\" or \"nlopt:ccsaq\"");
  }
  if (study.table<OptimiseTable>().later_objectives.size() > 0 && !accepts_constraints(study.table<OptimiseTable>().solver.name)) {
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
  if (is_elastic && minimises_root_stress(study) && !wants_root_stress(study)) {
    reading.refuse_key("fidelity.effects", "root stress is asked for: allowed is \"auto\" or a list with \"root_stress\"");
  }
  check_life_outputs(reading);
  check_edge_outputs(reading);
  check_harmonics(reading);
  for (const Scene& scene : study.scenes) {
    if (std::ranges::any_of(scene.torques, [](double torque) { return torque > 0.0; })) continue;
    return reading.refuse_key("load.torque", "task \"optimise\" needs a torque above 0 in every scene: " + scene.name);
  }
  check_draws(reading);
}

}  // namespace flankwright::studies
