#include "studies/tasks/optimise/optimise_json.hpp"
#include "studies/tasks/optimise/optimise_results.hpp"

#include <algorithm>
#include <cmath>

#include "studies/results/used_json.hpp"
#include "studies/tasks/optimise/assessment_json.hpp"
#include "studies/tasks/optimise/listed_scenes.hpp"

namespace flankwright::studies {

namespace {

/// A bounded output has one entry, whichever bounds it has.
Json constraints_json(const DesignReport& report, const DesignTask& task) {
  Json constraints = Json::object();
  for (std::size_t c = 0; c < task.constraints.size(); ++c) {
    const OutputConstraint& bound = task.constraints[c];
    const double factor = bound.output.outside_factor(), value = report.constraint_values[c] * factor;
    Json& entry = constraints[bound.output.name];
    if (entry.is_null()) entry = {{"value", value}, {"unit", bound.output.unit()}};
    if (bound.is_least()) entry["least"] = value;
    entry[bound.is_least() ? "min" : "max"] = bound.limit() * factor;
  }
  for (std::size_t c = 0; c < task.modification_constraints.size(); ++c) {
    const ModificationConstraint& bound = task.modification_constraints[c];
    if (bound.grinding != GrindingLimit::None) continue;  // in grinding_limits
    const double factor = bound.outside_factor();
    Json& entry = constraints[bound.name];
    entry = {{"value", report.modification_values[c] * factor}, {"unit", bound.unit()}};
    if (std::isfinite(bound.maximum)) entry["max"] = bound.maximum * factor;
    if (std::isfinite(bound.minimum)) entry["min"] = bound.minimum * factor;
  }
  return constraints;
}

/// Estimated discretisation errors of what a report says; entries as constraints_json() has them.
void add_errors(const DesignErrors& errors, const DesignTask& task, Json& json) {
  json["objective_error"] = errors.objective;
  json["constraints_error"] = Json::object();
  for (std::size_t c = 0; c < errors.constraint_values.size(); ++c) {
    const ObjectiveTerm& output = task.constraints[c].output;
    json["constraints_error"][output.name] = errors.constraint_values[c] * output.outside_factor();
  }
  if (!errors.later_objectives.empty()) json["later_objectives_error"] = errors.later_objectives;
}

Json resolution_json(const LevelWork& work) {
  return {{"quadrature", quadrature_json(work.resolution.quadrature)},
          {"positions", work.resolution.phases.size()},
          {"cycles", work.cycles},
          {"milliseconds_per_cycle", 1e3 * work.seconds / static_cast<double>(work.cycles)},
          {"seconds", work.seconds}};
}

Json assessment_json(const SearchWork& work) {
  Json json{{"search", resolution_json(work.search)},
            {"assessed", resolution_json(work.fine)},
            {"objective_seen_by_search", work.objective_seen_by_search},
            {"searches", work.search.resolution.quadrature.intervals == work.fine.resolution.quadrature.intervals ? 1 : 2}};
  if (const std::optional<ConfirmedSearch>& confirmed = work.confirmed) {
    json["confirmed"] = {
        {"finished", resolution_json(confirmed->work)}, {"objective", confirmed->design.objective}, {"objective_seen", confirmed->objective_seen}};
  }
  return json;
}

Json design_report_json(const DesignReport& report, const DesignTask& task) {
  Json units = Json::object(), linked = Json::object();
  for (const DesignVariable& v : task.variables) units[v.path] = v.unit();
  for (std::size_t t = 0; t < task.links.size(); ++t) {
    const DesignVariable& v = task.links[t].linked;
    linked[v.path] = v.outside(report.linked[t]);
    units[v.path] = v.unit();
  }
  Json json{{"variables", variables_json(report.variables, task)},
            {"variable_units", units},
            {"objective", report.objective},
            {"constraints", constraints_json(report, task)}};
  if (!task.links.empty()) json["tied"] = std::move(linked);
  if (!task.later_objectives.empty()) json["later_objectives"] = report.later_objectives;
  return json;
}

/// The objective of a block of the last epigraph: the last of a list of objectives is minimised, those before it are bounded.
Objective objective_of_block(const DesignTask& task, int block) {
  std::vector<Objective> objectives{task.combined_objective()};
  objectives.insert(objectives.end(), task.later_objectives.begin(), task.later_objectives.end());
  std::rotate(objectives.begin(), objectives.end() - 1, objectives.end());
  return objectives[static_cast<std::size_t>(block)];
}

/// The conditions of the design that are active at the optimum.
Json active_json(const ActiveBound& active, const DesignTask& task) {
  Json json{{"multiplier", active.multiplier}};
  const EpigraphRow& row = active.row;
  if (active.variable >= 0) {
    json["variable"] = task.variables[static_cast<std::size_t>(active.variable)].path;
    json["bound"] = active.side < 0 ? "lower" : "upper";
    return json;
  }
  const auto index = static_cast<std::size_t>(std::max(row.index, 0));
  using Kind = EpigraphRow::Kind;
  switch (row.kind) {
    case Kind::Floor:
    case Kind::Ceiling:
      json["output"] = objective_of_block(task, row.objective).terms[index].name;
      break;
    case Kind::OutputBound:
      json["constraint"] = task.constraints[index].output.name;
      break;
    case Kind::ModificationBound:
      json["constraint"] = task.modification_constraints[index].name;
      break;
    case Kind::ObjectiveHelper:
      json["output"] = objective_of_block(task, row.objective).name();
      break;
    case Kind::ObjectiveBound:
      json["constraint"] = objective_of_block(task, row.objective).name();
      break;
    case Kind::ScalarisedObjective:
      break;  // of fronts only, whose points have no optimality of their own
  }
  if (row.scene >= 0) {
    const DesignScene& scene = task.scenes[static_cast<std::size_t>(row.scene)];
    json["scene"] = scene.name;
    json["torque_Nm"] = in_Nm(scene.torque);
  }
  if (row.candidate.position >= 0) json["position"] = row.candidate.position;
  if (active.is_kink) json["kink"] = true;
  return json;
}

Json optimality_json(const Optimality& optimality, const DesignTask& task) {
  constexpr std::size_t most_shown = 40;
  Json active = Json::array();
  for (const ActiveBound& bound : optimality.active) {
    if (active.size() == most_shown) break;
    if (bound.variable < 0 && bound.row.scene < 0 && bound.row.kind == EpigraphRow::Kind::Floor) continue;  // u >= 0
    active.push_back(active_json(bound, task));
  }
  return {{"residual", optimality.residual}, {"complementarity", optimality.complementarity}, {"active", std::move(active)}};
}

Json scaled_design_json(const Eigen::VectorXd& x, const DesignTask& task) { return variables_json(unscaled(x, task), task); }

/// Null where the search needed no finisher.
Json finished_by_json(const std::string& solver) { return solver.empty() ? Json() : Json(solver); }

/// Every start and the different optima that they found.
void add_starts(const DesignResult& design, const DesignTask& task, Json& json) {
  json["starts"] = list(design.runs, [&](const LocalRun& run) -> Json {
    return {{"from", scaled_design_json(run.start, task)},
            {"variables", scaled_design_json(run.x, task)},
            {"objective", run.objective},
            {"constraint_violation", run.constraint_violation},
            {"status", to_string(run.status)},
            {"message", run.message},
            {"finished_by", finished_by_json(run.finished_by)},
            {"evaluations", run.evaluations},
            {"failures", run.failures},
            {"seconds", run.seconds}};
  });
  json["optima"] = list(design.optima, [&](const LocalOptimum& optimum) -> Json {
    const LocalRun& run = design.runs[optimum.run];
    return {{"start", optimum.run}, {"found_by", optimum.found_by}, {"objective", run.objective}, {"variables", scaled_design_json(run.x, task)}};
  });
  json["multimodal"] = design.is_multimodal();
}

Json front_json(const ParetoFront& front, const DesignTask& task) {
  return {{"objectives", list(front.objectives,
                              [](const Objective& objective) -> Json {
                                return {{"name", objective.name()}, {"unit", objective.unit()}};
                              })},
          {"points", list(front.points,
                          [&](const ParetoPoint& point) -> Json {
                            Json json{{"values", point.values},
                                      {"errors", point.errors},
                                      {"variables", scaled_design_json(point.x, task)},
                                      {"status", to_string(point.status)},
                                      {"constraint_violation", point.constraint_violation},
                                      {"dominated", point.dominated}};
                            DesignReport report;
                            report.constraint_values = point.constraint_values;
                            report.modification_values = point.modification_values;
                            const bool is_resolved = point.constraint_values.size() == task.constraints.size() &&
                                                     point.modification_values.size() == task.modification_constraints.size();
                            if (is_resolved) json["constraints"] = constraints_json(report, task);
                            return json;
                          })},
          {"ideal", front.ideal},
          {"worst", front.worst},
          {"unevenness", front.unevenness()},
          {"evaluations", front.evaluations},
          {"failures", front.failures},
          {"seconds", front.seconds},
          {"message", front.message}};
}

}  // namespace

Json optimise_json(const StudyResults& results) {
  const OptimiseResults& found = optimised(results);
  const DesignResult& design = found.design;
  const DesignTask& task = found.task;
  Json terms = Json::array(), scenes = Json::array();
  for (const ObjectiveTerm& term : task.objective) {
    terms.push_back({{"output", term.name}, {"weight", term.weight}, {"unit", term.unit()}});
  }
  const ListedScenes listed(task);
  for (const std::size_t s : listed.indices()) {
    scenes.push_back({{"name", task.scenes[s].name},
                      {"torque_Nm", listed.torque(task.scenes[s])},
                      {"weight", listed.weight(task.scenes[s])},
                      {"before", design.before.scene_measures[s]},
                      {"after", design.after.scene_measures[s]},
                      {"before_error", found.before_errors.scene_measures[s]},
                      {"after_error", found.after_errors.scene_measures[s]}});
  }
  Json json{{"objective_name", task.objective_name()},
            {"objective_unit", task.objective_unit()},
            {"objective_terms", terms},
            {"over", to_string(task.over)},
            {"solver", design.solver},
            {"finisher", design.finisher},
            {"finished_by", finished_by_json(design.finished_by)},
            {"formulation", design.formulation},
            {"status", to_string(design.status)},
            {"message", design.message},
            {"evaluations", design.evaluations},
            {"gradient_evaluations", design.gradient_evaluations},
            {"failures", design.failures},
            {"rounds", design.rounds},
            {"seconds", design.seconds},
            {"optimality", optimality_json(design.optimality, task)},
            {"before", design_report_json(design.before, task)},
            {"after", design_report_json(design.after, task)},
            {"scenes", scenes},
            {"history", list(design.history, [](const SolverStep& step) -> Json {
               return {{"evaluation", step.evaluation}, {"objective", step.objective}, {"constraint_violation", step.constraint_violation}};
             })}};
  add_errors(found.before_errors, task, json["before"]);
  add_errors(found.after_errors, task, json["after"]);
  json["assessment"] = assessment_json(found.search_work);
  if (design.exact) {
    json["exact"] = design_report_json(*design.exact, task);
    json["rounded"] = {{"variables", json["after"]["variables"]},
                       {"objective", design.after.objective},
                       {"loss_percent", 100.0 * design.rounding_loss()},
                       {"choices_loss_percent", task.later_objectives.empty() ? 100.0 * design.choice_loss() : not_given}};
  }
  if (!design.stages.empty()) {
    Json stages = Json::array();
    for (std::size_t k = 0; k < design.stages.size(); ++k) {
      const LexicographicStage& stage = design.stages[k];
      const char* unit = k == 0 ? task.objective_unit() : task.later_objectives[k - 1].unit();
      stages.push_back({{"objective", stage.name}, {"unit", unit}, {"least", stage.least}, {"limit", stage.limit}});
    }
    json["stages"] = std::move(stages);
  }
  add_starts(design, task, json);
  if (found.front) json["pareto"] = front_json(*found.front, task);
  return json;
}

}  // namespace flankwright::studies
