#include "studies/analysis/fidelity_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/stopwatch.hpp"
#include "optimize/design/problem/for_each_in_parallel.hpp"
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

void raise(PerFigure& worst, const PerFigure& other) {
  for (std::size_t i = 0; i < worst.size(); ++i) worst[i] = std::max(worst[i], other[i]);
}

/// Difference of two models, worst over the load cases; infinite where one of them did not converge.
PerFigure differences(const LevelResult& model, const LevelResult& other) {
  PerFigure worst{};
  if (!model.usable() || !other.usable()) worst.fill(std::numeric_limits<double>::infinity());
  for (std::size_t s = 0; model.usable() && other.usable() && s < model.scenes.size(); ++s) {
    raise(worst, figure_differences(model.scenes[s], other.scenes[s]));
  }
  return with_safety(worst);
}

PerFigure fit_errors(const LevelResult& fitted) {
  PerFigure worst{};
  if (!fitted.usable()) worst.fill(std::numeric_limits<double>::infinity());
  for (const CycleFigures& figures : fitted.scenes) raise(worst, fit_error(figures));
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

void choose_resolution(LevelRunner& runner, FidelityChoice& choice, const ProgressReport& progress) {
  const std::vector<DesignScene>& scenes = runner.subject().scenes;
  DiscretisationSearch search;
  search.accuracy = choice.accuracy;
  search.spent = root_sum_square(choice.compliance_error, choice.gap_error);
  search.choose_intervals = !choice.quadrature_given;
  search.choose_positions = !choice.positions_given;
  if (!search.choose_intervals && !search.choose_positions) return;
  Study seeking = runner.subject().study;
  if (search.choose_intervals) seeking.fidelity.quadrature.rule = QuadratureRule::Graded;
  search.seek_extremes = seeks_extremes(seeking);
  if (choice.quadrature_given) search.fewest_intervals = choice.fidelity.quadrature.intervals;
  if (choice.positions_given) search.fewest_positions = choice.positions;
  search.for_each = for_each_in_parallel;
  const FidelityLevel level = coarse_level(choice.fidelity);
  std::map<MeshPlacement, int> placements;  // load cases of one placement share their meshes
  std::vector<ResolutionCase> cases;
  for (const DesignScene& scene : scenes) {
    const MeshPlacement placement = placement_of(level.gap, scene.condition, runner.subject().shafts.get(), scene.torque);
    const int number = placements.try_emplace(placement, static_cast<int>(placements.size())).first->second;
    cases.push_back({runner.mesh(level, scene), scene.condition, scene.torque, number});
  }
  int analysed = 0;
  search.starting = [&](int intervals, int positions, int load_cases) {
    if (progress)
      progress("choosing accuracy", analysed, 0, fmt::format("{} load cases by {} intervals, {} positions", load_cases, intervals, positions));
    analysed += load_cases;
  };
  choice.discretisation = choose_discretisation(cases, seeking.fidelity.quadrature.rule, search);
  const Discretisation& found = choice.discretisation;
  choice.governing = scenes[found.governing].name;
  choice.governing_torque = scenes[found.governing].torque;
  choice.failures = found.failures;
  choice.fidelity.quadrature = {seeking.fidelity.quadrature.rule, found.positions > 0 ? found.quadrature.intervals : search.fewest_intervals};
  if (!choice.positions_given) choice.positions = std::max(found.positions, search.fewest_positions);
  choice.quadrature_error = found.quadrature_error;
  choice.position_error = found.position_error;
  choice.resolution_error = found.error();
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

FidelityChoice choose_fidelity(LevelRunner& runner, const ProgressReport& progress) {
  const Stopwatch clock;
  const Study& study = runner.subject().study;
  FidelityChoice choice;
  choice.accuracy = *study.fidelity.accuracy;
  choice.fidelity = study.fidelity;
  choice.positions = study.cycle.positions;
  choice.compliance_given = is_given(study, "fidelity.compliance");
  choice.gap_given = is_given(study, "fidelity.gap");
  choice.quadrature_given = is_given(study, "fidelity.quadrature");
  choice.positions_given = is_given(study, "cycle.positions") || is_given(study, "cycle.phases");
  if (!choice.compliance_given) choose_compliance(runner, choice);
  if (!choice.gap_given) choose_gap(runner, choice);
  choose_resolution(runner, choice, progress);
  choice.choosing_seconds = clock.seconds();
  choice.kept = choice.failures == 0 && headline(choice.error()) <= choice.accuracy;
  return choice;
}

std::string unmet_accuracy(const FidelityChoice& choice) {
  if (choice.failures > 0) return "the accuracy asked for is not known to be kept: the load distribution did not converge everywhere";
  const PerFigure error = choice.error();
  const auto worst = std::ranges::find(error, headline(error));
  return fmt::format("an accuracy of {:.3g} % is not kept: {} is estimated within {:.3g} %", 100.0 * choice.accuracy,
                     name_of(static_cast<Figure>(worst - error.begin())), 100.0 * *worst);
}

Study with_choice(Study study, const FidelityChoice& choice) {
  study.fidelity = choice.fidelity;
  study.fidelity.automatic_intervals = false;
  if (!choice.positions_given) {
    study.cycle.positions = choice.positions;
    study.cycle.automatic_positions = false;
  }
  return study;
}

}  // namespace flankwright::studies
