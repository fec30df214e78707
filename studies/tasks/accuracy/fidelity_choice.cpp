#include "studies/tasks/accuracy/fidelity_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/stopwatch.hpp"

namespace flankwright::studies {

namespace {

/// Sums over contact lines by the library's kernels were 0.3 to 0.8 % too large with the library of before; mean transmission errors by today's
/// are 0.1 to 0.25 % above finite elements' (core/compliance/fitted), so that this is on the safe side [-].
constexpr double library_residual = 0.008;
/// What models were seen to differ by, coarsely resolved, is multiplied by this before it is called an error: finely resolved and beside
/// finite elements it was up to 1.09 times as large.
constexpr double safety = 1.25;
constexpr double thin_slice_share = 0.5, fitted_share = 0.7;  ///< of the accuracy, that a cheaper compliance may take
constexpr double gap_share = 0.5;           ///< of what the compliance leaves
constexpr double least_resolution = 0.2;    ///< of the accuracy: resolution is sought within at least this, kept or not

bool is_given(const Study& study, std::string_view prefix) {
  return std::ranges::any_of(study.given, [&](const GivenValue& g) { return g.key.starts_with(prefix); });
}

/// Models are compared at this resolution: their differences are larger than its errors, and much the same at any.
Rung coarse_rung(const Fidelity& fidelity) {
  return {"coarse", "models", ErrorKind::Model, fidelity.compliance, fidelity.gap, {QuadratureRule::Graded, 8}, 16};
}

PerFigure with_safety(PerFigure errors) {
  for (double& error : errors) error *= safety;
  return errors;
}

PerFigure added(const PerFigure& a, const PerFigure& b) {
  PerFigure sum{};
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = a[i] + b[i];
  return sum;
}

void raise(PerFigure& worst, const PerFigure& other) {
  for (std::size_t i = 0; i < worst.size(); ++i) worst[i] = std::max(worst[i], other[i]);
}

/// How far influence values of "fitted" may be off, as a share: the worse of both gears.
double fitted_residual(const GearStructures& structures) {
  double residual = 0.0;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const auto& refinement = structures.refinement(member);
    residual = std::max(residual, refinement && !refinement->residuals.empty() ? refinement->residuals.front().median : library_residual);
  }
  return residual;
}

/// What figures change by when every influence value grows by a share: solved again at the coarse positions.
PerFigure change_by_residual(RungRunner& runner, const Rung& rung, double residual) {
  PerFigure worst{};
  for (const DesignScene& scene : runner.subject().scenes) {
    MeshModel model = runner.mesh(rung, scene)({rung.quadrature, equally_spaced_phases(rung.positions)});
    const SampledCycle before(model, analyse_cycle(model, scene.condition, scene.torque));
    for (MeshPosition& position : model.positions) position.influence *= 1.0 + residual;
    const SampledCycle after(model, analyse_cycle(model, scene.condition, scene.torque));
    if (before.failures() + after.failures() == 0) raise(worst, figure_errors(after.figures(), before.figures()));
  }
  return worst;
}

void choose_compliance(RungRunner& runner, FidelityChoice& choice) {
  Rung rung = coarse_rung(choice.fidelity);
  const auto candidate = [&](ComplianceModel model) {
    rung.compliance = model;
    return runner.run(rung);
  };
  const RungResult fitted = candidate(ComplianceModel::Fitted), slices = candidate(ComplianceModel::ThinSlice);
  rung.compliance = ComplianceModel::Fitted;
  const PerFigure by_fit = with_safety(change_by_residual(runner, rung, fitted_residual(runner.structures(ComplianceModel::Fitted))));
  const PerFigure by_slices = added(with_safety(worst_errors(slices, fitted)), by_fit);
  choice.compliances = {{"thin_slice", by_slices, slices.seconds}, {"fitted", by_fit, fitted.seconds}, {"fe", {}, not_given}};
  const std::size_t taken = largest(by_slices) <= thin_slice_share * choice.accuracy ? 0 : largest(by_fit) <= fitted_share * choice.accuracy ? 1 : 2;
  choice.compliances[taken].chosen = true;
  choice.compliance_error = choice.compliances[taken].error;
  choice.fidelity.compliance = compliance_model(choice.compliances[taken].name);
}

void choose_gap(RungRunner& runner, FidelityChoice& choice) {
  Rung rung = coarse_rung(choice.fidelity);
  const auto candidate = [&](GapModel gap) {
    rung.gap = gap;
    return runner.run(rung);
  };
  const RungResult plane = candidate(GapModel::PlaneOfAction), whole = candidate(GapModel::WholeSurface);
  const PerFigure by_plane = with_safety(worst_errors(plane, whole));
  const double budget = gap_share * (choice.accuracy - largest(choice.compliance_error));
  const bool plane_does = largest(by_plane) <= budget;
  choice.gaps = {{to_string(GapModel::PlaneOfAction), by_plane, plane.seconds, plane_does},
                 {to_string(GapModel::WholeSurface), {}, whole.seconds, !plane_does}};
  if (plane_does) choice.gap_error = by_plane;
  choice.fidelity.gap = plane_does ? GapModel::PlaneOfAction : GapModel::WholeSurface;
}

/// Meshes over whole cycles, kept by their resolution; those of a few positions are made as they are asked for.
class MeshMemory {
 public:
  MeshOfResolution remembering(MeshOfResolution make) {
    return [this, make = std::move(make)](const MeshResolution& resolution) {
      constexpr std::size_t whole_cycle = 8;
      if (resolution.phases.size() < whole_cycle) return make(resolution);
      const auto key = std::pair(resolution.quadrature.intervals, resolution.phases.size());
      const auto known = known_.find(key);
      return known != known_.end() ? known->second : known_.emplace(key, make(resolution)).first->second;
    };
  }

 private:
  std::map<std::pair<int, std::size_t>, MeshModel> known_;
};

void choose_resolution(RungRunner& runner, FidelityChoice& choice, const ProgressReport& progress) {
  const std::vector<DesignScene>& scenes = runner.subject().scenes;
  DiscretisationSearch search;
  const double spent = largest(added(choice.compliance_error, choice.gap_error));
  search.accuracy = std::max(choice.accuracy - spent, least_resolution * choice.accuracy);
  search.choose_intervals = !choice.quadrature_given;
  search.choose_positions = !choice.positions_given;
  const QuadratureRule rule = choice.quadrature_given ? choice.fidelity.quadrature.rule : QuadratureRule::Graded;
  if (choice.quadrature_given) search.fewest_intervals = choice.fidelity.quadrature.intervals;
  choice.fidelity.quadrature = {rule, search.fewest_intervals};
  if (!choice.positions_given) choice.positions = 0;
  const Rung rung = coarse_rung(choice.fidelity);
  const auto size = [](const Discretisation& d) { return static_cast<double>(d.quadrature.intervals) * d.positions; };
  std::map<MeshPlacement, MeshMemory> memories;  // load cases of one placement share their meshes
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (progress) progress("choosing accuracy", static_cast<int>(s), static_cast<int>(scenes.size()), scenes[s].name);
    MeshMemory& memory = memories[MeshPlacement::of(rung.gap, scenes[s].condition.misalignment)];
    const MeshOfResolution mesh_for = memory.remembering(runner.mesh(rung, scenes[s]));
    const Discretisation found = choose_discretisation(mesh_for, rule, scenes[s].condition, scenes[s].torque, search);
    // What one load case needs the others have as well: they begin there.
    if (search.choose_intervals) search.fewest_intervals = std::max(search.fewest_intervals, found.quadrature.intervals);
    if (search.choose_positions) search.fewest_positions = std::max(search.fewest_positions, found.positions);
    choice.failures += found.failures;
    if (s == 0 || size(found) > size(choice.discretisation)) {
      choice.governing = scenes[s].name;
      choice.governing_torque = scenes[s].torque;
      choice.discretisation = found;
    }
    choice.fidelity.quadrature.intervals = std::max(choice.fidelity.quadrature.intervals, found.quadrature.intervals);
    if (!choice.positions_given) choice.positions = std::max(choice.positions, found.positions);
    raise(choice.quadrature_error, found.quadrature_error);
    raise(choice.position_error, found.position_error);
    raise(choice.resolution_error, found.error());
  }
}

}  // namespace

PerFigure FidelityChoice::error() const {
  return added(added(compliance_error, gap_error), resolution_error);
}

double FidelityChoice::effects_budget() const { return kept ? 0.5 * (accuracy - largest(error())) : 0.0; }

FidelityChoice choose_fidelity(RungRunner& runner, const ProgressReport& progress) {
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
  Rung rung = coarse_rung(choice.fidelity);
  rung.quadrature = choice.fidelity.quadrature;
  rung.positions = choice.positions;
  choice.cycle_seconds = runner.run(rung).seconds;
  choice.kept = choice.failures == 0 && largest(choice.error()) <= choice.accuracy;
  return choice;
}

std::string unmet_accuracy(const FidelityChoice& choice) {
  if (choice.failures > 0) return "the accuracy asked for is not known to be kept: the load distribution did not converge everywhere";
  const PerFigure error = choice.error();
  const auto worst = std::ranges::max_element(error);
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
