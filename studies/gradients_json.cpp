#include "studies/gradients_json.hpp"

#include "core/load/cycle_gradient.hpp"

namespace flankwright::studies {

namespace {

/// Derivatives by internal units of the parameters become those by the units that a study file gives them in.
class Outside {
 public:
  explicit Outside(const std::vector<GradientParameter>& parameters) : units_(std::ssize(parameters)) {
    for (std::size_t i = 0; i < parameters.size(); ++i) units_[static_cast<Eigen::Index>(i)] = parameters[i].unit_size;
  }

  /// @param per_unit  internal units of the output in one of its key's
  Json row(const Eigen::RowVectorXd& derivative, double per_unit = 1.0) const {
    if (derivative.size() == 0) return nullptr;
    return Json(Eigen::RowVectorXd(derivative.cwiseProduct(units_) / per_unit));
  }
  Json rows(const Eigen::MatrixXd& derivatives, double per_unit = 1.0) const {
    Json all = Json::array();
    for (Eigen::Index i = 0; i < derivatives.rows(); ++i) all.push_back(row(derivatives.row(i), per_unit));
    return all;
  }

 private:
  Eigen::RowVectorXd units_;
};

Json located_json(const LoadRating& rating, const Outside& outside) {
  const auto peaks = [&](const PeakGradients::Pair& of) {
    return Json{{"contact_stress_MPa", outside.row(of.contact_stress)}, {"load_N_per_mm", outside.row(of.line_load)}};
  };
  return {{"without_spikes", peaks(rating.peak_gradients.without_spikes)}, {"with_spikes", peaks(rating.peak_gradients.with_spikes)}};
}

Json factors_json(const LoadRating& rating, const Outside& outside) {
  const auto triple = [&](const LoadFactorGradients::Triple& of) {
    return Json{{"K_Hbeta", outside.row(of.lead)}, {"K_Halpha", outside.row(of.profile)}, {"K_H", outside.row(of.combined)}};
  };
  return {{"without_spikes", triple(rating.factor_gradients.without_spikes)}, {"with_spikes", triple(rating.factor_gradients.with_spikes)}};
}

}  // namespace

Json gradients_json(const LoadedResult& loaded, const MeshModel& model, const Study& study) {
  const Outside outside(study.gradients);
  const CycleGradient summary = summary_gradient(model, loaded.cycle, loaded.summary);
  const bool full_cycle = study.cycle.phases.empty();
  Json cycle = Json::array();
  for (const LoadedPosition& position : loaded.cycle.positions) {
    cycle.push_back({{"phase", position.phase},
                     {"te_um", outside.row(position.transmission_error_derivative, units::um)},
                     {"stiffness_N_per_mm_um", outside.row(stiffness_derivative(loaded.cycle, position))},
                     {"load_N_per_mm", outside.rows(position.line_load_derivative)},
                     {"contact_stress_MPa", outside.rows(position.contact_stress_derivative)}});
  }
  return {{"parameters", list(study.gradients, [](const GradientParameter& p) { return p.path; })},
          {"units", list(study.gradients, [](const GradientParameter& p) { return p.unit; })},
          {"summary",
           {{"te_peak_to_peak_um", outside.row(summary.te_peak_to_peak, units::um)},
            {"te_harmonics_um", full_cycle ? outside.rows(summary.te_harmonics, units::um) : Json::array()},
            {"te_mean_um", outside.row(summary.te_mean, units::um)},
            {"peak_load_N_per_mm", outside.row(summary.peak_line_load)},
            {"peak_contact_stress_MPa", outside.row(summary.peak_contact_stress)},
            {"peak_root_stress_MPa", outside.row(summary.peak_root_stress)},
            {"mean_stiffness_N_per_mm_um", outside.row(summary.mean_stiffness)},
            {"load_factor", outside.row(summary.load_factor)},
            {"peaks", loaded.rating ? located_json(*loaded.rating, outside) : Json()},
            {"load_factors", loaded.rating ? factors_json(*loaded.rating, outside) : Json()}}},
          {"cycle", std::move(cycle)}};
}

}  // namespace flankwright::studies
