#include "studies/tasks/accuracy/accuracy_json.hpp"

#include <cmath>

#include "studies/results/fidelity_choice_json.hpp"
#include "studies/results/used_json.hpp"

namespace flankwright::studies {

namespace {

Json settings_json(const FidelityLevel& level) {
  return {{"compliance", to_string(level.compliance)},
          {"gap", to_string(level.gap)},
          {"quadrature", quadrature_json(level.quadrature)},
          {"positions", level.positions},
          {"peaks", level.located_peaks ? "refined" : "sampled"},
          {"left_out", level.left_out}};
}

/// Figures that an outside curve has, by their names with `unit`, times `scale`.
Json known_json(const PerFigure& figures, const char* unit, double scale) {
  Json json;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    if (std::isfinite(figures[i])) json[std::string(name_of(static_cast<Figure>(i))) + unit] = scale * figures[i];
  }
  return json;
}

Json step_json(const HierarchyStep& step, const std::vector<DesignScene>& scenes) {
  const LevelResult& result = step.result;
  Json outputs = Json::array(), best_in = Json::array();
  for (std::size_t s = 0; s < result.scenes.size(); ++s) {
    Json json{{"scene", scenes[s].name}, {"torque_Nm", in_Nm(scenes[s].torque)}};
    json.update(figures_json(result.scenes[s]));
    outputs.push_back(std::move(json));
  }
  for (std::size_t i = 0; i < step.best_in.size(); ++i) {
    if (step.best_in[i]) best_in.push_back(name_of(static_cast<Figure>(i)));
  }
  Json json{{"name", result.level.name},
            {"axis", result.level.axis},
            {"varies", to_string(result.level.kind)},
            {"settings", settings_json(result.level)},
            {"usable", result.usable()},
            {"seconds", result.seconds},
            {"first_run_seconds", step.first_seconds},
            {"error_percent", errors_json(step.error)},
            {"pareto_best", step.best},
            {"pareto_best_in", std::move(best_in)},
            {"outputs", std::move(outputs)}};
  if (std::isfinite(step.from_outside.front())) json["from_outside_percent"] = known_json(step.from_outside, "", percent);
  return json;
}

Json order_json(const AxisOrder& axis) {
  Json figures;
  for (std::size_t i = 0; i < axis.order.size(); ++i) {
    figures[name_of(static_cast<Figure>(i))] = std::isfinite(axis.order[i]) ? Json(axis.order[i]) : Json("not regular");
  }
  return {{"axis", axis.axis}, {"levels", axis.levels}, {"order", std::move(figures)}};
}

}  // namespace

Json hierarchy_json(const FidelityHierarchy& hierarchy) {
  Json fidelity_levels = Json::array();
  fidelity_levels.push_back(step_json(hierarchy.reference, hierarchy.scenes));
  for (const HierarchyStep& step : hierarchy.steps) fidelity_levels.push_back(step_json(step, hierarchy.scenes));
  Json json{{"reference", hierarchy.reference.result.level.name},
            {"reference_resolution_error_percent", errors_json(hierarchy.reference_error)},
            {"te_harmonics_relative_to", "peak to peak, at least 2 % of the mean deflection of the mesh"},
            {"te_mean_relative_to", "mean deflection of the mesh"},
            {"seconds", hierarchy.seconds},
            {"rungs", std::move(fidelity_levels)},
            {"orders", list(hierarchy.orders, order_json)}};
  if (hierarchy.outside) {
    json["outside"] = {{"name", hierarchy.outside->name}, {"positions", hierarchy.outside->positions}};
    json["outside"].update(known_json(hierarchy.outside->value, "_um", 1.0 / units::um));
  }
  return json;
}

}  // namespace flankwright::studies
