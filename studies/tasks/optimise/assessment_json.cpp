#include "studies/tasks/optimise/assessment_json.hpp"

#include <algorithm>

#include "studies/base/value_with_unit.hpp"
#include "studies/study_file/study_schema.hpp"
#include "studies/tasks/optimise/listed_scenes.hpp"

namespace flankwright::studies {

namespace {

/// Every modification that is not 0, under the name that a study gives it.
Json modifications_json(const NamedDesign& design) {
  Json json = Json::array();
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const Modification& m = design.modification[member];
    // Halves that are alike are said at once, others each by itself.
    const auto alike = [&](const ModificationDescriptor& p) { return find_parameter(p.half)->get(m) == find_parameter(p.other_half)->get(m); };
    const auto is_said = [&](const ModificationDescriptor& p) {
      if (!p.half.empty()) return alike(p);
      return std::ranges::none_of(modification_parameters, [&](const ModificationDescriptor& both) {
        return (both.half == p.key || both.other_half == p.key) && alike(both);
      });
    };
    for (const ModificationDescriptor& p : modification_parameters) {
      if (p.get(m) == 0.0 || !is_said(p)) continue;
      const DesignVariable v{
          .path = std::string(name_of(member)) + ".modification." + std::string(p.key), .member = member, .parameter = p.parameter};
      json.push_back({{"name", v.path}, {"value", v.outside(p.get(m))}, {"unit", v.unit()}});
    }
  }
  return json;
}

Json compared_json(const ComparedDesign& compared) {
  return {{"name", compared.design.name},
          {"basis", compared.design.basis},
          {"modifications", modifications_json(compared.design)},
          {"objective", compared.objective},
          {"constraint_violation", compared.constraint_violation},
          {"feasible", compared.feasible()},
          {"failure", compared.failure},
          {"intervals", compared.intervals},
          {"scenes", compared.scene_measures}};
}

Json variants_json(const VariantSearch& search, const DesignTask& task) {
  Json levels = Json::object();
  for (std::size_t i = 0; i < task.variables.size(); ++i) levels[task.variables[i].path] = search.levels[i];
  return {{"levels_from", to_string(search.placement)},
          {"levels", levels},
          {"tried", search.tried},
          {"feasible", search.feasible},
          {"failed", search.failed},
          {"seconds", search.seconds},
          {"best", search.x.size() > 0 ? compared_json(search.best) : Json()}};
}

Json comparison_json(const Assessment& assessment, const DesignTask& task) {
  Json json{{"rules", list(assessment.rules, compared_json)},
            {"variants", list(assessment.variants, [&](const VariantSearch& s) { return variants_json(s, task); })}};
  if (assessment.basis) {
    json["basis"] = {{"torque_Nm", in_Nm(assessment.basis->torque)},
                     {"misalignment_um", in_um(assessment.basis->misalignment)},
                     {"mean_deflection_um", in_um(assessment.basis->deflection)},
                     {"single_pair_deflection_um", in_um(assessment.basis->single_pair_deflection)}};
  }
  if (const ComparedDesign* best = best_of(assessment.rules))
    json["best_rule"] = {{"name", best->design.name}, {"objective", best->objective}};
  else if (!assessment.rules.empty())
    json["no_rule"] = no_rule_in_words(assessment.rules);
  return json;
}

Json governing_json(const Optimum& optimum, const DesignTask& task) {
  return {{"objective_name", task.objective_name()},
          {"objective_unit", task.objective_unit()},
          {"words", optimum_in_words(optimum, task)},
          {"residual", optimum.residual},
          {"resolution", optimum.resolution},
          {"scenes", list(optimum.scenes,
                          [&](const Optimum::Scene& s) -> Json {
                            const DesignScene& scene = task.scenes[static_cast<std::size_t>(s.scene)];
                            return {{"name", scene.name}, {"torque_Nm", ListedScenes(task).torque(scene)}, {"weight", s.weight}};
                          })},
          {"bounds", list(optimum.bounds,
                          [&](const Optimum::Bound& b) -> Json {
                            const DesignVariable& v = task.variables[static_cast<std::size_t>(b.variable)];
                            return {{"variable", v.path},
                                    {"side", b.upper ? "upper" : "lower"},
                                    {"step", assessment_step(v.unit())},
                                    {"unit", v.unit()},
                                    {"gain", b.gain}};
                          })},
          {"constraints",
           list(optimum.constraints,
                [&](const Optimum::Constraint& c) -> Json {
                  return {{"name", task.constraints[static_cast<std::size_t>(c.constraint)].output.name}, {"step_percent", 1.0}, {"gain", c.gain}};
                })},
          {"goals", list(optimum.objectives,
                         [&](const Optimum::Objective& g) -> Json {
                           const ObjectiveBound& bound = task.objective_bounds[static_cast<std::size_t>(g.bound)];
                           return {{"name", bound.objective.name()}, {"limit", bound.limit}, {"step_percent", 1.0}, {"gain", g.gain}};
                         })},
          {"sums", list(optimum.sums, [&](const Optimum::Sum& s) -> Json {
             const ModificationConstraint& bound = task.modification_constraints[static_cast<std::size_t>(s.constraint)];
             return {{"name", bound.name},
                     {"side", s.upper ? "upper" : "lower"},
                     {"step", assessment_step(bound.unit())},
                     {"unit", bound.unit()},
                     {"gain", s.gain}};
           })}};
}

Json usual_signs_json(const UsualSigns& usual, const DesignTask& task) {
  Json json{{"words", usual_signs_in_words(usual, task)}, {"unusual", usual.unusual}, {"design", Json()}};
  if (!usual.design) return json;
  json["design"] = {
      {"variables", variables_json(usual.design->variables, task)}, {"objective", usual.design->objective}, {"price_percent", 100.0 * usual.price}};
  return json;
}

Json relaxation_json(const Relaxation& relaxation, const DesignTask& task) {
  const auto name_of_limit = [&](const Relaxation::Limit& limit) {
    return limit.constraint >= 0 ? task.constraints[static_cast<std::size_t>(limit.constraint)].output.name
                                 : task.objective_bounds[static_cast<std::size_t>(limit.objective_bound)].objective.name();
  };
  return {
      {"words", relaxation_in_words(relaxation, task)},
      {"excess_percent", 100.0 * relaxation.excess},
      {"limits", list(relaxation.limits,
                      [&](const Relaxation::Limit& limit) -> Json {
                        const DesignScene& scene = task.scenes[static_cast<std::size_t>(limit.scene)];
                        return {{"name", name_of_limit(limit)}, {"scene", scene.name}, {"torque_Nm", in_Nm(scene.torque)}, {"weight", limit.weight}};
                      })},
      {"moves", list(relaxation.moves, [](const Relaxation::Move& move) -> Json {
         return {{"name", move.parameter.name},
                 {"kind", move.moves_bound() ? "bound" : "not varied"},
                 {"step", move.steps * move.parameter.step},
                 {"unit", move.parameter.unit},
                 {"extent_mm", move.extent},
                 {"gain_percent", 100.0 * move.gain}};
       })}};
}

Json sensitivity_json(const Sensitivity& s) {
  Json json{{"name", s.parameter.name}, {"kind", s.parameter.variable >= 0 ? "variable" : "tolerance"},
            {"step", s.parameter.step}, {"unit", s.parameter.unit},
            {"less", s.less},           {"more", s.more},
            {"intervals", s.intervals}};
  if (s.parameter.variable >= 0) {
    json["within_bounds"] = {{"less", s.can_less}, {"more", s.can_more}};
  } else {
    json["more_optimised_anew"] = s.optimised_anew;
  }
  return json;
}

Json spread_json(const ValidatedDesign& design, double low, double high, int bins) {
  const Spread spread = spread_of(design.measures);
  Json quantiles = Json::array();
  for (std::size_t q = 0; q < Spread::shares.size(); ++q) quantiles.push_back({{"share", Spread::shares[q]}, {"value", spread.quantiles[q]}});
  return {{"name", design.name},         {"analysed", spread.count},      {"failed", spread.failed},
          {"mean", spread.mean},         {"deviation", spread.deviation}, {"least", spread.least},
          {"greatest", spread.greatest}, {"quantiles", quantiles},        {"histogram", histogram(design.measures, low, high, bins)}};
}

Json validation_json(const Validation& validation, const DesignTask& task, const std::vector<SceneTolerance>& tolerances) {
  constexpr int bins = 24;
  std::vector<double> all;
  for (const ValidatedDesign& d : validation.designs) all.insert(all.end(), d.measures.begin(), d.measures.end());
  const Spread whole = spread_of(all);
  Json edges = Json::array();
  for (int i = 0; i <= bins; ++i) edges.push_back(whole.least + (whole.greatest - whole.least) * i / bins);
  const std::vector<double>& after = validation.designs[1].measures;
  Json json{{"samples", validation.draws.size()},
            {"seed", validation.seed},
            {"seconds", validation.seconds},
            {"tolerances", list(tolerances, tolerance_json)},
            {"words", validation_in_words(validation, task)},
            {"share_better_than_before", share_below(after, validation.designs[0].measures)},
            {"bin_edges", edges},
            {"designs", list(validation.designs, [&](const ValidatedDesign& d) { return spread_json(d, whole.least, whole.greatest, bins); })}};
  if (validation.designs.size() > 2) json["share_better_than_best_rule"] = share_below(after, validation.designs[2].measures);
  return json;
}

}  // namespace

Json variables_json(const std::vector<double>& values, const DesignTask& task) {
  Json variables = Json::object();
  for (std::size_t i = 0; i < task.variables.size(); ++i) variables[task.variables[i].path] = task.variables[i].outside(values[i]);
  return variables;
}

Json tolerance_json(const SceneTolerance& tolerance) {
  Json json{{"name", tolerance.path}, {"distribution", tolerance.in_words}, {"added", tolerance.added}};
  const auto known = study_keys().find(tolerance.path);
  // A pitch is drawn tooth by tooth; its distribution says the units.
  if (known != study_keys().end() && !tolerance.pitch) json["unit"] = default_unit(known->second->quantity);
  return json;
}

void add_assessment(const Assessment& assessment, const DesignTask& task, const Study& study, Json& optimise) {
  optimise["comparison"] = comparison_json(assessment, task);
  optimise["proof_seconds"] = assessment.seconds;
  if (assessment.is_of != AssessedDesign::Shown) optimise["assessed_design"] = assessed_design_in_words(assessment.is_of);
  if (assessment.validation) optimise["validation"] = validation_json(*assessment.validation, task, study.tolerances);
  if (assessment.relaxation) optimise["relaxation"] = relaxation_json(*assessment.relaxation, task);
  if (!assessment.optimum) return;
  optimise["governing"] = governing_json(*assessment.optimum, *assessment.judged);
  if (optimise.contains("assessed_design")) optimise["governing"]["design"] = optimise["assessed_design"];
  if (assessment.usual) optimise["usual_signs"] = usual_signs_json(*assessment.usual, *assessment.judged);
  optimise["sensitivity"] = list(assessment.sensitivities, sensitivity_json);
}

}  // namespace flankwright::studies
