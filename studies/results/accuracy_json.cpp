#include "studies/results/accuracy_json.hpp"

#include <algorithm>
#include <cmath>

#include "studies/results/used_json.hpp"

namespace flankwright::studies {

namespace {

/// Shares as percentages, under the figures' names, and the largest as "worst".
Json errors_json(const PerFigure& shares) {
  Json json;
  for (std::size_t i = 0; i < shares.size(); ++i) json[name_of(static_cast<Figure>(i))] = percent * shares[i];
  json["worst"] = percent * largest(shares);
  return json;
}

/// Estimates of a choice: "worst" among what a mesh is judged by.
Json estimates_json(const PerFigure& shares) {
  Json json = errors_json(shares);
  json["worst"] = percent * headline(shares);
  return json;
}

Json figures_json(const CycleFigures& figures) {
  Json harmonics = Json::array();
  for (int k = 0; k < figure_harmonics; ++k) harmonics.push_back(in_um(figures.value[static_cast<std::size_t>(Figure::TeHarmonic1) + k]));
  return {{"te_mean_um", in_um(figures[Figure::TeMean])},
          {"te_peak_to_peak_um", in_um(figures[Figure::TePeakToPeak])},
          {"te_harmonics_um", std::move(harmonics)},
          {"mean_approach_um", in_um(figures.mean_approach)},
          {"peak_contact_stress_MPa", figures[Figure::PeakContactStress]},
          {"peak_load_N_per_mm", figures[Figure::PeakLineLoad]},
          {"load_factor", figures[Figure::LoadFactor]}};
}

Json settings_json(const Rung& rung) {
  return {{"compliance", to_string(rung.compliance)},
          {"gap", to_string(rung.gap)},
          {"quadrature", quadrature_json(rung.quadrature)},
          {"positions", rung.positions},
          {"peaks", rung.located_peaks ? "located" : "sampled"},
          {"left_out", rung.left_out}};
}

Json step_json(const LadderStep& step, const std::vector<DesignScene>& scenes) {
  const RungResult& result = step.result;
  Json outputs = Json::array(), best_in = Json::array();
  for (std::size_t s = 0; s < result.scenes.size(); ++s) {
    Json json{{"scene", scenes[s].name}, {"torque_Nm", scenes[s].torque / units::newton_metre}};
    json.update(figures_json(result.scenes[s]));
    outputs.push_back(std::move(json));
  }
  for (std::size_t i = 0; i < step.best_in.size(); ++i) {
    if (step.best_in[i]) best_in.push_back(name_of(static_cast<Figure>(i)));
  }
  return {{"name", result.rung.name},
          {"axis", result.rung.axis},
          {"varies", to_string(result.rung.kind)},
          {"settings", settings_json(result.rung)},
          {"usable", result.usable()},
          {"seconds", result.seconds},
          {"first_run_seconds", step.first_seconds},
          {"error_percent", errors_json(step.error)},
          {"pareto_best", step.best},
          {"pareto_best_in", std::move(best_in)},
          {"outputs", std::move(outputs)}};
}

Json order_json(const AxisOrder& axis) {
  Json figures;
  for (std::size_t i = 0; i < axis.order.size(); ++i) {
    figures[name_of(static_cast<Figure>(i))] = std::isfinite(axis.order[i]) ? Json(axis.order[i]) : Json("not regular");
  }
  return {{"axis", axis.axis}, {"levels", axis.levels}, {"order", std::move(figures)}};
}

Json candidates_json(const std::vector<ModelCandidate>& candidates) {
  return list(candidates, [](const ModelCandidate& c) -> Json {
    return {{"name", c.name}, {"chosen", c.chosen}, {"error_percent", estimates_json(c.error)}, {"seconds", c.seconds}};
  });
}

Json levels_json(const std::vector<ResolutionLevel>& levels) {
  return list(levels, [](const ResolutionLevel& level) -> Json {
    return {{"intervals", level.intervals}, {"positions", level.positions}, {"error_percent", estimates_json(level.error())}, {"outputs", figures_json(level.figures)}};
  });
}

}  // namespace

Json ladder_json(const Ladder& ladder) {
  Json rungs = Json::array();
  rungs.push_back(step_json(ladder.reference, ladder.scenes));
  for (const LadderStep& step : ladder.steps) rungs.push_back(step_json(step, ladder.scenes));
  return {{"reference", ladder.reference.result.rung.name},
          {"reference_resolution_error_percent", errors_json(ladder.reference_error)},
          {"te_harmonics_relative_to", "peak to peak, at least 2 % of the mean deflection of the mesh"},
          {"te_mean_relative_to", "mean deflection of the mesh"},
          {"seconds", ladder.seconds},
          {"rungs", std::move(rungs)},
          {"orders", list(ladder.orders, order_json)}};
}

Json fidelity_choice_json(const FidelityChoice& choice) {
  const auto estimate = [](bool given, const PerFigure& error) { return given ? Json() : estimates_json(error); };
  return {{"asked_percent", percent * choice.accuracy},
          {"kept", choice.kept},
          {"estimate_percent", estimates_json(choice.error())},
          {"failures", choice.failures},
          {"compliance",
           {{"used", to_string(choice.fidelity.compliance)},
            {"given", choice.compliance_given},
            {"estimate_percent", estimate(choice.compliance_given, choice.compliance_error)},
            {"candidates", candidates_json(choice.compliances)}}},
          {"gap",
           {{"used", to_string(choice.fidelity.gap)},
            {"given", choice.gap_given},
            {"estimate_percent", estimate(choice.gap_given, choice.gap_error)},
            {"candidates", candidates_json(choice.gaps)}}},
          {"quadrature",
           {{"used", quadrature_json(choice.fidelity.quadrature)},
            {"given", choice.quadrature_given},
            {"estimate_percent", estimate(choice.quadrature_given, choice.quadrature_error)},
            {"levels", levels_json(choice.discretisation.levels)}}},
          {"positions",
           {{"used", choice.positions},
            {"given", choice.positions_given},
            {"estimate_percent", estimate(choice.positions_given, choice.position_error)}}},
          {"resolution", {{"estimate_percent", estimate(choice.quadrature_given && choice.positions_given, choice.resolution_error)}}},
          {"governing", {{"scene", choice.governing}, {"torque_Nm", choice.governing_torque / units::newton_metre}}},
          {"effects", {{"left_out", choice.left_out.names}, {"estimate_percent", estimates_json(choice.left_out.error)}}},
          {"choosing_seconds", choice.choosing_seconds}};
}

}  // namespace flankwright::studies
