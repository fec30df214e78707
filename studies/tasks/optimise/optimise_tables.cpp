#include "studies/tasks/optimise/optimise_tables.hpp"
#include "studies/tasks/optimise/optimise_results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "studies/base/csv.hpp"
#include "studies/base/json_format.hpp"
#include "studies/base/plain_names.hpp"
#include "studies/tasks/optimise/listed_scenes.hpp"
#include "studies/results/life_tables.hpp"
#include "studies/results/shafts_json.hpp"
#include "studies/results/tables.hpp"
#include "studies/tasks/optimise/assessment_tables.hpp"
#include "studies/tasks/optimise/grinding_choices.hpp"
#include "studies/tasks/optimise/scatter_json.hpp"

namespace flankwright::studies {

namespace {

std::string scenes_csv(const StudyResults& results) {
  std::string csv = "scene,torque_Nm,weight,before,after,before_error,after_error\n";
  const OptimiseResults& found = optimised(results);
  const ListedScenes listed(found.task);
  for (const std::size_t s : listed.indices()) {
    const DesignScene& scene = found.task.scenes[s];
    csv += fmt::format("{},{},{},{},{},{},{}\n", csv_field(scene.name), csv_field(listed.torque(scene)), listed.weight(scene),
                       found.design.before.scene_measures[s], found.design.after.scene_measures[s], csv_field(found.before_errors.scene_measures[s]),
                       csv_field(found.after_errors.scene_measures[s]));
  }
  return csv;
}

std::string history_csv(const DesignResult& design) {
  std::string csv = "evaluation,objective,constraint_violation\n";
  for (const SolverStep& step : design.history) {
    csv += fmt::format("{},{},{}\n", step.evaluation, step.objective, step.constraint_violation);
  }
  return csv;
}

std::string pareto_csv(const ParetoFront& front, const DesignTask& task) {
  std::string csv;
  for (const Objective& objective : front.objectives) csv += csv_field(objective.name() + " [" + objective.unit() + "]") + ",";
  for (const Objective& objective : front.objectives) csv += csv_field(objective.name() + " error [" + objective.unit() + "]") + ",";
  for (const DesignVariable& v : task.variables) csv += csv_field(v.path + " [" + v.unit() + "]") + ",";
  csv += "status,constraint_violation,dominated\n";
  for (const ParetoPoint& point : front.points) {
    for (const double value : point.values) csv += fmt::format("{},", value);
    for (std::size_t k = 0; k < front.objectives.size(); ++k) {
      const bool is_known = k < point.errors.size() && !std::isnan(point.errors[k]);
      csv += is_known ? fmt::format("{},", point.errors[k]) : ",";
    }
    for (std::size_t i = 0; i < task.variables.size(); ++i) {
      const DesignVariable& v = task.variables[i];
      csv += fmt::format("{},", v.outside(v.unscaled(point.x[static_cast<Eigen::Index>(i)])));
    }
    csv += fmt::format("{},{},{}\n", to_string(point.status), point.constraint_violation, point.dominated ? "yes" : "no");
  }
  return csv;
}

std::string change(double before, double after) {
  if (before == 0.0) return "-";
  const double percent = 100.0 * (after / before - 1.0);
  const bool is_nearly_all = percent <= -99.95 && after != 0.0;  // is not rounded to all of it
  return is_nearly_all ? fmt::format("{:.2f} %", std::max(percent, -99.99)) : fmt::format("{:+.1f} %", percent);
}

/// "changes the objective by +1.8 %, from 377.2 to 384 MPa"; without per cent where that says nothing. @param note  behind the per cent
std::string change_in_words(const std::string& objective, double from, double to, const std::string& unit, const std::string& note = "") {
  const double increase = relative_increase(from, to);
  if (std::isnan(increase) && from == to) return fmt::format("leaves the {} at {:.5g}{}", objective, to, unit);
  const std::string by = std::isnan(increase) ? "" : fmt::format(" by {:+.1f} %{},", 100.0 * increase, note);
  return fmt::format("changes the {}{} from {:.5g} to {:.5g}{}", objective, by, from, to, unit);
}

/// What choices and steps cost: of a list, each of its objectives.
std::string loss_in_words(const DesignResult& design, const DesignTask& task) {
  const char* what = design.choices.empty() ? "rounding to the steps" : has_steps(task) ? "this and rounding to the steps" : "this";
  const double by_choices = design.choice_loss();
  const bool is_told_apart = !design.choices.empty() && has_steps(task) && !std::isnan(by_choices);
  const std::string choices = is_told_apart ? fmt::format(" ({:+.1f} % without the steps)", 100.0 * by_choices) : "";
  const std::string unit = behind_number(task.objective_unit());
  const double from = design.exact->objective, to = design.after.objective;
  if (task.later_objectives.empty()) return fmt::format("{} {}\n", what, change_in_words("objective", from, to, unit, choices));
  std::string out = fmt::format("{} {}\n", what, change_in_words(plain_name(task.objective_name()), from, to, unit));
  for (std::size_t k = 0; k < task.later_objectives.size(); ++k) {
    const Objective& later = task.later_objectives[k];
    const bool is_last = k + 1 == task.later_objectives.size();  // alternatives of choices are judged by it
    out += fmt::format("{} {}\n", what,
                       change_in_words(plain_name(later.name()), design.exact->later_objectives[k], design.after.later_objectives[k],
                                       behind_number(later.unit()), is_last ? choices : ""));
  }
  return out;
}

/// A loss is no cost of rounding where the exact design exceeds a constraint between the positions. By how much it does; empty where it does not.
std::string excess_of_exact_in_words(const DesignResult& design, const DesignTask& task) {
  double excess = 0.0;
  for (std::size_t c = 0; c < task.constraints.size(); ++c) excess = std::max(excess, task.constraints[c].excess(design.exact->constraint_values[c]));
  constexpr double said = 5e-4;  // a tenth of a per cent when rounded
  return excess < said ? std::string() : fmt::format("the design before that exceeds a constraint by {:.1f} %\n", 100.0 * excess);
}

/// Why rounding to steps lowers the objective, which it should raise; empty where it does not lower it.
std::string gain_in_words(const DesignResult& design) {
  constexpr double said = 0.01;  // an optimum between steps may gain less by a kink
  if (design.status == SolverStatus::Infeasible || !design.choices.empty())
    return {};  // where no design keeps the limits the objective plays no part
  if (!(design.exact->objective > (1.0 + said) * design.after.objective)) return {};
  return "the design before that has a peak between the mesh positions that the steps avoid\n";
}

/// A figure, or its error, of both designs.
struct PerDesign {
  double before, after;
};

/// A line below a row of figures: how far they are from those of infinitely many points and positions.
/// Where nothing is left of a value, that too.
/// @param outside  factor of the unit that they are shown in
std::string error_row(std::size_t width, const PerDesign& values, const PerDesign& errors, double outside = 1.0) {
  if (std::isnan(errors.before) && std::isnan(errors.after)) return {};
  const bool is_lost = is_unknown(values.before, errors.before) || is_unknown(values.after, errors.after);
  return fmt::format("{:<{}}  {:>12}  {:>12}{}\n", "  known to", width, known_to(errors.before * outside), known_to(errors.after * outside),
                     is_lost ? "  not known at this resolution, as the error is larger than the value" : "");
}

/// "12 intervals and 32 positions"
std::string resolution_in_words(const MeshResolution& resolution) {
  return fmt::format("{} intervals and {} positions", resolution.quadrature.intervals, resolution.phases.size());
}

/// That a design is shown for which the first-order conditions of an optimum do not hold; empty where they do, or where none was looked for.
std::string doubt_in_words(const DesignResult& design) {
  const double largest = std::max(design.optimality.residual, design.optimality.complementarity);
  if (design.status == SolverStatus::Infeasible || !(largest > Optimality::holds)) return {};
  return fmt::format(
      "The design shown is not proven to be an optimum. Its first-order conditions are off by {:.2g} %, counted in the objective at the start for the "
      "range of a variable; an optimum's are off by {:.2g} % at most. Other starts or more analyses may find a better design.\n",
      100.0 * largest, 100.0 * Optimality::holds);
}

/// That a design was found at a coarser resolution than it is shown by.
std::string confirmed_in_words(const ConfirmedSearch& confirmed, const MeshResolution& shown, const DesignTask& task) {
  const std::string unit = behind_number(task.objective_unit());
  return fmt::format(
      "The search ended with {}. With these its optimum has {:.5g}{} at the mesh positions. It has {:.5g}{} there with {}, where the search did not go on.\n",
      resolution_in_words(confirmed.work.resolution), confirmed.design.objective, unit, confirmed.objective_seen, unit, resolution_in_words(shown));
}

/// Objectives of a list whose limits hold at the mesh positions, and that exceed them between those; empty where none does.
std::string exceeded_stages_in_words(const DesignResult& design, const DesignTask& task) {
  constexpr double said = 5e-4;  // a tenth of a per cent when rounded
  std::string words;
  for (std::size_t k = 0; k + 1 < design.stages.size(); ++k) {
    const double shown = design.after.objective_of_stage(k), limit = design.stages[k].limit;
    if (!(shown > (1.0 + said) * limit)) continue;
    const std::string unit = behind_number(k == 0 ? task.objective_unit() : task.later_objectives[k - 1].unit());
    words += fmt::format("between the mesh positions the {} exceeds its limit of {:.4g}{} by {:.1f} %: no better design was found there\n",
                         plain_name(design.stages[k].name), limit, unit, 100.0 * (shown / limit - 1.0));
  }
  return words;
}

/// What is minimised, with the weights of several outputs.
std::string objective_in_words(const Objective& objective) {
  if (objective.terms.size() == 1) return plain_name(objective.name());
  std::vector<std::string> parts;
  for (const ObjectiveTerm& term : objective.terms) parts.push_back(fmt::format("{:.4g} * {} [{}]", term.weight, plain_name(term.name), term.unit()));
  return fmt::format("{}", fmt::join(parts, " + "));
}

}  // namespace

std::string optimise_summary(const StudyResults& results) {
  const OptimiseResults& found = optimised(results);
  const DesignTask& task = found.task;
  const DesignResult& design = found.design;
  std::vector<std::string> names;
  for (const DesignVariable& v : task.variables) names.push_back(plain_name(v.path));
  const ListedScenes listed(task);
  const auto label = [&](const DesignScene& s) { return listed.names_torque() ? fmt::format("{}, {:.5g} N·m", s.name, in_Nm(s.torque)) : s.name; };
  for (const std::size_t s : listed.indices()) names.push_back(label(task.scenes[s]));
  const std::size_t width = widest(names, 24);

  std::string out = fmt::format("{:<{}}  {:>12}  {:>12}  {:>9}\n", "", width, "before", "after", "change");
  for (std::size_t i = 0; i < task.variables.size(); ++i) {
    const DesignVariable& v = task.variables[i];
    out += fmt::format("{:<{}}  {:>12.2f}  {:>12.2f}  {:>9}\n", plain_name(v.path), width, v.outside(design.before.variables[i]),
                       v.outside(design.after.variables[i]), describe(v.parameter).kind == ParameterKind::Fraction ? "of 1" : v.unit());
  }
  out += fmt::format("\n{} [{}]\n", objective_in_words(task.combined_objective()), task.objective_unit());
  for (const std::size_t s : listed.indices()) {
    const double before = design.before.scene_measures[s], after = design.after.scene_measures[s];
    out += fmt::format("{:<{}}  {:>12.5g}  {:>12.5g}  {:>9}\n", label(task.scenes[s]), width, before, after, change(before, after));
  }
  out += fmt::format("{:<{}}  {:>12.5g}  {:>12.5g}  {:>9}\n", "over the scenes", width, design.before.objective, design.after.objective,
                     change(design.before.objective, design.after.objective));
  out += error_row(width, {design.before.objective, design.after.objective}, {found.before_errors.objective, found.after_errors.objective});
  for (std::size_t k = 0; k < task.later_objectives.size(); ++k) {
    const double before = design.before.later_objectives[k], after = design.after.later_objectives[k];
    out += fmt::format("then {} [{}]\n", objective_in_words(task.later_objectives[k]), task.later_objectives[k].unit());
    out += fmt::format("{:<{}}  {:>12.5g}  {:>12.5g}  {:>9}\n", "over the scenes", width, before, after, change(before, after));
    const bool has_error = k < found.before_errors.later_objectives.size() && k < found.after_errors.later_objectives.size();
    if (has_error) out += error_row(width, {before, after}, {found.before_errors.later_objectives[k], found.after_errors.later_objectives[k]});
  }
  for (std::size_t c = 0; c < task.constraints.size(); ++c) {
    const ObjectiveTerm& output = task.constraints[c].output;
    const OutputConstraint& bound = task.constraints[c];
    out += fmt::format("{:<{}}  {:>12.5g}  {:>12.5g}  {:>9}\n",
                       fmt::format("{} {} {:.5g}{}", plain_name(output.name), bound.is_least() ? ">=" : "<=", bound.limit() * output.outside_factor(),
                                   behind_number(output.unit())),
                       width, design.before.constraint_values[c] * output.outside_factor(),
                       design.after.constraint_values[c] * output.outside_factor(), "");
    if (c < found.after_errors.constraint_values.size()) {
      out += error_row(width, {design.before.constraint_values[c], design.after.constraint_values[c]},
                       {found.before_errors.constraint_values[c], found.after_errors.constraint_values[c]}, output.outside_factor());
    }
  }
  out += fmt::format("\n{}: {} after {} analyses of up to {} scenes in {:.1f} s\n", design.solver, to_string(design.status), design.evaluations,
                     task.scenes.size(), design.seconds);
  out += doubt_in_words(design);
  for (const std::string& sentence : grinding_choices_in_words(design, task, statistic_of_choices(results))) out += sentence + "\n";
  if (design.exact) out += loss_in_words(design, task) + excess_of_exact_in_words(design, task) + gain_in_words(design);
  out += exceeded_stages_in_words(design, task);
  const SearchWork& work = found.search_work;
  const auto level = [&](const LevelWork& w) {
    return fmt::format("{} cycles of {}, {:.2g} ms each", w.cycles, resolution_in_words(w.resolution),
                       1e3 * w.seconds / static_cast<double>(w.cycles));
  };
  const bool two = work.search.resolution.quadrature.intervals != work.fine.resolution.quadrature.intervals;
  const std::string finished = work.confirmed ? fmt::format("{}; looked at by {}", level(work.confirmed->work), level(work.fine)) : level(work.fine);
  out += two ? fmt::format("searched by {}; finished by {}\n", level(work.search), finished) : finished + "\n";
  if (work.confirmed) out += confirmed_in_words(*work.confirmed, work.fine.resolution, task);
  out += life_table(results, width) + shaft_table(results, width);
  if (found.scatter) out += scatter_summary(*found.scatter, task, results.study);
  // Other designs are judged at the positions: so is, beside them, the optimum.
  return out + assessment_summary(found.assessment, task, work.objective_at_positions);
}

std::vector<NamedText> optimise_tables(const StudyResults& results) {
  const OptimiseResults& found = optimised(results);
  std::vector<NamedText> tables{{"scenes.csv", scenes_csv(results)}, {"history.csv", history_csv(found.design)}};
  if (found.front) tables.push_back({"pareto.csv", pareto_csv(*found.front, found.task)});
  if (found.scatter) {
    for (NamedText& table : scatter_tables(*found.scatter, found.task)) tables.push_back(std::move(table));
  }
  for (NamedText& table : assessment_tables(found.assessment)) tables.push_back(std::move(table));
  return tables;
}

}  // namespace flankwright::studies
