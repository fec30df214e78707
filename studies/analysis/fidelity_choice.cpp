#include "studies/analysis/fidelity_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/stopwatch.hpp"
#include "studies/analysis/fit_error.hpp"

namespace flankwright::studies {

namespace {

/// What models were seen to differ by, coarsely resolved, is multiplied by this before it is called an error: finely resolved and beside
/// finite elements it was up to 1.09 times as large.
constexpr double safety = 1.25;
constexpr double thin_slice_share = 0.5, fitted_share = 0.7;  ///< of the accuracy, that a cheaper compliance may take
constexpr double gap_share = 0.7;                             ///< of the accuracy that the compliance leaves

bool is_given(const Study& study, std::string_view prefix) {
  return std::ranges::any_of(study.given, [&](const GivenValue& g) { return g.key.starts_with(prefix); });
}

/// Models are compared at this resolution: their differences are larger than its errors, and much the same at any.
FidelityLevel coarse_level(const Fidelity& fidelity) {
  return {"coarse", "models", ErrorKind::Model, fidelity.compliance, fidelity.gap, {QuadratureRule::Graded, 8}, 16};
}

PerFigure with_safety(PerFigure errors) {
  for (double& error : errors) error *= safety;
  return errors;
}

/// Part of an accuracy that an error leaves for independent ones, see root_sum_square().
double left_of(double accuracy, double error) { return std::sqrt(std::max(0.0, accuracy * accuracy - error * error)); }

PerFigure added(const PerFigure& a, const PerFigure& b) {
  PerFigure sum{};
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = a[i] + b[i];
  return sum;
}

/// Difference of two models, worst over the load cases; infinite where one of them did not converge.
PerFigure differences(const LevelResult& model, const LevelResult& other) {
  PerFigure worst{};
  if (!model.usable() || !other.usable()) worst.fill(std::numeric_limits<double>::infinity());
  for (std::size_t s = 0; model.usable() && other.usable() && s < model.scenes.size(); ++s) {
    worst = larger_of(worst, figure_differences(model.scenes[s], other.scenes[s]));
  }
  return with_safety(worst);
}

PerFigure fit_errors(const LevelResult& fitted) {
  PerFigure worst{};
  if (!fitted.usable()) worst.fill(std::numeric_limits<double>::infinity());
  for (const CycleFigures& figures : fitted.scenes) worst = larger_of(worst, fit_error(figures));
  return worst;
}

void choose_compliance(LevelRunner& runner, FidelityChoice& choice) {
  FidelityLevel level = coarse_level(choice.fidelity);
  const auto candidate = [&](ComplianceModel model) {
    level.compliance = model;
    return runner.run(level);
  };
  const LevelResult fitted = candidate(ComplianceModel::Fitted), slices = candidate(ComplianceModel::ThinSlice);
  const PerFigure by_fit = fit_errors(fitted), by_slices = added(differences(slices, fitted), by_fit);
  choice.compliances = {{"thin_slice", by_slices, slices.seconds}, {"fitted", by_fit, fitted.seconds}, {"fe", {}, not_given}};
  const std::size_t taken = headline(by_slices) <= thin_slice_share * choice.accuracy ? 0
                            : headline(by_fit) <= fitted_share * choice.accuracy      ? 1
                                                                                      : 2;
  choice.compliances[taken].chosen = true;
  choice.compliance_error = choice.compliances[taken].error;
  choice.fidelity.compliance = compliance_model(choice.compliances[taken].name);
}

void choose_gap(LevelRunner& runner, FidelityChoice& choice) {
  FidelityLevel level = coarse_level(choice.fidelity);
  const auto candidate = [&](GapModel gap) {
    level.gap = gap;
    return runner.run(level);
  };
  const LevelResult plane = candidate(GapModel::PlaneOfAction), whole = candidate(GapModel::WholeSurface);
  const PerFigure by_plane = differences(plane, whole);
  PerFigure excess{};
  for (std::size_t i = 0; i < excess.size(); ++i) excess[i] = by_plane[i] - gap_share * left_of(choice.accuracy, choice.compliance_error[i]);
  const bool plane_does = headline(excess) <= 0.0;
  choice.gaps = {{to_string(GapModel::PlaneOfAction), by_plane, plane.seconds, plane_does},
                 {to_string(GapModel::WholeSurface), {}, whole.seconds, !plane_does}};
  if (plane_does) choice.gap_error = by_plane;
  choice.fidelity.gap = plane_does ? GapModel::PlaneOfAction : GapModel::WholeSurface;
}

}  // namespace

PerFigure FidelityChoice::error() const {
  return root_sum_square(root_sum_square(compliance_error, gap_error), root_sum_square(resolution_error, left_out.error));
}

PerFigure FidelityChoice::effects_budget() const {
  PerFigure left{};
  const PerFigure spent = error();
  for (std::size_t i = 0; kept && i < left.size(); ++i) left[i] = left_of(accuracy, spent[i]);
  return left;
}

FidelityChoice choose_models(LevelRunner& runner, const ProgressReport& progress) {
  const Stopwatch clock;
  const Study& study = runner.subject().study;
  FidelityChoice choice;
  choice.accuracy = *study.fidelity.accuracy;
  choice.fidelity = study.fidelity;
  choice.compliance_given = is_given(study, "fidelity.compliance");
  choice.gap_given = is_given(study, "fidelity.gap");
  choice.quadrature_given = !study.fidelity.automatic_intervals;
  choice.positions_given = !study.cycle.automatic_positions || !study.cycle.phases.empty();
  if (progress) progress("choosing models", 0, 0, fmt::format("for an accuracy of {:.3g} %", 100.0 * choice.accuracy));
  if (!choice.compliance_given) choose_compliance(runner, choice);
  if (!choice.gap_given) choose_gap(runner, choice);
  choice.fidelity.resolution_accuracy = left_of(choice.accuracy, headline(root_sum_square(choice.compliance_error, choice.gap_error)));
  choice.choosing_seconds = clock.seconds();
  return choice;
}

std::string unmet_accuracy(const FidelityChoice& choice) {
  if (choice.failures > 0) return "the accuracy asked for is not known to be kept: the load distribution did not converge everywhere";
  const PerFigure error = choice.error();
  if (std::ranges::any_of(error, [](double e) { return std::isnan(e); })) {
    return "the accuracy asked for is not known to be kept: no error is estimated at listed phases, or with fewer than 4 positions or 2 intervals";
  }
  const auto worst = std::ranges::find(error, headline(error));
  return fmt::format("an accuracy of {:.3g} % is not kept: {} is estimated within {:.3g} %", 100.0 * choice.accuracy,
                     name_of(static_cast<Figure>(worst - error.begin())), 100.0 * *worst);
}

Study with_models(Study study, const FidelityChoice& choice) {
  study.fidelity = choice.fidelity;
  return study;
}

}  // namespace flankwright::studies
