#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "core/fidelity/resolved_analysis.hpp"
#include "optimize/design/problem/for_each_in_parallel.hpp"
#include "studies/analysis/film_readings.hpp"
#include "studies/analysis/governing_cases.hpp"
#include "studies/analysis/step_progress.hpp"
#include "studies/analysis/study_run.hpp"
#include "studies/study_file/study_life.hpp"

namespace flankwright::studies {

namespace {

Quadrature halved(Quadrature quadrature) {
  quadrature.intervals /= 2;
  return quadrature;
}

/// A cycle without root stress, both halves of its positions side by side. In the second half loads start from others than in analyse_cycle(), which
/// changes digits beyond the tolerance of LoadOptions.
LoadedCycle analyse_halves(const MeshModel& model, const FlankCondition& condition, double torque) {
  std::vector<std::size_t> positions(model.positions.size());
  std::iota(positions.begin(), positions.end(), std::size_t{0});
  const std::size_t half = positions.size() / 2;
  std::array<LoadedCycle, 2> halves;
  for_each_in_parallel(halves.size(), [&](std::size_t i) {
    const auto part = std::span(positions).subspan(i * half, i == 0 ? half : positions.size() - half);
    halves[i] = analyse_positions(model, part, condition, torque, RootStresses::Later);
  });
  LoadedCycle cycle = std::move(halves[0]);
  for (std::size_t i = half; i < positions.size(); ++i) cycle.positions[i] = std::move(halves[1].positions[i]);
  cycle.failures += halves[1].failures;
  return cycle;
}

/// A contact on a tip edge may be so short that it peaks between the positions, where it changes by more than at them. Its errors by points reach as far as twice what the
/// peaks among positions and extremes change by, the sum of all further doublings with order one, or as `stated` where that is less.
/// @param finer, at_extremes  with twice the intervals: at the positions, and at the extremes of `resolved`
void widen_edge_errors(const CycleErrors& stated, const CycleSummary& summary, const LoadedCycle& finer, const LoadedCycle& at_extremes,
                       ResolvedCycle& resolved) {
  double stress = 0.0, share = 0.0;
  for (const LoadedCycle* cycle : {&finer, &at_extremes}) {
    for (const LoadedPosition& position : cycle->positions) {
      if (position.edge_stress.size() > 0) stress = std::max(stress, position.edge_stress.maxCoeff());
      share = std::fmax(share, position.tip_edge_share);
    }
  }
  const auto widened = [&](auto error, double seen, double shown) {
    CycleErrors& points = resolved.error_parts.points;
    points.*error = std::fmin(stated.*error, std::fmax(points.*error, 2.0 * std::abs(seen - shown)));
  };
  if (!finer.usable() || !at_extremes.usable()) return;
  widened(&CycleErrors::edge_stress, stress, summary.edge_stress);
  widened(&CycleErrors::tip_edge_share, share, summary.tip_edge_share);
  join_edge_to_peak(summary, resolved.error_parts.points);
  resolved.errors = resolved.error_parts.sum(resolved.summary);
}

}  // namespace

std::vector<const MeshModel*> StudyRun::coarse_meshes_for(const std::vector<MeshPlacement>& placements) {
  const Quadrature& quadrature = results_.study.fidelity.quadrature;
  std::vector<const MeshModel*> coarse(placements.size(), nullptr);
  if (!results_.study.cycle.phases.empty() || results_.phases.size() < 4 || quadrature.intervals < 2) return coarse;
  std::vector<MeshPlacement> unknown;
  for (const MeshPlacement& placement : placements) {
    if (coarse_models_.try_emplace(placement).second) unknown.push_back(placement);
  }
  const MeshResolution resolution{halved(quadrature), coarse_phases(results_.phases)};
  const PairRootStress* root_stress = structures().root_stress.get();
  tbb::parallel_for(std::size_t{0}, unknown.size(),
                    [&](std::size_t i) { coarse_models_.at(unknown[i]) = mesh(unknown[i], resolution, root_stress, results_.shafts.get(), {}); });
  for (std::size_t i = 0; i < coarse.size(); ++i) coarse[i] = &coarse_models_.at(placements[i]);
  return coarse;
}

std::optional<CoarseCycle> StudyRun::coarse_cycle_of(const LoadedResult& loaded) const {
  const auto found = coarse_models_.find(placement_of(loaded.condition, loaded.torque));
  if (found == coarse_models_.end()) return std::nullopt;
  CoarseCycle coarse{&found->second, analyse_cycle(found->second, loaded.condition, loaded.torque, {}, RootStresses::Later)};
  return coarse.cycle.usable() ? std::optional(std::move(coarse)) : std::nullopt;
}

std::vector<ResolvedCycle> StudyRun::resolved(const std::vector<SolvedCase>& cases, bool with_errors) {
  std::vector<MeshPlacement> placements;
  for (const SolvedCase& of : cases) placements.push_back(placement_of(of.scene.condition, of.scene.torque));
  const std::vector<const MeshModel*> coarse = with_errors ? coarse_meshes_for(placements) : std::vector<const MeshModel*>(cases.size(), nullptr);
  const std::shared_ptr<const LifeModel> life = life_model(results_.study);
  std::vector<ResolvedCycle> all(cases.size());
  StepProgress step(progress_, "seeking peaks and errors", cases.size(), resolution_in_words());
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) {
    const auto& [scene, model, cycle] = cases[i];
    const MeshWithParameters at = [&](const std::vector<double>& phases, const std::vector<MeshParameter>& parameters) {
      return mesh_at(scene.condition, scene.torque, true, parameters, results_.study.fidelity.quadrature)(phases);
    };
    std::optional<LoadedCycle> coarse_cycle;
    if (coarse[i] != nullptr) coarse_cycle = analyse_cycle(*coarse[i], scene.condition, scene.torque);
    const CycleResolving resolving{.seek_extremes = seeks_extremes(results_.study),
                                   .coarse = coarse_cycle ? &*coarse_cycle : nullptr,
                                   .coarse_model = coarse[i],
                                   .coarse_at = mesh_at(scene.condition, scene.torque, true, {}, halved(results_.study.fidelity.quadrature)),
                                   .further = life ? film_readings(*model, *life, scene.operation, cycle->force) : std::vector<PointReading>()};
    all[i] = resolve_cycle(*model, *cycle, at, scene.condition, scene.torque, resolving, gradient_parameters());
    step.add_one();
  });
  return all;
}

void StudyRun::hold_against_finer(std::size_t first) {
  // Meshes beyond the finest that a run may take are large. The design before is known well enough without.
  const bool is_finest = 2 * results_.study.fidelity.quadrature.intervals > AutomaticResolution{}.most_intervals;
  std::vector<HeldCase> cases;
  std::vector<LoadedResult*> of;
  const bool few = results_.loaded.size() <= most_cases_compared_finely;
  const std::vector<bool> governs = few ? std::vector<bool>(results_.loaded.size(), true) : governing_cases(results_);
  for (std::size_t i = first; i < results_.loaded.size(); ++i) {
    LoadedResult& loaded = results_.loaded[i];
    if (!governs[i] || (is_finest && loaded.design == "before")) continue;
    // A search favours designs whose errors are in their favour. Its design is therefore held against every finer mesh that the search has made.
    cases.push_back({{loaded.scene, loaded.torque, &results_.models[loaded.model], &loaded.cycle, &loaded.resolved},
                     &loaded.condition,
                     &loaded.resolved,
                     loaded.operation,
                     loaded.design == "after",
                     loaded.compared_intervals});
    of.push_back(&loaded);
  }
  hold_against_finer(cases);
  for (std::size_t i = 0; i < of.size(); ++i) of[i]->compared_intervals = cases[i].compared_intervals;
}

void StudyRun::hold_against_finer(std::vector<HeldCase>& cases) {
  if (!results_.study.fidelity.automatic_intervals) return;
  Quadrature quadrature = results_.study.fidelity.quadrature;
  quadrature.intervals *= 2;
  struct Held {
    HeldCase* of;
    bool is_wide;
  };
  std::map<MeshPlacement, std::vector<Held>> held;
  for (HeldCase& of : cases) {
    if (of.compared_intervals == quadrature.intervals) continue;
    const CycleErrors& points = of.resolved->error_parts.points;
    const CycleSummary& summary = of.resolved->summary;
    const double error = headline_error(points, summary, *of.judged.cycle);
    // Half the intervals may meet hardly anything of a narrow contact on a tip edge. It counts beside the peak that it may come to exceed.
    const double on_edges = points.edge_stress / summary.peak_contact_stress;
    const MeshPlacement placement = placement_of(*of.condition, of.judged.torque);
    const bool is_wide = std::isgreater(std::fmax(std::fmax(error, on_edges), points.tip_edge_share), results_.study.fidelity.resolution_accuracy);
    const bool is_known = of.is_found && mesh_of_search(placement, {quadrature, results_.phases});
    if (is_wide || is_known) held[placement].push_back({&of, is_wide});
  }
  const std::shared_ptr<const LifeModel> life = life_model(results_.study);
  const std::vector<std::pair<MeshPlacement, std::vector<Held>>> placed(held.begin(), held.end());
  StepProgress step(progress_, "comparing with twice the intervals", placed.size(), resolution_in_words());
  tbb::parallel_for(std::size_t{0}, placed.size(), [&](std::size_t i) {  // one mesh a thread: they are large
    std::shared_ptr<const MeshModel> known = mesh_of_search(placed[i].first, {quadrature, results_.phases});
    if (!known) known = std::make_shared<const MeshModel>(mesh(placed[i].first, {quadrature, results_.phases}, nullptr, results_.shafts.get(), {}));
    const MeshModel& finer = *known;
    const std::vector<Held>& of_mesh = placed[i].second;
    tbb::parallel_for(std::size_t{0}, of_mesh.size(), [&](std::size_t k) {
      const auto& [of, is_wide] = of_mesh[k];
      const double torque = of->judged.torque;
      const LoadedCycle cycle = analyse_halves(finer, *of->condition, torque);
      const CycleErrors stated = of->resolved->error_parts.points;
      const SolvedCycle shown{of->judged.model, of->judged.cycle};
      const auto further = life ? film_readings(*shown.model, *life, of->operation, shown.cycle->force) : std::vector<PointReading>();
      flankwright::hold_against_finer(shown, {&finer, &cycle}, further, *of->resolved);
      const std::vector<double>& phases = of->resolved->extremes.phases;
      if (is_wide && !phases.empty() && stated.edge_stress > 0.0) {
        const MeshModel between = mesh_at(*of->condition, torque, true, {}, quadrature)(phases);
        const LoadedCycle at_extremes = analyse_cycle(between, *of->condition, torque, {}, RootStresses::Later);
        widen_edge_errors(stated, of->resolved->summary, cycle, at_extremes, *of->resolved);
      }
      of->compared_intervals = quadrature.intervals;
    });
    step.add_one();
  });
}

}  // namespace flankwright::studies
