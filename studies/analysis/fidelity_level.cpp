#include "studies/analysis/fidelity_level.hpp"

#include <algorithm>
#include <limits>

#include "core/base/thread_stopwatch.hpp"
#include "core/fidelity/resolution_level.hpp"
#include "core/fidelity/resolved_cycle.hpp"
#include "core/rating/contact_peaks.hpp"
#include "optimize/design/problem/for_each_in_parallel.hpp"
#include "studies/compliance/study_compliance.hpp"
#include "studies/analysis/study_effects.hpp"

namespace flankwright::studies {

namespace {

/// A level that takes less is run again and its least time kept [s].
constexpr double fast = 0.1;
constexpr int repeats = 3;

}  // namespace

const char* to_string(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Model:
      return "model";
    case ErrorKind::Discretisation:
      return "discretisation";
    case ErrorKind::Both:
      return "both";
  }
  __builtin_unreachable();
}

const GearStructures& LevelRunner::structures(ComplianceModel model) {
  const auto known = structures_.find(model);
  if (known != structures_.end()) return known->second;
  GearStructures made;
  if (couples_teeth(model)) {
    Study study = subject_.study;
    study.fidelity.compliance = model;
    made = gear_structures(study, subject_.pair, progress_);
  }
  return structures_.emplace(model, std::move(made)).first->second;
}

double LevelRunner::first_seconds(ComplianceModel model) {
  const GearStructures& made = structures(model);
  double seconds = 0.0;
  if (!made.finite_elements) return seconds;
  const auto add = [&](const GearRun& run) { seconds += run.statistics.model_seconds + run.statistics.solve_seconds; };
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    add((*made.finite_elements)[member]);
    for (const auto* run : {&made.finite_elements->fine[member], &made.finite_elements->narrow[member]}) {
      if (*run) add(**run);
    }
    const auto& correction = made.corrections[member];
    if (correction && !correction->unknown.empty()) seconds += correction->fit.seconds;
  }
  return seconds;
}

MeshEffects LevelRunner::effects(const FidelityLevel& level) const {
  const bool is_rigid = level.compliance == ComplianceModel::Rigid;
  Study study = subject_.study;
  study.fidelity.compliance = is_rigid ? ComplianceModel::ThinSlice : level.compliance;  // load is not left out
  study.fidelity.gap = level.gap;
  EffectDecisions decisions = study_effects(study);
  const std::string why = "left out at this level";
  if (is_rigid) decisions = without(std::move(decisions), "bending", why);
  for (const std::string& name : level.left_out) decisions = without(std::move(decisions), name, why);
  return mesh_effects(decisions);
}

MeshOfResolution LevelRunner::mesh(const FidelityLevel& level, const DesignScene& scene) {
  const MeshPlacement placement = placement_of(level.gap, scene.condition, subject_.shafts.get(), scene.torque);
  return [this, on = effects(level), placement, structure = structures(level.compliance).pair](const MeshResolution& resolution) {
    const Study& study = subject_.study;
    return make_mesh_model(subject_.pair, study.material, resolution, on, placement, {.structure = structure.get(), .shafts = subject_.shafts.get()},
                           for_each_in_parallel);
  };
}

std::vector<CycleFigures> LevelRunner::figures(const FidelityLevel& level) {
  std::vector<CycleFigures> all;
  std::map<MeshPlacement, MeshModel> models;  // as a study's run shares them
  for (const DesignScene& scene : subject_.scenes) {
    const MeshOfResolution mesh_for = mesh(level, scene);
    const MeshPlacement placement = placement_of(level.gap, scene.condition, subject_.shafts.get(), scene.torque);
    auto known = models.find(placement);
    if (known == models.end()) {
      known = models.emplace(placement, mesh_for({level.quadrature, equally_spaced_phases(level.positions)})).first;
    }
    const MeshModel& model = known->second;
    const LoadedCycle cycle = analyse_cycle(model, scene.condition, scene.torque);
    if (!cycle.usable()) return {};
    CycleFigures figures = figures_of(cycle, summarise(model, cycle));
    if (level.located_peaks) {
      const auto mesh_at = [&](const std::vector<double>& phases) { return mesh_for({level.quadrature, phases}); };
      const MeshWithParameters at = [&](const std::vector<double>& phases, const std::vector<MeshParameter>&) { return mesh_at(phases); };
      const CycleResolving resolving{.seek_extremes = level.quadrature.rule == QuadratureRule::Graded};
      figures = figures_of(cycle, resolve_cycle(model, cycle, at, scene.condition, scene.torque, resolving).summary);
      const ContactPeaks peaks = locate_peaks(mesh_at, scene.condition, scene.torque, {.everywhere = true});
      if (peaks.failures > 0) return {};
      figures[Figure::LoadFactor] *= peaks.everywhere.line_load.value / figures[Figure::PeakLineLoad];
      figures[Figure::PeakLineLoad] = peaks.everywhere.line_load.value;
      figures[Figure::PeakContactStress] = peaks.everywhere.contact_stress.value;
    }
    all.push_back(figures);
  }
  return all;
}

LevelResult LevelRunner::run(const FidelityLevel& level) {
  structures(level.compliance);  // not counted
  LevelResult result{level, {}};
  result.seconds = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i) {
    const ThreadStopwatch clock;
    result.scenes = figures(level);
    result.seconds = std::min(result.seconds, clock.seconds());
    if (result.seconds > fast) break;
  }
  return result;
}

PerFigure worst_errors(const LevelResult& level, const LevelResult& reference) {
  PerFigure worst{};
  if (!level.usable() || !reference.usable()) worst.fill(std::numeric_limits<double>::infinity());
  for (std::size_t s = 0; level.usable() && reference.usable() && s < level.scenes.size(); ++s) {
    const PerFigure errors = figure_errors(level.scenes[s], reference.scenes[s]);
    for (std::size_t i = 0; i < worst.size(); ++i) worst[i] = std::max(worst[i], errors[i]);
  }
  return worst;
}

}  // namespace flankwright::studies
