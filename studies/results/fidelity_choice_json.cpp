#include "studies/results/fidelity_choice_json.hpp"

#include <fmt/format.h>

#include "studies/results/used_json.hpp"

namespace flankwright::studies {

namespace {

/// Estimates of a choice: "worst" among what a mesh is judged by.
Json estimates_json(const PerFigure& shares) {
  Json json = errors_json(shares);
  json["worst"] = percent * headline(shares);
  return json;
}

Json candidates_json(const std::vector<ModelCandidate>& candidates) {
  return list(candidates, [](const ModelCandidate& c) -> Json {
    return {{"name", c.name}, {"chosen", c.chosen}, {"error_percent", estimates_json(c.error)}, {"seconds", c.seconds}};
  });
}

Json levels_json(const std::vector<ResolutionLevel>& levels) {
  return list(levels, [](const ResolutionLevel& level) -> Json {
    return {{"intervals", level.intervals},
            {"positions", level.positions},
            {"error_percent", estimates_json(level.error())},
            {"outputs", figures_json(level.figures)}};
  });
}

}  // namespace

Json errors_json(const PerFigure& shares) {
  Json json;
  for (std::size_t i = 0; i < shares.size(); ++i) json[name_of(static_cast<Figure>(i))] = percent * shares[i];
  json["worst"] = percent * largest(shares);
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
            {"levels", levels_json(choice.levels)}}},
          {"positions",
           {{"used", choice.positions},
            {"given", choice.positions_given},
            {"estimate_percent", estimate(choice.positions_given, choice.position_error)}}},
          {"resolution",
           {{"accuracy_percent", percent * choice.fidelity.resolution_accuracy},
            {"estimate_percent", estimate(choice.quadrature_given && choice.positions_given, choice.resolution_error)}}},
          {"governing", {{"scene", choice.governing}, {"torque_Nm", in_Nm(choice.governing_torque)}}},
          {"effects", {{"left_out", choice.left_out.names}, {"estimate_percent", estimates_json(choice.left_out.error)}}},
          {"choosing_seconds", choice.choosing_seconds}};
}

std::string fidelity_choice_summary(const FidelityChoice& choice) {
  const Json quadrature = quadrature_json(choice.fidelity.quadrature);
  std::string without;
  for (const std::string& name : choice.left_out.names) without += (without.empty() ? ", without " : ", ") + name;
  return fmt::format("accuracy {:.3g} %: {}, {}, {} {} intervals, {} positions{}; estimated {:.2g} %, models chosen in {:.2g} s\n\n",
                     percent * choice.accuracy, to_string(choice.fidelity.compliance), to_string(choice.fidelity.gap),
                     quadrature.at("rule").get<std::string>(), choice.fidelity.quadrature.intervals, choice.positions, without,
                     percent * headline(choice.error()), choice.choosing_seconds);
}

}  // namespace flankwright::studies
