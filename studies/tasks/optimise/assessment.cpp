#include "studies/tasks/optimise/assessment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"
#include "optimize/design/search/design_log.hpp"
#include "optimize/design/two_level.hpp"
#include "optimize/design/scatter/draws.hpp"
#include "studies/base/plain_names.hpp"
#include "studies/tasks/optimise/drawn_scenes.hpp"
#include "studies/tasks/optimise/listed_scenes.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

namespace {

std::vector<VariantSearch> search_all_variants(const DesignProblem& problem, double budget, const ProgressReport& progress) {
  std::vector<VariantSearch> searches;
  for (const LevelPlacement placement : {LevelPlacement::BoundToBound, LevelPlacement::Middles}) {
    searches.push_back(search_variants(problem, placement, std::max<std::int64_t>(1, std::llround(budget)), [&](int done, int total) {
      if (progress) progress("trying variants", done, total, to_string(placement));
    }));
  }
  return searches;
}

/// What the optimum is of: the objective, of a list the last one by its name.
std::string objective_of(const DesignTask& task) { return task.objective_bounds.empty() ? "objective" : plain_name(task.objective_name()); }

std::string scene_in_words(const Optimum::Scene& scene, const DesignTask& task, bool names_torque) {
  const DesignScene& of_task = task.scenes[static_cast<std::size_t>(scene.scene)];
  const std::string torque = names_torque ? fmt::format(", {:.5g} N·m,", of_task.torque / units::newton_metre) : "";
  if (scene.weight < 0.0) {  // of a mean + k sigma: it lies below the mean
    return fmt::format(
        "A larger value in the scene \"{}\"{} would lower the {}, with weight {:.2f}: it would lower the spread more than it raises the mean.",
        of_task.name, torque, objective_of(task), scene.weight);
  }
  const std::string of_list = task.objective_bounds.empty() ? "" : fmt::format(" the {}", objective_of(task));
  return fmt::format("The scene \"{}\"{} governs{} with weight {:.2f}.", of_task.name, torque, of_list, scene.weight);
}

/// By how much moving a limit would reduce the objective, where that is more than the optimum is known to. It is counted by the slope. A step is too
/// large for that where the objective would fall by a third or more, as damages do, which grow with high powers of the loads.
std::string gain_in_words(double gain, const std::string& move, const Optimum& optimum, const DesignTask& task) {
  if (!(std::abs(gain) > optimum.resolution)) return fmt::format("{} would not reduce the {}.", move, objective_of(task));
  constexpr double far = 1.0 / 3.0;
  if (std::abs(gain) > far * std::abs(optimum.value))
    return fmt::format("{} would reduce the {}; the step is too large for its slope to tell by how much.", move, objective_of(task));
  return fmt::format("{} would reduce the {} by {:.2g}{}.", move, objective_of(task), -gain, behind_number(task.objective_unit()));
}

std::string bound_in_words(const Optimum::Bound& bound, const Optimum& optimum, const DesignTask& task) {
  const DesignVariable& v = task.variables[static_cast<std::size_t>(bound.variable)];
  const double limit = (bound.upper ? v.upper : v.lower) * v.outside_factor();
  const double step = assessment_step(v.unit());
  const std::string stands =
      fmt::format("The {} is at its {} bound, {:.4g}{}", plain_name(v.path), bound.upper ? "upper" : "lower", limit, behind_number(v.unit()));
  return gain_in_words(bound.gain, fmt::format("{}: a further {:.2g}{}", stands, step, behind_number(v.unit())), optimum, task);
}

std::string constraint_in_words(const Optimum::Constraint& constraint, const Optimum& optimum, const DesignTask& task) {
  const OutputConstraint& c = task.constraints[static_cast<std::size_t>(constraint.constraint)];
  const std::string move = fmt::format("The constraint {} {} {:.4g}{} is active: a limit one per cent {}", plain_name(c.output.name),
                                       c.is_least() ? ">=" : "<=", c.limit() * c.output.outside_factor(), behind_number(c.output.unit()),
                                       c.is_least() ? "lower" : "higher");
  return gain_in_words(constraint.gain, move, optimum, task);
}

std::string sum_in_words(const Optimum::Sum& sum, const Optimum& optimum, const DesignTask& task) {
  const ModificationConstraint& c = task.modification_constraints[static_cast<std::size_t>(sum.constraint)];
  if (c.grinding == GrindingLimit::Slope) {
    const std::string relief =
        plain_name(std::string(name_of(c.terms[0].member)) + ".modification." + std::string(describe(c.terms[0].parameter).key));
    return gain_in_words(sum.gain,
                         fmt::format("The {} is as steep as allowed, {:.4g} um/mm: a further {:.2g} {} over the same length", relief,
                                     -c.terms[1].factor / units::um, assessment_step(c.unit()), c.unit()),
                         optimum, task);
  }
  if (c.grinding == GrindingLimit::Amount) {
    const std::string amount =
        plain_name(std::string(name_of(c.terms[0].member)) + ".modification." + std::string(describe(c.terms[0].parameter).key));
    const std::string stands =
        fmt::format("The {} is as large as can be ground, {:.4g} {}", amount, (sum.upper ? c.maximum : c.minimum) * c.outside_factor(), c.unit());
    return gain_in_words(sum.gain, fmt::format("{}: a further {:.2g} {}", stands, assessment_step(c.unit()), c.unit()), optimum, task);
  }
  const std::string move =
      fmt::format("The sum {} is at its {} limit, {:.4g} {}: a further {:.2g} {}", plain_name(c.name), sum.upper ? "upper" : "lower",
                  (sum.upper ? c.maximum : c.minimum) * c.outside_factor(), c.unit(), assessment_step(c.unit()), c.unit());
  return gain_in_words(sum.gain, move, optimum, task);
}

std::string objective_in_words(const Optimum::Objective& objective, const Optimum& optimum, const DesignTask& task) {
  const ObjectiveBound& bound = task.objective_bounds[static_cast<std::size_t>(objective.bound)];
  const std::string move = fmt::format("The earlier objective, {}, is at its limit, {:.4g}{}: a limit one per cent higher",
                                       plain_name(bound.objective.name()), bound.limit, behind_number(bound.objective.unit()));
  return gain_in_words(objective.gain, move, optimum, task);
}

/// "peak contact stress <= 1500 MPa"
std::string limit_in_words(const Relaxation::Limit& limit, const DesignTask& task) {
  if (limit.constraint >= 0) {
    const OutputConstraint& c = task.constraints[static_cast<std::size_t>(limit.constraint)];
    return fmt::format("{} {} {:.4g}{}", plain_name(c.output.name), c.is_least() ? ">=" : "<=", c.limit() * c.output.outside_factor(),
                       behind_number(c.output.unit()));
  }
  const ObjectiveBound& bound = task.objective_bounds[static_cast<std::size_t>(limit.objective_bound)];
  return fmt::format("{} <= {:.4g}{}", plain_name(bound.objective.name()), bound.limit, behind_number(bound.objective.unit()));
}

std::string move_in_words(const Relaxation::Move& move, const DesignTask& task) {
  const AssessedParameter& of = move.parameter;
  const std::string gain = fmt::format("would reduce the excess by {:.2g} % of the limit", -100.0 * move.gain);
  if (move.moves_bound()) {
    const DesignVariable& v = task.variables[static_cast<std::size_t>(of.variable)];
    const bool upper = move.steps > 0.0;
    return fmt::format("The {} is at its {} bound, {:.4g}{}: a further {:.2g}{} {}.", plain_name(v.path), upper ? "upper" : "lower",
                       (upper ? v.upper : v.lower) * v.outside_factor(), behind_number(v.unit()), of.step, behind_number(of.unit), gain);
  }
  const std::string extent = std::isnan(move.extent) ? "" : fmt::format(" over {:.3g} mm", move.extent);
  return fmt::format("The {} is not a variable: {:+.2g} {}{} {}.", plain_name(of.name), move.steps * of.step, of.unit, extent, gain);
}

/// With an accuracy a run may take 48 intervals, and each tolerance that moves the mesh takes two more meshes in every scene. On a wind stage 24 intervals give
/// these sensitivities within a quarter of those by 48, most within a tenth, except the small ones to the centre distance and to less torque; 16 were off by up
/// to three quarters. Intervals that the study gives are kept.
int most_tolerance_intervals(const Study& study) {
  constexpr int enough = 24;
  return study.fidelity.automatic_intervals ? enough : study.fidelity.quadrature.intervals;
}

}  // namespace

Assessment assess_optimum(const Study& study, const DesignProblem& problem, const DesignTask& asked, const TwoLevelDesign& found,
                          const ProgressReport& progress) {
  const Stopwatch clock;
  const DesignResult& design = found.design;
  Assessment assessment;
  if (study.table<OptimiseTable>().assessment.rules) {
    if (progress) progress("trying rules of thumb", 0, 1, "");
    assessment.basis = rule_basis(problem);
    const std::vector<NamedDesign> rules = rules_of_thumb(problem.task(), *assessment.basis);
    const bool has_tighter_limits =
        !std::ranges::equal(problem.task().constraints, asked.constraints, {}, &OutputConstraint::limit, &OutputConstraint::limit);
    assessment.rules = compare_designs_by_two_levels(has_tighter_limits ? DesignProblem(asked) : problem, rules);
    if (const ComparedDesign* best = best_of(assessment.rules)) assessment.out_of_reach = out_of_reach(problem, best->design);
  }
  if (study.table<OptimiseTable>().assessment.variants > 0.0) {
    assessment.variants = search_all_variants(problem, study.table<OptimiseTable>().assessment.variants * design.evaluations, progress);
  }
  // Rounding to the grinder's steps leaves the optimum.
  if (design.exact) assessment.is_of = design.choices.empty() ? AssessedDesign::BeforeRounding : AssessedDesign::BeforeChoices;
  // What makes the design an optimum is seen as the search saw it.
  const DesignProblem& searched = found.confirmed ? *found.confirmed->problem : problem;
  const DesignReport& shown = exact_of(found);
  const DesignReport& best = found.confirmed ? found.confirmed->design : shown;
  const bool usable = best.analysis.usable() && !best.analysis.cycles.empty();
  const bool is_infeasible = design.status == SolverStatus::Infeasible;  // then the design shown is no optimum of the objective
  const bool keeps_bounds = searched.violation(best.analysis.modification) <= DesignLog::tolerance;  // else they are what is in the way
  if (usable && is_infeasible && keeps_bounds && searched.has_smooth_excess())
    assessment.relaxation = find_relaxation(searched, best.analysis.modification, best.variables);
  if (usable && !is_infeasible) {
    const DesignProblem last = last_stage(searched, design.stages);
    assessment.optimum = find_optimum(last, design.optimality, best.variables);
    assessment.sensitivities =
        find_sensitivities(last, design.optimality, best.analysis.modification, best.variables, most_tolerance_intervals(study));
    assessment.optimum->value = shown.last_objective();
    assessment.judged = last.task();
    assessment.judged->constraints = asked.constraints;
    if (progress) progress("looking for the usual signs", 0, 1, "");
    assessment.usual = find_usual_signs(last, best, left_of(study.table<OptimiseTable>().solver, design).max_seconds);
  }
  assessment.seconds = clock.seconds();
  return assessment;
}

Validation validate(const Study& study, const DesignTask& task, const DesignResult& design, const std::vector<DesignScene>& drawn,
                    const ComparedDesign* best_rule) {
  const Stopwatch clock;
  Validation validation;
  validation.seed = study.table<OptimiseTable>().assessment.validation.seed;
  validation.load_cases = load_cases_in_words(study);
  std::vector<NamedDesign> designs{{"before", "", design.before.analysis.modification.pinion, design.before.analysis.modification.wheel},
                                   {"after", "", design.after.analysis.modification.pinion, design.after.analysis.modification.wheel}};
  if (best_rule != nullptr) designs.push_back(best_rule->design);
  for (const std::vector<int>& draw : draws_of(drawn, task.combined_objective().over_spectrum())) {
    validation.draws.push_back(name_of_draw(drawn[static_cast<std::size_t>(draw.front())].draw));
  }
  validation.designs = validate_designs(task, drawn, designs);
  validation.seconds = clock.seconds();
  return validation;
}

std::string assessed_design_in_words(AssessedDesign design) {
  switch (design) {
    case AssessedDesign::Shown:
      break;
    case AssessedDesign::BeforeRounding:
      return "the optimum before rounding to the steps";
    case AssessedDesign::BeforeChoices:
      return "the optimum before what cannot be ground was left out";
    case AssessedDesign::WithoutScatter:
      return "the optimum over the listed scenes, before gears were drawn";
  }
  return "";
}

std::string usual_signs_in_words(const UsualSigns& usual, const DesignTask& task) {
  std::string words = fmt::format("The optimum has what is seldom ground: {}. ", fmt::join(usual.unusual, ", "));
  if (!usual.design)
    return words + (usual.is_out_of_time ? "The search for a design without it did not end within the time limit."
                                         : "No design without it was found that keeps the constraints.");
  std::vector<std::string> amounts;
  for (std::size_t i = 0; i < task.variables.size(); ++i) {
    const DesignVariable& v = task.variables[i];
    constexpr double nothing = 1e-6;  // in its outside unit: round-off of a bound at 0
    const double amount = usual.design->variables[i] * v.outside_factor();
    amounts.push_back(fmt::format("{} {:.3g}{}", plain_name(v.path), std::abs(amount) < nothing ? 0.0 : amount, behind_number(v.unit())));
  }
  const std::string price = std::isfinite(usual.price) ? fmt::format(" ({:+.1f} %)", 100.0 * usual.price) : "";
  return words + fmt::format("The best design without it reaches {}{:.5g}{}{}: {}.", task.objective_bounds.empty() ? "" : objective_of(task) + " ",
                             usual.design->objective, behind_number(task.objective_unit()), price, fmt::join(amounts, ", "));
}

std::vector<std::string> relaxation_in_words(const Relaxation& relaxation, const DesignTask& task) {
  std::vector<std::string> words{fmt::format(
      "No design was found within the bounds that keeps the limits: the nearest found exceeds them by {:.3g} %. With limits that much wider it would be feasible.",
      100.0 * relaxation.excess)};
  constexpr double said = 0.005;  // less would be a weight of 0.00
  for (const Relaxation::Limit& limit : relaxation.limits) {
    if (!(limit.weight >= said)) continue;
    const DesignScene& scene = task.scenes[static_cast<std::size_t>(limit.scene)];
    words.push_back(fmt::format("{} is not kept in the scene \"{}\", {:.5g} N·m, with weight {:.2f}.", limit_in_words(limit, task), scene.name,
                                scene.torque / units::newton_metre, limit.weight));
  }
  constexpr std::size_t most_said = 6;
  for (std::size_t i = 0; i < std::min(most_said, relaxation.moves.size()); ++i) words.push_back(move_in_words(relaxation.moves[i], task));
  if (relaxation.moves.empty()) words.push_back("To first order no wider bound and no modification that is left out would reduce the excess.");
  return words;
}

std::string no_rule_in_words(const std::vector<ComparedDesign>& rules) {
  if (std::ranges::none_of(rules, [](const ComparedDesign& rule) { return rule.failure.empty(); })) {
    return fmt::format("None of {} designs by rules of thumb can be analysed.", rules.size());
  }
  const ComparedDesign* nearest = nullptr;  // of those that keep the limits on modifications, as a search has it, see is_nearer()
  for (const ComparedDesign& rule : rules) {
    if (!rule.failure.empty() || rule.modification_violation > DesignLog::tolerance) continue;
    if (nearest == nullptr || rule.constraint_violation < nearest->constraint_violation) nearest = &rule;
  }
  if (nearest == nullptr) return fmt::format("None of {} designs by rules of thumb keeps the limits on modifications.", rules.size());
  const double excess = 100.0 * nearest->constraint_violation;
  return fmt::format("None of {} designs by rules of thumb keeps the constraints. The nearest, {}, exceeds one of them by {:.{}f} %.", rules.size(),
                     nearest->design.name, excess, excess < 10.0 ? 1 : 0);
}

std::string validation_in_words(const Validation& validation, const DesignTask& task) {
  const Spread before = spread_of(validation.designs[0].measures), after = spread_of(validation.designs[1].measures);
  const double better = share_below(validation.designs[1].measures, validation.designs[0].measures);
  const std::string load_cases = validation.load_cases.empty() ? "" : validation.load_cases + ",";
  std::string words = fmt::format(
      "Over {} draws that the search has not seen (seed {}){} the design is better than before in {:.1f} %; mean {:.5g} -> {:.5g}, 95 % below {:.5g} -> {:.5g}, "
      "largest {:.5g} -> {:.5g}{}.",
      validation.draws.size(), validation.seed, load_cases, 100.0 * better, before.mean, after.mean, before.quantiles.back(), after.quantiles.back(),
      before.greatest, after.greatest, behind_number(task.objective_unit()));
  if (validation.designs.size() > 2) {
    const ValidatedDesign& rule = validation.designs[2];
    words += fmt::format(" It is better than the best rule of thumb ({}) in {:.1f} %, whose largest is {:.5g}{}.", rule.name,
                         100.0 * share_below(validation.designs[1].measures, rule.measures), spread_of(rule.measures).greatest,
                         behind_number(task.objective_unit()));
  }
  if (before.failed + after.failed > 0) words += fmt::format(" {} analyses did not converge.", before.failed + after.failed);
  return words;
}

std::vector<std::string> optimum_in_words(const Optimum& optimum, const DesignTask& task) {
  const bool names_torque = ListedScenes(task).names_torque();
  std::vector<std::string> words;
  constexpr double said = 0.005;                       // less would be a weight of 0.00
  const bool is_given = task.over == Aggregate::Mean;  // a mean has the weights of the scenes whatever the design
  for (const Optimum::Scene& scene : optimum.scenes) {
    if (!is_given && std::abs(scene.weight) >= said) words.push_back(scene_in_words(scene, task, names_torque));
  }
  for (const Optimum::Bound& bound : optimum.bounds) {
    const DesignVariable& v = task.variables[static_cast<std::size_t>(bound.variable)];
    const bool is_all_there_is = describe(v.parameter).kind == ParameterKind::Fraction && (bound.upper ? v.upper == 1.0 : v.lower == 0.0);
    if (!is_all_there_is) words.push_back(bound_in_words(bound, optimum, task));
  }
  for (const Optimum::Constraint& constraint : optimum.constraints) words.push_back(constraint_in_words(constraint, optimum, task));
  for (const Optimum::Objective& objective : optimum.objectives) words.push_back(objective_in_words(objective, optimum, task));
  for (const Optimum::Sum& sum : optimum.sums) words.push_back(sum_in_words(sum, optimum, task));
  std::set<int> at_bounds;
  for (const Optimum::Bound& bound : optimum.bounds) at_bounds.insert(bound.variable);
  if (at_bounds.size() >= 2 && 2 * at_bounds.size() >= task.variables.size()) {
    words.push_back(fmt::format("{} of {} variables are at a bound: the ranges that were given decide as much as the objective does.",
                                at_bounds.size(), task.variables.size()));
  }
  return words;
}

}  // namespace flankwright::studies
