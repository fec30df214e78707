#include "studies/analysis/study_run.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/stopwatch.hpp"
#include "core/load/cycle/mesh_motion.hpp"
#include "core/load/cycle/mesh_root_stress.hpp"
#include "core/rating/shaft_misalignment.hpp"
#include "optimize/design/problem/for_each_in_parallel.hpp"
#include "studies/analysis/governing_cases.hpp"
#include "studies/analysis/refine_resolution.hpp"
#include "studies/analysis/requirements.hpp"
#include "studies/analysis/study_effect_sizes.hpp"
#include "studies/analysis/step_progress.hpp"
#include "studies/analysis/study_effects.hpp"
#include "studies/analysis/study_notes.hpp"
#include "studies/compliance/study_compliance.hpp"
#include "studies/study_file/study_shafts.hpp"
#include "studies/analysis/rims.hpp"

namespace flankwright::studies {

StudyRun::StudyRun(const Study& study, const ProgressReport& progress, const std::optional<FidelityChoice>& choice) : progress_(progress) {
  results_.study = study;
  results_.fidelity_choice = choice;
  results_.pair = make_gear_pair(study.pair);
  if (!study.task->single_gears) {
    results_.effects = study_effects(study);
    results_.mesh_effects = mesh_effects(results_.effects);
  }
  results_.notes = study_notes(study, results_.pair);
  if (is_on(results_.effects, "shafts")) results_.shafts = make_shafts(study, results_.pair);
}

StudyResults StudyRun::finish() {
  const Stopwatch clock;
  results_.study.task->run(*this);
  find_edge_contact();
  note_large_motions();
  if (!results_.life) rate_life();
  if (const std::string note = points_note(results_); !note.empty()) results_.notes.push_back(note);
  size_effects();
  add_seconds(results_.effects, results_.mesh_effects, unloaded_seconds_);
  add_unmet_by_load_cases(results_);
  add_unmet_by_shafts(results_);
  state_resolution(results_);
  if (results_.fidelity_choice && !results_.fidelity_choice->kept) results_.requirements.push_back(unmet_accuracy(*results_.fidelity_choice));
  results_.seconds = clock.seconds();
  return std::move(results_);
}

void StudyRun::report(const std::string& label, int done, int total, const std::string& remark) const {
  if (progress_) progress_(label, done, total, remark);
}

std::string StudyRun::resolution_in_words() const {
  return fmt::format("{} intervals, {} positions", results_.study.fidelity.quadrature.intervals, results_.phases.size());
}

MeshModel StudyRun::mesh(const MeshPlacement& placement, const MeshResolution& resolution, const PairRootStress* root_stress,
                         const PairCompliance* shafts, const std::vector<MeshParameter>& parameters) {
  const MeshPlaced placed = [&](const MeshPlacement& at) {
    const Study& study = results_.study;
    return make_mesh_model(results_.pair, study.material, resolution, results_.mesh_effects, at,
                           {.structure = structures().pair.get(), .root_stress = root_stress, .shafts = shafts}, for_each_in_parallel);
  };
  return with_perturbed_meshes(placed(placement), placed, parameters);
}

MeshPlacement StudyRun::placement_of(const FlankCondition& condition, double torque) const {
  return flankwright::placement_of(gap_model(results_.effects), condition, results_.shafts.get(), torque);
}

MeshAt StudyRun::mesh_at(const FlankCondition& condition, double torque, bool shafts_deflect, const std::vector<MeshParameter>& parameters,
                         Quadrature quadrature) {
  const PairCompliance* const shafts = shafts_deflect ? results_.shafts.get() : nullptr;
  const MeshPlacement placement = flankwright::placement_of(gap_model(results_.effects), condition, shafts, torque);
  MeshAt made = [this, placement, shafts, parameters, quadrature](const std::vector<double>& phases) {
    return mesh(placement, {quadrature, phases}, nullptr, shafts, parameters);
  };
  if (!parameters.empty()) return made;
  const std::lock_guard lock(memories_mutex_);
  const std::tuple key(placement, quadrature.intervals, shafts != nullptr);
  return memories_.try_emplace(key, position_budget_).first->second.remembering(std::move(made));
}

std::vector<DesignScene> StudyRun::loaded(const std::vector<Scene>& of_study) const {
  const std::vector<SpectrumBin>& bins = results_.study.spectrum;
  const LifeTable& life = results_.study.life;
  std::vector<DesignScene> scenes;
  for (std::size_t number = 0; number < of_study.size(); ++number) {
    const Scene& scene = of_study[number];
    double revolutions = 0.0;  // under load
    for (std::size_t k = 0; k < bins.size(); ++k) revolutions += scene.torques[k] > 0.0 ? bins[k].cycles : 0.0;
    for (std::size_t k = 0; k < scene.torques.size(); ++k) {
      const double torque = scene.torques[k];
      if (torque == 0.0) continue;
      DesignScene& loaded = scenes.emplace_back(DesignScene{
          scene.name, scene.weight, torque, apply_effects(results_.effects, condition_of(results_.study, scene)), {.speed = scene.speed}});
      loaded.operation.application_factor = life.application_factor;
      loaded.operation.dynamic_factor = life.dynamic_factor;
      loaded.deviations = scene.deviations;
      loaded.draw = scene.draw;
      if (bins.empty()) continue;
      const SpectrumBin& bin = bins[k];
      loaded.operation = {.revolutions = bin.cycles,
                          .speed = bin.speed,
                          .duration = bin.hours,
                          .temperature = bin.temperature,
                          .same_teeth = bin.same_teeth,
                          .meshes_per_revolution = life.meshes_per_revolution,
                          .application_factor = life.application_factor,
                          .dynamic_factor = std::isnan(bin.dynamic_factor) ? life.dynamic_factor : bin.dynamic_factor};
      loaded.weight *= bin.cycles / revolutions;
      loaded.spectrum = static_cast<int>(number);
      loaded.bin = static_cast<int>(k);
      loaded.spectrum_loads = static_cast<int>(std::ranges::count_if(scene.torques, [](double t) { return t != 0.0; }));
      if (bin.mesh_misalignment == 0.0) continue;
      loaded.condition = apply_effects(results_.effects, condition_of(results_.study, under_load(scene, bin)));
    }
  }
  return scenes;
}

void StudyRun::set_phases() {
  const Cycle& cycle = results_.study.cycle;
  results_.phases = cycle.phases.empty() ? equally_spaced_phases(cycle.positions) : cycle.phases;
}

void StudyRun::set_intervals(int intervals) {
  assert(results_.loaded.empty());
  results_.study.fidelity.quadrature.intervals = intervals;
  forget_loaded();
}

void StudyRun::set_positions(int positions) {
  assert(results_.loaded.empty());
  results_.study.cycle.positions = positions;
  forget_loaded();
}

std::vector<std::size_t> StudyRun::models_for(const std::vector<DesignScene>& scenes) {
  std::vector<std::size_t> models;
  std::vector<MeshPlacement> unknown;
  for (const DesignScene& scene : scenes) {
    const MeshPlacement placement = placement_of(scene.condition, scene.torque);
    const auto [it, is_new] = model_index_.try_emplace(placement, results_.models.size() + unknown.size());
    if (is_new) unknown.push_back(placement);
    models.push_back(it->second);
  }
  structures();
  std::vector<MeshModel> made(unknown.size());
  StepProgress step(progress_, "making meshes", made.size(), resolution_in_words());
  tbb::parallel_for(std::size_t{0}, made.size(), [&](std::size_t i) {
    made[i] = mesh_of_load_cases(unknown[i]);
    step.add_one();
  });
  std::ranges::move(made, std::back_inserter(results_.models));
  return models;
}

std::shared_ptr<const MeshModel> StudyRun::mesh_of_search(const MeshPlacement& placement, const MeshResolution& resolution) const {
  const GearStructures& of = results_.structures;
  MeshKey key{placement, resolution, results_.mesh_effects.list(), of.pair, of.root_stress, results_.shafts};
  if (auto known = mesh_store_->find(key)) return known;
  key.root_stress = nullptr;  // that of a search which does not ask for it
  return mesh_store_->find(key);
}

MeshModel StudyRun::mesh_of_load_cases(const MeshPlacement& placement) {
  const MeshResolution resolution{results_.study.fidelity.quadrature, results_.phases};
  const PairRootStress* root_stress = structures().root_stress.get();
  const std::vector<MeshParameter> parameters = gradient_parameters();
  const auto known = parameters.empty() ? mesh_of_search(placement, resolution) : nullptr;
  if (!known) return mesh(placement, resolution, root_stress, results_.shafts.get(), parameters);
  MeshModel model = *known;
  const bool lacks_root_stress = root_stress != nullptr && model.positions.front().root_stress.stations.empty();
  if (lacks_root_stress) add_root_stress_influence(model, *root_stress, for_each_in_parallel);
  return model;
}

const GearStructures& StudyRun::structures() {
  if (!has_structure_) {
    results_.structures = gear_structures(results_.study, results_.pair, progress_);
    const Study& study = results_.study;
    results_.deflections = gear_deflections(results_.pair, study.material.pinion, study.material.wheel, results_.structures.pair.get(),
                                            study.fidelity.compliance == ComplianceModel::Fe ? "finite elements" : "fitted", for_each_in_parallel);
    has_structure_ = true;
    if (const auto& runs = results_.structures.finite_elements) {
      const bool is_structural = couples_teeth(results_.study.fidelity.compliance);
      results_.steps.push_back(
          {"finite_elements",
           is_structural ? std::string("compliance is ") + to_string(results_.study.fidelity.compliance) + ": influence values of both gears"
                         : "root stress of both gears",
           runs->seconds});
      note_fits();
      results_.notes.insert(results_.notes.end(), results_.structures.notes.begin(), results_.structures.notes.end());
    }
  }
  return results_.structures;
}

void StudyRun::note_fits() {
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const auto& correction = results_.structures.corrections[member];
    if (!correction) continue;
    const std::string why = correction->unknown.empty() ? "" : ": " + correction->unknown;
    results_.steps.push_back({std::string("fit_of_") + name_of(member), correction->source() + why, correction->seconds});
  }
}

void StudyRun::add_unloaded(const Scene& scene) {
  const FlankCondition condition = apply_effects(results_.effects, condition_of(results_.study, scene));
  results_.unloaded.push_back(
      analyse_unloaded(results_.pair, scene.name, condition, results_.study.cycle.positions, results_.study.marking_thickness));
  const std::optional<ParabolaCheck>& parabola = results_.unloaded.back().parabola;
  if (parabola && !parabola->holds) {
    results_.notes.push_back("scene \"" + scene.name + "\": the designed parabola of the transmission error does not hold: " + parabola->why);
  }
}

void StudyRun::add_loaded(const std::vector<DesignScene>& scenes, const std::string& design, std::vector<LoadedCycle> cycles) {
  const std::vector<std::size_t> models = models_for(scenes);
  std::vector<std::vector<PerGear<ShaftMotion>>> motions(scenes.size());
  tbb::parallel_for(std::size_t{0}, scenes.size(), [&](std::size_t i) {
    const bool has_none = !cycles[i].positions.empty() && cycles[i].positions.front().root_stress.size() == 0;
    const MeshModel& model = results_.models[models[i]];
    if (has_none) add_root_stress(model, cycles[i]);  // a search that did not ask for it has left it out
    if (results_.shafts) motions[i] = shaft_motions(shafts_under(*results_.shafts, model, scenes[i].torque), model, cycles[i]);
  });
  std::vector<SolvedCase> cases;
  for (std::size_t i = 0; i < scenes.size(); ++i) cases.push_back({scenes[i], &results_.models[models[i]], &cycles[i]});
  std::vector<ResolvedCycle> shown = resolved(cases);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const DesignScene& scene = scenes[i];
    const MeshModel& model = results_.models[models[i]];
    const double by_shafts = results_.shafts ? shaft_misalignment(*results_.shafts, motions[i]) : 0.0;
    IsoLoadFactors iso;  // not known where the shafts' loads are not
    if (!std::isnan(by_shafts)) {
      iso =
          iso_load_factors(model.pair, model.iso, iso_deviations(model.pair, scene.condition, by_shafts + rim_opening(results_, model, scene.torque)),
                           scene.torque, model.face_width);
    }
    const CycleSummary summary = shown[i].summary;
    results_.loaded.push_back(
        {scene.name, scene.torque, design, std::move(cycles[i]), std::move(shown[i]), summary, models[i], scene.condition, iso});
    if (!std::isnan(results_.loaded.back().resolved.errors.te_mean))
      results_.loaded.back().compared_intervals = results_.study.fidelity.quadrature.intervals / 2;
    results_.loaded.back().operation = scene.operation;
    results_.loaded.back().bin = scene.bin;
    results_.loaded.back().spectrum_loads = scene.spectrum_loads;
    results_.loaded.back().shaft_motions = std::move(motions[i]);
  }
}

std::vector<MeshParameter> StudyRun::gradient_parameters() const {
  std::vector<MeshParameter> parameters;
  for (const GradientParameter& p : results_.study.gradients) parameters.push_back(p.parameter);
  return parameters;
}

void StudyRun::analyse() {
  const Study& study = results_.study;
  const bool is_rigid = study.fidelity.compliance == ComplianceModel::Rigid;
  if (!is_rigid && has_torque(study)) structures();  // its time is its own
  for (const Scene& scene : study.scenes) {
    if (!is_rigid && std::ranges::find(scene.torques, 0.0) == scene.torques.end()) continue;
    const Stopwatch clock;
    add_unloaded(scene);
    unloaded_seconds_ += clock.seconds();
  }
  const std::vector<DesignScene> scenes = is_rigid ? std::vector<DesignScene>() : loaded_scenes();
  if (scenes.empty()) return;
  const Stopwatch clock;
  begin_coarsely();
  analyse_loaded(scenes);
  while (needs_more_resolution()) {
    forget_loaded();
    analyse_loaded(scenes);
  }
  leave_out_small_effects(scenes);
  hold_against_finer(0);
  note_what_stays_wide(judged_cases(results_), results_);
  results_.steps.push_back({"load_distribution", "some torque is above 0: all loaded effects together", clock.seconds()});
  rate();
}

void StudyRun::begin_coarsely() {
  // An accuracy of more than the usual one may be kept with less than what a study without one begins with.
  constexpr int fewest_intervals = 6, fewest_positions = 16;
  Fidelity& fidelity = results_.study.fidelity;
  Cycle& cycle = results_.study.cycle;
  const bool is_lax = results_.fidelity_choice && results_.fidelity_choice->accuracy > AutomaticResolution{}.accuracy;
  if (is_lax && fidelity.automatic_intervals) fidelity.quadrature.intervals = fewest_intervals;
  if (is_lax && cycle.automatic_positions) cycle.positions = fewest_positions;
  set_phases();
}

bool StudyRun::needs_more_resolution() {
  if (results_.fidelity_choice) hold_against_finer(0);
  return refine_resolution(judged_cases(results_), results_);
}

void StudyRun::leave_out_small_effects(const std::vector<DesignScene>& scenes) {
  if (!results_.fidelity_choice || !results_.study.task->one_design) return;
  state_resolution(results_);
  results_.left_out = drop_small_effects(results_, scenes, results_.fidelity_choice->effects_budget());
  if (results_.left_out.names.empty()) return;
  forget_loaded();
  analyse_loaded(scenes);
}

void StudyRun::analyse_loaded(const std::vector<DesignScene>& scenes) {
  const std::vector<MeshParameter> parameters = gradient_parameters();
  const std::vector<std::size_t> models = models_for(scenes);
  std::vector<LoadedCycle> cycles(scenes.size());
  StepProgress step(progress_, "analysing", scenes.size(), resolution_in_words());
  tbb::parallel_for(std::size_t{0}, scenes.size(), [&](std::size_t i) {
    cycles[i] = analyse_cycle(results_.models[models[i]], scenes[i].condition, scenes[i].torque, parameters);
    step.add_one();
  });
  report("analysing", static_cast<int>(scenes.size()), static_cast<int>(scenes.size()), resolution_in_words());
  add_loaded(scenes, "given", std::move(cycles));
}

void StudyRun::forget_loaded() {
  results_.loaded.clear();
  results_.models.clear();
  model_index_.clear();
  coarse_models_.clear();
  memories_.clear();
  set_phases();
}

}  // namespace flankwright::studies
