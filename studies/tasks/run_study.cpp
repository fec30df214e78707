#include "studies/tasks/run_study.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "core/base/stopwatch.hpp"
#include "core/load/cycle/mesh_motion.hpp"
#include "studies/compliance/study_compliance.hpp"
#include "studies/tasks/analyse/position_memory.hpp"
#include "studies/tasks/analyse/drawn_scenes.hpp"
#include "studies/tasks/refine_resolution.hpp"
#include "studies/tasks/requirements.hpp"
#include "studies/tasks/study_effect_sizes.hpp"
#include "studies/tasks/analyse/study_effects.hpp"
#include "studies/tasks/analyse/study_notes.hpp"
#include "studies/study_file/study_shafts.hpp"

namespace flankwright::studies {

namespace {

std::string number(double value, int digits = 4) {
  std::ostringstream out;
  out.precision(digits);
  out << value;
  return out.str();
}

/// Runs one study; each step adds to the results.
class Run {
 public:
  /// @param budget  error of each figure that effects may be left out for [-], see drop_small_effects()
  Run(const Study& study, const ProgressReport& progress, const PerFigure& budget = {}) : progress_(progress), budget_(budget) {
    results_.study = study;
    results_.pair = make_gear_pair(study.pair);
    results_.effects = study_effects(study);
    results_.mesh_effects = mesh_effects(results_.effects);
    results_.notes = study_notes(study, results_.pair);
    if (is_on(results_.effects, "shafts")) results_.shafts = make_shafts(study, results_.pair);
  }

  StudyResults finish() {
    const Stopwatch clock;
    switch (results_.study.task) {
      case Task::Analyse: analyse(); break;
      case Task::Optimise: optimise(); break;
      case Task::Sweep: analyse(); break;  // the nominal sample; the others: run_sweep()
      case Task::Accuracy: accuracy(); break;
      case Task::Fit: fit(); break;
    }
    size_effects();
    add_seconds(results_.effects, results_.mesh_effects, unloaded_seconds_);
    add_unmet_by_load_cases(results_);
    results_.seconds = clock.seconds();
    return std::move(results_);
  }

  /// What every rung of the study analyses.
  RungSubject rung_subject() const { return {results_.study, results_.pair, loaded_scenes(), results_.shafts}; }

 private:
  void note(const std::string& text) { results_.notes.push_back(text); }
  void report(const std::string& label, int done, int total, const std::string& remark = {}) const {
    if (progress_) progress_(label, done, total, remark);
  }

  /// The mesh at a placement, with what derivatives by these parameters need.
  MeshModel mesh(const MeshPlacement& placement, const MeshResolution& resolution, const PairRootStress* root_stress,
                 const std::vector<MeshParameter>& parameters) {
    const MeshPlaced placed = [&](const MeshPlacement& at) {
      const Study& study = results_.study;
      return make_mesh_model(results_.pair, study.pinion_material, study.wheel_material, resolution, results_.mesh_effects, at,
                             structures().pair.get(), root_stress, results_.shafts.get());
    };
    return with_further_meshes(placed(placement), placed, parameters);
  }

  MeshPlacement placement_of(const Misalignment& misalignment) const { return MeshPlacement::of(gap_model(results_.effects), misalignment); }

  /// The mesh for a misalignment, at phases of one's choice and without root stress.
  MeshAt mesh_at(const Misalignment& misalignment, const std::vector<MeshParameter>& parameters = {}) {
    return [this, placement = placement_of(misalignment), parameters](const std::vector<double>& phases) {
      return mesh(placement, {results_.study.fidelity.quadrature, phases}, nullptr, parameters);
    };
  }

  /// Working conditions under load, as far as their effects are on.
  std::vector<DesignScene> loaded_scenes() const { return loaded(results_.study.scenes); }

  std::vector<DesignScene> loaded(const std::vector<Scene>& of_study) const {
    std::vector<DesignScene> scenes;
    for (const Scene& scene : of_study) {
      for (double torque : scene.torques) {
        if (torque == 0.0) continue;
        scenes.push_back({scene.name, scene.weight, torque, apply_effects(results_.effects, condition_of(results_.study, scene))});
      }
    }
    return scenes;
  }

  /// The listed ones and those drawn from tolerances.
  std::vector<DesignScene> all_scenes() const {
    std::vector<DesignScene> scenes = loaded_scenes();
    for (DesignScene& scene : loaded(draw_scenes(results_.study, results_.study.optimise.proof.scenes))) scenes.push_back(std::move(scene));
    return scenes;
  }

  /// Phases of the loaded mesh positions: as given, or evenly spaced.
  void set_phases() {
    const Cycle& cycle = results_.study.cycle;
    results_.phases = cycle.phases.empty() ? equally_spaced_phases(cycle.positions) : cycle.phases;
  }

  /// The mesh models of load cases, those that are new built side by side.
  std::vector<std::size_t> models_for(const std::vector<DesignScene>& scenes) {
    std::vector<std::size_t> models;
    std::vector<MeshPlacement> unknown;
    for (const DesignScene& scene : scenes) {
      const MeshPlacement placement = placement_of(scene.condition.misalignment);
      const auto [it, is_new] = model_index_.try_emplace(placement, results_.models.size() + unknown.size());
      if (is_new) unknown.push_back(placement);
      models.push_back(it->second);
    }
    for (MeshModel& model : meshes(unknown, {results_.study.fidelity.quadrature, results_.phases}, gradient_parameters())) {
      results_.models.push_back(std::move(model));
    }
    return models;
  }

  std::vector<MeshModel> meshes(const std::vector<MeshPlacement>& placements, const MeshResolution& resolution, const std::vector<MeshParameter>& parameters) {
    std::vector<MeshModel> made(placements.size());
    if (placements.empty()) return made;
    const PairRootStress* root_stress = structures().root_stress.get();
    tbb::parallel_for(std::size_t{0}, made.size(), [&](std::size_t i) { made[i] = mesh(placements[i], resolution, root_stress, parameters); });
    return made;
  }

  /// Meshes of the placements with half the intervals at every second position, to hold the study's own resolution against; null for phases
  /// that were given, whose figures are of these phases.
  std::vector<const MeshModel*> coarse_meshes_for(const std::vector<Misalignment>& misalignments) {
    Quadrature quadrature = results_.study.fidelity.quadrature;
    std::vector<const MeshModel*> coarse(misalignments.size(), nullptr);
    if (!results_.study.cycle.phases.empty() || results_.phases.size() < 4 || quadrature.intervals < 2) return coarse;
    quadrature.intervals /= 2;
    std::vector<MeshPlacement> unknown;
    for (const Misalignment& misalignment : misalignments) {
      if (coarse_models_.try_emplace(placement_of(misalignment)).second) unknown.push_back(placement_of(misalignment));
    }
    std::vector<MeshModel> made = meshes(unknown, {quadrature, coarse_phases(results_.phases)}, {});
    for (std::size_t i = 0; i < unknown.size(); ++i) coarse_models_[unknown[i]] = std::move(made[i]);
    for (std::size_t i = 0; i < coarse.size(); ++i) coarse[i] = &coarse_models_.at(placement_of(misalignments[i]));
    return coarse;
  }

  /// A load case that was solved, and its mesh.
  struct SolvedCase {
    DesignScene scene;
    const MeshModel* model;
    const LoadedCycle* cycle;
  };

  /// What solved load cases show, with extremes between their positions, and errors where asked for.
  std::vector<ResolvedCycle> resolved(const std::vector<SolvedCase>& cases, bool with_errors = true) {
    std::vector<Misalignment> misalignments;
    for (const SolvedCase& of : cases) misalignments.push_back(of.scene.condition.misalignment);
    const std::vector<const MeshModel*> coarse = with_errors ? coarse_meshes_for(misalignments) : std::vector<const MeshModel*>(cases.size(), nullptr);
    std::vector<ResolvedCycle> all(cases.size());
    tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t i) {
      const auto& [scene, model, cycle] = cases[i];
      const MeshWithParameters at = [&](const std::vector<double>& phases, const std::vector<MeshParameter>& parameters) {
        return mesh_at(scene.condition.misalignment, parameters)(phases);
      };
      std::optional<LoadedCycle> coarse_cycle;
      if (coarse[i] != nullptr) coarse_cycle = analyse_cycle(*coarse[i], scene.condition, scene.torque);
      const CycleResolving resolving{.seek_extremes = seeks_extremes(results_.study), .coarse = coarse_cycle ? &*coarse_cycle : nullptr};
      all[i] = resolve_cycle(*model, *cycle, at, scene.condition, scene.torque, resolving, gradient_parameters());
    });
    return all;
  }

  /// Both gears' structure and root stress, made when first needed.
  const GearStructures& structures() {
    if (!has_structure_) {
      results_.structures = gear_structures(results_.study, results_.pair, progress_);
      const Study& study = results_.study;
      results_.deflections = gear_deflections(results_.pair, study.pinion_material, study.wheel_material, results_.structures.pair.get(),
                                              study.fidelity.compliance == ComplianceModel::Fe ? "finite elements" : "fitted");
      has_structure_ = true;
      if (const auto& runs = results_.structures.finite_elements) {
        const bool is_structural = couples_teeth(results_.study.fidelity.compliance);
        results_.steps.push_back({"finite_elements",
                                  is_structural ? std::string("compliance is ") + to_string(results_.study.fidelity.compliance) +
                                                      ": influence values of both gears"
                                                : "root stress of both gears",
                                  runs->seconds});
        fit_steps();
        results_.notes.insert(results_.notes.end(), results_.structures.notes.begin(), results_.structures.notes.end());
      }
    }
    return results_.structures;
  }

  /// Says of both gears where the kernels of compliance "fitted" come from.
  void fit_steps() {
    for (const Member member : {Member::Pinion, Member::Wheel}) {
      const auto& refinement = results_.structures.refinement(member);
      if (!refinement) continue;
      const std::string why = refinement->unknown.empty() ? "" : ": " + refinement->unknown;
      results_.steps.push_back({std::string("fit_of_") + name_of(member), refinement->source() + why, refinement->seconds});
    }
  }

  void add_unloaded(const Scene& scene) {
    const FlankCondition condition = apply_effects(results_.effects, condition_of(results_.study, scene));
    results_.unloaded.push_back(analyse_unloaded(results_.pair, scene.name, condition, results_.study.cycle.positions,
                                                 results_.study.marking_thickness));
    const std::optional<ParabolaCheck>& parabola = results_.unloaded.back().parabola;
    if (parabola && !parabola->holds) {
      note("scene \"" + scene.name + "\": the designed parabola of the transmission error does not hold: " + parabola->why);
    }
  }

  /// Adds solved load cases of one design.
  void add_loaded(const std::vector<DesignScene>& scenes, const std::string& design, std::vector<LoadedCycle> cycles) {
    const std::vector<std::size_t> models = models_for(scenes);
    tbb::parallel_for(std::size_t{0}, scenes.size(), [&](std::size_t i) {
      const bool has_none = !cycles[i].positions.empty() && cycles[i].positions.front().root_stress.size() == 0;
      if (has_none) add_root_stress(results_.models[models[i]], cycles[i]);  // a search that did not ask for it has left it out
    });
    std::vector<SolvedCase> cases;
    for (std::size_t i = 0; i < scenes.size(); ++i) cases.push_back({scenes[i], &results_.models[models[i]], &cycles[i]});
    std::vector<ResolvedCycle> shown = resolved(cases);
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const DesignScene& scene = scenes[i];
      const MeshModel& model = results_.models[models[i]];
      const IsoLoadFactors iso = iso_load_factors(model.pair, model.iso, iso_deviations(model.pair, scene.condition), scene.torque, model.face_width);
      const CycleSummary summary = shown[i].summary;
      results_.loaded.push_back({scene.name, scene.torque, design, std::move(cycles[i]), std::move(shown[i]), summary, models[i], scene.condition, iso});
    }
  }

  /// Located peaks with and without spikes, and the load factors that follow.
  void rate() {
    if (!locates_peaks(results_.study)) return;
    std::map<MeshPlacement, PositionMemory> memories;  // the parts of a condition are looked at in the same phases to begin with
    const auto mesh = [&](const Misalignment& m, const std::vector<MeshParameter>& by) {
      return by.empty() ? memories[placement_of(m)].remembering(mesh_at(m)) : mesh_at(m, by);
    };
    for (LoadedResult& loaded : results_.loaded) {
      if (loaded.cycle.usable()) loaded.rating = rater_.rate(mesh, loaded.condition, loaded.torque, gradient_parameters());
    }
  }

  void size_effects() {
    const Stopwatch clock;
    results_.effect_sizes = study_effect_sizes(results_);
    if (results_.effect_sizes.estimated.empty()) return;
    results_.steps.push_back({"effect_sizes", results_.effect_sizes.exact.empty() ? "estimates" : "estimates, and each left out in turn", clock.seconds()});
  }

  std::vector<MeshParameter> gradient_parameters() const {
    std::vector<MeshParameter> parameters;
    for (const GradientParameter& p : results_.study.gradients) parameters.push_back(p.parameter);
    return parameters;
  }

  void analyse() {
    const Study& study = results_.study;
    const bool is_rigid = study.fidelity.compliance == ComplianceModel::Rigid;
    double loaded_seconds = 0.0;
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
    set_phases();
    if (study.task == Task::Analyse) results_.left_out = drop_small_effects(results_, scenes, budget_);
    analyse_loaded(scenes);
    while (refine_resolution(results_)) {
      forget_loaded();
      analyse_loaded(scenes);
    }
    rate();
    loaded_seconds += clock.seconds();
    results_.steps.push_back({"load_distribution", "some torque is above 0: all loaded effects together", loaded_seconds});
  }

  void analyse_loaded(const std::vector<DesignScene>& scenes) {
    const std::vector<MeshParameter> parameters = gradient_parameters();
    const std::vector<std::size_t> models = models_for(scenes);
    std::vector<LoadedCycle> cycles(scenes.size());
    tbb::parallel_for(std::size_t{0}, scenes.size(), [&](std::size_t i) {
      cycles[i] = analyse_cycle(results_.models[models[i]], scenes[i].condition, scenes[i].torque, parameters);
    });
    report("analysing", static_cast<int>(scenes.size()), static_cast<int>(scenes.size()));
    add_loaded(scenes, "given", std::move(cycles));
  }

  /// At another resolution all is made anew.
  void forget_loaded() {
    results_.loaded.clear();
    results_.models.clear();
    model_index_.clear();
    coarse_models_.clear();
    set_phases();
  }

  DesignTask design_task() {
    const Study& study = results_.study;
    DesignTask task;
    task.pair = results_.pair;
    task.pinion_material = study.pinion_material;
    task.wheel_material = study.wheel_material;
    task.resolution = {study.fidelity.quadrature, results_.phases};
    task.gap = gap_model(results_.effects);
    task.effects = results_.mesh_effects;
    task.structure = structures().pair;
    if (study.fidelity.accuracy && study.fidelity.compliance == ComplianceModel::Fe) task.search_structure = structure_to_search_by();
    task.shafts = results_.shafts;
    task.pinion_modification = study.pinion_modification;
    task.wheel_modification = study.wheel_modification;
    task.variables = study.optimise.variables;
    task.objective = study.optimise.objective;
    task.over = study.optimise.over;
    task.constraints = study.optimise.constraints;
    task.ties = study.optimise.ties;
    task.modification_constraints = study.optimise.modification_constraints;
    task.then = study.optimise.then;
    task.lexicographic_tolerance = study.optimise.lexicographic_tolerance;
    if (asks_for_root_stress(study)) task.root_stress = structures().root_stress;
    task.scenes = all_scenes();  // an unloaded scene has no stress and no loaded transmission error to choose by
    return task;
  }

  /// Of an accuracy that asks for finite elements: the fitted compliance, whose optima lie near theirs.
  std::shared_ptr<const PairCompliance> structure_to_search_by() const {
    Study fitted = results_.study;
    fitted.fidelity.compliance = ComplianceModel::Fitted;
    return gear_structures(fitted, results_.pair, progress_).pair;
  }

  void optimise() {
    const Study& study = results_.study;
    set_phases();
    results_.design_task = design_task();
    SolverOptions options;
    options.name = study.optimise.solver;
    options.finisher = study.optimise.finisher;
    options.max_evaluations = study.optimise.max_evaluations;
    options.max_seconds = study.optimise.max_seconds;
    options.seed = study.optimise.seed;
    const std::string unit = study.optimise.objective.size() == 1 ? study.optimise.objective.front().unit() : "";
    options.progress = [&](int analyses, double best) {
      report("optimising", analyses, 0, "best so far " + number(best, 5) + " " + unit);
    };
    DesignProblem problem(*results_.design_task);
    const DesignOptions choice{options, study.optimise.starts};
    TwoLevelDesign found = optimise_by_two_levels(problem, choice);
    keep_constraints_between_positions(problem, choice, found);
    results_.design = found.design;
    results_.search_work = {found.search, found.fine, found.objective_seen_by_search, found.design.after.objective};
    if (!study.optimise.pareto_goals.empty()) {
      results_.front = trace_front(problem, study.optimise.pareto_goals, study.optimise.pareto_points, choice);
    }
    const DesignResult& design = *results_.design;
    results_.steps.push_back({"load_distribution", "all analyses of the optimisation", design.seconds});
    results_.proof = prove_optimum(study, problem, design, loaded(draw_scenes(study, study.optimise.proof.validation)), progress_);
    results_.steps.push_back({"proof_of_the_optimum", "rules of thumb, variants, sensitivities", results_.proof->seconds});
    results_.before_errors = show(problem, "before", results_.design->before);
    results_.after_errors = show(problem, "after", results_.design->after);
    if (results_.design->exact) resolve_report(problem, resolved_cycles(problem, *results_.design->exact, false), *results_.design->exact);
    rate();
    add_unmet_by_design(problem, results_);
  }

  /// Extremes between the positions may exceed a constraint that is kept at the positions. It is then asked for at the positions with as much
  /// to spare, and the search goes on from there; `problem` has these limits afterwards.
  void keep_constraints_between_positions(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found) {
    constexpr int most_turns = 3;
    for (int turn = 0; turn < most_turns && seeks_extremes(results_.study) && !problem.task().constraints.empty(); ++turn) {
      const Stopwatch clock;
      DesignReport shown = found.design.after;
      resolve_report(problem, resolved_cycles(problem, shown, false), shown);
      DesignTask tighter = problem.task();
      bool violated = false;
      for (std::size_t c = 0; c < tighter.constraints.size(); ++c) {
        const double at_positions = found.design.after.constraint_values[c], value = shown.constraint_values[c];
        if (!(results_.design_task->constraints[c].excess(value) > DesignLog::tolerance) || !(value > at_positions)) continue;
        const double limit = results_.design_task->constraints[c].limit() - (1.0 + spare) * (value - at_positions);
        violated = violated || limit < tighter.constraints[c].maximum;
        tighter.constraints[c].maximum = std::min(tighter.constraints[c].maximum, limit);
      }
      if (!violated) return;
      const Eigen::VectorXd x = problem.scaled_design((found.design.exact ? *found.design.exact : found.design.after).variables);
      problem = DesignProblem(tighter);
      problem.set_start(x.cwiseMax(0.0).cwiseMin(1.0));
      go_on(problem, options, found);
      found.fine.seconds += clock.seconds();
      found.design.seconds += clock.seconds();
    }
  }
  /// Of what is asked for to spare, so that one more turn is seldom needed.
  static constexpr double spare = 0.1;

  /// The scenes of a design's report.
  DesignScene scene_of(const DesignReport& report, int s) const {
    DesignScene scene = results_.design_task->scenes[static_cast<std::size_t>(s)];
    scene.condition.pinion_modification = report.analysis.pinion_modification;
    scene.condition.wheel_modification = report.analysis.wheel_modification;
    return scene;
  }

  std::vector<ResolvedCycle> resolved_cycles(const DesignProblem& problem, const DesignReport& report, bool with_errors) {
    std::vector<SolvedCase> cases;
    for (int s = 0; s < problem.scenes(); ++s) {
      cases.push_back({scene_of(report, s), &problem.model(s), &report.analysis.cycles[static_cast<std::size_t>(s)]});
    }
    return resolved(cases, with_errors);
  }

  /// Adds a design's load cases, and puts what they show into its report.
  DesignErrors show(const DesignProblem& problem, const std::string& name, DesignReport& report) {
    std::vector<DesignScene> scenes;
    for (int s = 0; s < problem.scenes(); ++s) scenes.push_back(scene_of(report, s));
    const std::size_t first = results_.loaded.size();
    add_loaded(scenes, name, report.analysis.cycles);
    std::vector<ResolvedCycle> cycles;
    for (std::size_t i = first; i < results_.loaded.size(); ++i) cycles.push_back(results_.loaded[i].resolved);
    return resolve_report(problem, cycles, report);
  }

  void accuracy() {
    analyse();
    RungRunner runner(rung_subject(), progress_);
    results_.ladder = climb_ladder(runner, progress_);
    results_.steps.push_back({"accuracy_ladder", "all rungs of the ladder together", results_.ladder->seconds});
    if (!results_.ladder->usable()) results_.requirements.push_back("the finest rung of the ladder did not converge");
  }

  void fit() {
    results_.effects.clear();  // none of them concerns a single gear
    results_.fits = fit_gears(results_.study, results_.pair, progress_);
    for (const GearFit& fit : results_.fits) {
      const std::string unmet = unmet_requirement(fit);
      if (!unmet.empty()) results_.requirements.push_back(unmet);
    }
  }

  const ProgressReport& progress_;
  PerFigure budget_;
  StudyResults results_;
  std::map<MeshPlacement, std::size_t> model_index_;
  std::map<MeshPlacement, MeshModel> coarse_models_;  ///< half the intervals, every second position
  double unloaded_seconds_{0.0};
  LoadRater rater_;
  bool has_structure_{false};
};

/// Nothing where no accuracy is asked for, or nothing is loaded.
std::optional<FidelityChoice> fidelity_choice(const Study& study, const ProgressReport& progress) {
  if (!study.fidelity.accuracy || study.fidelity.compliance == ComplianceModel::Rigid || study.task == Task::Fit) return std::nullopt;
  RungRunner runner(Run(study, progress).rung_subject(), progress);
  if (runner.subject().scenes.empty()) return std::nullopt;
  return choose_fidelity(runner, progress);
}

}  // namespace

StudyResults run_study(const Study& study, const ProgressReport& progress) {
  const std::optional<FidelityChoice> choice = fidelity_choice(study, progress);
  StudyResults results = choice ? Run(with_choice(study, *choice), progress, choice->effects_budget()).finish() : Run(study, progress).finish();
  if (!choice) return results;
  results.fidelity_choice = choice;
  results.fidelity_choice->left_out = results.left_out;
  results.steps.insert(results.steps.begin(), {"accuracy_choice", "an accuracy is asked for: models and resolution by estimates", choice->choosing_seconds});
  results.seconds += choice->choosing_seconds;
  if (!choice->kept) results.requirements.push_back(unmet_accuracy(*choice));
  return results;
}

}  // namespace flankwright::studies
