#include "studies/tasks/fit/fit_json.hpp"

#include <algorithm>
#include <numeric>

#include "studies/results/bodies_json.hpp"
#include "studies/results/compliance_json.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

namespace {

constexpr std::size_t uncertain_coefficients = 5;  // listed, the least certain first

Json distribution_json(const ResidualDistribution& d) {
  return {{"teeth_apart", d.teeth_apart},
          {"pairs", d.pairs},
          {"median_percent", percent * d.median()},
          {"share_95_percent", percent * d.share_95()},
          {"worst_percent", percent * d.worst()},
          {"worst_percent_of_own", percent * d.worst_of_own},
          {"residual_percent", list(d.residual, [](double residual) { return percent * residual; })}};
}

Json residuals_json(const std::vector<FormResiduals>& all) {
  Json json{{"share_percent", list(kResidualShares, [](double share) { return percent * share; })}};
  for (const FormResiduals& form : all) {
    json[form.form] = {
        {"status", to_string(form.status)}, {"fitted", list(form.fitted, distribution_json)}, {"unseen", list(form.unseen, distribution_json)}};
  }
  return json;
}

/// Standard errors, where the fit came to an end.
Json uncertainty_json(const FittedCompliance& fit, const Eigen::MatrixXd& covariance) {
  const std::vector<double>& errors = fit.record().standard_errors;
  const std::vector<std::string> names = fit.form().coefficient_names();
  std::vector<std::size_t> order(errors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return errors[a] > errors[b]; });
  Json least_certain = Json::array();
  for (std::size_t i = 0; i < std::min(uncertain_coefficients, order.size()); ++i) {
    const std::size_t c = order[i];
    least_certain.push_back({{"coefficient", names[c]}, {"value", fit.coefficients()[c]}, {"standard_error", errors[c]}});
  }
  return {{"median_standard_error", order.empty() ? not_given : errors[order[order.size() / 2]]},
          {"least_certain", least_certain},
          {"covariance", covariance_json(fit.form(), fit.coefficients(), covariance)}};
}

Json range_json(const FitRange& range) {
  return {{"u", {range.u_min, range.u_max}}, {"zeta", {range.zeta_min, range.zeta_max}}, {"teeth_apart", range.teeth_apart}};
}

}  // namespace

Json fit_json(const GearFit& fit) {
  const GearFitResult& result = fit.result;
  const RunStatistics& run = result.finite_elements;
  const bool solved = result.status == FactorStatus::Factorised;
  Json json{{"gear", name_of(fit.member)},
            {"teeth", result.gear.teeth},
            {"helix_angle_deg", in_deg(result.gear.helix_angle)},
            {"relative_face", result.gear.relative_face},
            {"profile_shift", result.gear.profile_shift},
            {"body", body_json(result.body)},
            {"seconds", fit.seconds},
            {"finite_elements",
             {{"solved", solved},
              {"bricks", run.bricks},
              {"unknowns", run.unknowns},
              {"peak_memory_bytes", run.peak_bytes},
              {"removed_shaft_motion", name_of(result.removed)},
              {"loads", result.loads},
              {"model_seconds", result.times.model},
              {"loads_seconds", result.times.loads}}},
            {"form", fit.several_teeth ? "several_teeth" : "one_tooth_accurate"},
            {"status", to_string(result.fit.status)},
            {"message", result.fit.message},
            {"iterations", result.fit.iterations},
            {"pairs", result.fit.pairs},
            {"initial_cost", result.fit.initial_cost},
            {"cost", result.fit.cost},
            {"fit_seconds", result.times.fit},
            {"comparison_seconds", result.times.others}};
  if (!result.fit.fit) return json;
  json["coefficients"] = result.fit.fit->coefficients().size();
  json["range"] = range_json(result.fit.fit->record().range);
  json["uncertainty"] = uncertainty_json(*result.fit.fit, result.fit.covariance);
  json["lowest_eigenvalue"] = result.lowest_eigenvalue;
  json["eigenvalue_teeth"] = result.eigenvalue_teeth;
  json["residuals"] = residuals_json(result.residuals);
  json["curves"] = list(result.curves, curve_json);
  return json;
}

}  // namespace flankwright::studies
