#include "studies/tasks/optimise/optimise_search.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"
#include "optimize/assessment/rules_of_thumb.hpp"
#include "optimize/assessment/usual_signs.hpp"
#include "optimize/design/between_positions.hpp"
#include "optimize/design/grinding/grindable_design.hpp"
#include "optimize/design/more_intervals.hpp"
#include "optimize/design/resolved_design.hpp"
#include "optimize/design/spare_limits.hpp"
#include "studies/analysis/study_effects.hpp"
#include "studies/compliance/study_compliance.hpp"
#include "studies/study_file/study_life.hpp"
#include "studies/tasks/optimise/drawn_scenes.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"
#include "studies/tasks/optimise/unmet_constraints.hpp"

namespace flankwright::studies {

namespace {

/// Relative gain of the objective below which two designs are as good.
constexpr double worth_going_on = 1e-3;

}  // namespace

OptimiseSearch::OptimiseSearch(StudyRun& run) : run_(run), results_(run.results()) {
  run_.set_phases();
  task_ = design_task();
}

TwoLevelDesign OptimiseSearch::find(DesignProblem& problem, const DesignOptions& options) {
  DesignOptions exact = options;
  exact.to_grind = false;
  TwoLevelDesign found = optimise_by_two_levels(problem, exact);
  take_better_rule(problem, exact, found);
  take_more_positions(problem, exact, found);
  take_better_usual_design(problem, exact, found);
  keep_accuracy(problem, exact, found);
  const std::vector<double> by_intervals = take_more_intervals(problem, exact, found);
  choose_what_to_grind(problem, options, found);
  keep_constraints_where_finer(problem, options, by_intervals, found);
  if (seeks_extremes(results_.study)) {
    const DesignResolver resolve = [&](const DesignAnalysis& of) { return resolved_cycles(problem, of, false); };
    if (exceeds_between_positions(problem, found)) {
      problem = DesignProblem(task_);
      keep_limits_between_positions(problem, resolve, found);
    }
    search_between_positions(problem, resolve, found);
  }
  show_accurately(problem, found);
  complete_confirmed(problem, found);
  return found;
}

std::vector<DesignScene> OptimiseSearch::all_scenes() const {
  std::vector<DesignScene> scenes = run_.loaded_scenes();
  const int spectra = static_cast<int>(results_.study.scenes.size());
  for (DesignScene& scene : run_.loaded(draw_scenes(results_.study, results_.study.table<OptimiseTable>().assessment.scenes))) {
    if (scene.spectrum >= 0) scene.spectrum += spectra;
    scene.draw = -1;  // here each of its load cases is a scene like those listed
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

DesignTask OptimiseSearch::design_task() {
  const Study& study = results_.study;
  DesignTask task;
  task.pair = results_.pair;
  task.material = study.material;
  task.resolution = {study.fidelity.quadrature, results_.phases};
  task.gap = gap_model(results_.effects);
  task.effects = results_.mesh_effects;
  task.structure = run_.structures().pair;
  if (study.fidelity.accuracy && study.fidelity.compliance == ComplianceModel::Fe) task.search_structure = structure_to_search_by();
  task.shafts = results_.shafts;
  task.meshes = run_.mesh_store();
  task.modification = analysed_modification(study, results_.effects);
  task.variables = study.table<OptimiseTable>().variables;
  task.objective = study.table<OptimiseTable>().objective;
  task.over = study.table<OptimiseTable>().over;
  task.within_draw = study.table<OptimiseTable>().over;
  task.constraints = study.table<OptimiseTable>().constraints;
  task.links = study.table<OptimiseTable>().links;
  task.modification_constraints = study.table<OptimiseTable>().modification_constraints;
  task.grindable = study.table<OptimiseTable>().grindable;
  task.later_objectives = study.table<OptimiseTable>().later_objectives;
  task.lexicographic_tolerance = study.table<OptimiseTable>().lexicographic_tolerance;
  if (asks_for_root_stress(study)) task.root_stress = run_.structures().root_stress;
  task.life = life_model(study);
  task.scenes = all_scenes();  // an unloaded scene has no stress and no loaded transmission error to choose by
  return task;
}

std::shared_ptr<const PairCompliance> OptimiseSearch::structure_to_search_by() const {
  Study fitted = results_.study;
  fitted.fidelity.compliance = ComplianceModel::Fitted;
  return gear_structures(fitted, results_.pair, run_.progress()).pair;
}

double OptimiseSearch::excess_of(const DesignReport& report) const {
  double excess = -INFINITY;
  const std::vector<OutputConstraint>& constraints = task_.constraints;
  for (std::size_t c = 0; c < constraints.size(); ++c) excess = std::max(excess, constraints[c].excess(report.constraint_values[c]));
  return excess;
}

DesignReport OptimiseSearch::shown_between_positions(const DesignProblem& problem, const DesignReport& report) {
  DesignReport shown = report;
  resolve_report(problem, resolved_cycles(problem, shown.analysis, false), shown);
  return shown;
}

bool OptimiseSearch::rises_between_positions(const DesignReport& at_positions, const DesignReport& shown, bool infeasible) const {
  const double accuracy = results_.study.fidelity.resolution_accuracy;
  if (infeasible) return 1.0 + excess_of(shown) > (1.0 + accuracy) * (1.0 + excess_of(at_positions));
  const std::vector<OutputConstraint>& constraints = task_.constraints;
  for (std::size_t c = 0; c < constraints.size(); ++c) {
    const double value = shown.constraint_values[c], rise = value - at_positions.constraint_values[c];
    if (constraints[c].excess(value) > DesignLog::tolerance && rise > accuracy * std::abs(constraints[c].limit())) return true;
  }
  return shown.objective > (1.0 + accuracy) * at_positions.objective;
}

void OptimiseSearch::take_more_positions(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found) {
  constexpr int most_turns = 2;
  const Cycle& cycle = results_.study.cycle;
  for (int turn = 0; turn < most_turns && seeks_extremes(results_.study) && cycle.automatic_positions; ++turn) {
    const Stopwatch clock;
    const double seconds = found.design.seconds;
    const DesignReport& best = exact_of(found);
    const bool infeasible = found.design.status == SolverStatus::Infeasible;  // then it is the excess that was searched for
    if (!rises_between_positions(best, shown_between_positions(problem, best), infeasible)) return;
    const Eigen::VectorXd x = problem.nearest_design(best.variables);
    const std::optional<DesignReport> ground = infeasible ? std::nullopt : ground_of(problem, options, x, found);
    if (ground && !rises_between_positions(*ground, shown_between_positions(problem, *ground), false)) return;
    run_.set_positions(2 * cycle.positions);
    go_on_at_resolution(problem, options, x, found);
    found.fine.seconds += clock.seconds();
    found.design.seconds = seconds + clock.seconds();
  }
}

std::optional<DesignReport> OptimiseSearch::ground_of(DesignProblem& problem, const DesignOptions& options, const Eigen::VectorXd& x,
                                                      TwoLevelDesign& found) {
  const int analyses = problem.analyses();
  const DesignToGrind to_grind = design_to_grind(problem, x, left_of(options.solver, found.design));
  DesignReport ground = report_design(problem, problem.analyse(to_grind.x, false));
  found.design.evaluations += problem.analyses() - analyses + to_grind.choice_analyses;
  found.design.failures += to_grind.failures;
  return to_grind.is_changed && ground.analysis.usable() ? std::optional(std::move(ground)) : std::nullopt;
}

std::vector<double> OptimiseSearch::take_more_intervals(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found) {
  while (may_look_finer()) {
    const Stopwatch clock;
    const double seconds = found.design.seconds;
    const DesignReport& best = exact_of(found);
    if (!best.analysis.usable()) return {};
    const bool infeasible = found.design.status == SolverStatus::Infeasible;
    const FinerLook look = look_finer(problem, best, infeasible);
    if (!look.needs_more) return look.excess_changes;
    const Eigen::VectorXd x = problem.nearest_design(best.variables);
    if (const std::optional<DesignReport> ground = infeasible ? std::nullopt : ground_of(problem, options, x, found)) {
      const FinerLook of_ground = look_finer(problem, *ground, false);
      if (!of_ground.needs_more) return of_ground.excess_changes;
    }
    run_.set_intervals(2 * results_.study.fidelity.quadrature.intervals);
    go_on_at_resolution(problem, options, x, found);
    found.fine.seconds += clock.seconds();
    found.design.seconds = seconds + clock.seconds();
  }
  return {};
}

bool OptimiseSearch::may_look_finer() const {
  const Fidelity& fidelity = results_.study.fidelity;
  return fidelity.automatic_intervals && 2 * fidelity.quadrature.intervals <= AutomaticResolution{}.most_intervals;
}

void OptimiseSearch::go_on_at_resolution(DesignProblem& problem, const DesignOptions& options, const Eigen::VectorXd& x, TwoLevelDesign& found) {
  task_ = design_task();
  problem = DesignProblem(task_);
  go_on_from_best(problem, options, best_starts(problem, found.design, x), found);
  found.fine.resolution = problem.task().resolution;
}

void OptimiseSearch::take_better_usual_design(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found) {
  const DesignReport& best = found.design.after;
  if (!best.analysis.usable() || best.analysis.cycles.empty() || found.design.status == SolverStatus::Infeasible ||
      !problem.task().later_objectives.empty())
    return;
  const Stopwatch clock;
  run_.report("looking for the usual signs", 0, 1, "");
  const std::optional<UsualSigns> usual = find_usual_signs(problem, best, left_of(options.solver, found.design).max_seconds);
  if (!usual || !usual->design || !(usual->price < -worth_going_on)) return;
  const double seconds = found.design.seconds;
  go_on_from_better(problem, options, problem.nearest_design(usual->design->variables), found);
  found.design.seconds = seconds + clock.seconds();
}

void OptimiseSearch::take_better_rule(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found) {
  const DesignReport& best = found.design.after;
  if (!best.analysis.usable() || best.analysis.cycles.empty() || !problem.task().later_objectives.empty()) return;
  const Stopwatch clock;
  const double seconds = found.design.seconds;
  run_.report("trying rules of thumb", 0, 1, "");
  std::vector<NamedDesign> designs;
  for (const Eigen::VectorXd& x : within_bounds(problem, rules_of_thumb(problem.task(), rule_basis(problem)))) {
    designs.push_back({"", "", problem.modification(x)});
  }
  const bool is_infeasible = found.design.status == SolverStatus::Infeasible;
  if (!is_infeasible) designs = promising(problem, designs, best);
  const std::vector<ComparedDesign> rules = compare_designs_by_two_levels(problem, designs);
  const ComparedDesign* const rule = best_of(rules);
  if (rule != nullptr && (is_infeasible || relative_increase(best.objective, rule->objective) < -worth_going_on))
    go_on_from_better(problem, options, within_bounds(problem, {rule->design}).front(), found);
  found.design.seconds = seconds + clock.seconds();
}

std::vector<NamedDesign> OptimiseSearch::promising(const DesignProblem& problem, const std::vector<NamedDesign>& designs,
                                                   const DesignReport& found) const {
  constexpr double by_resolution = 0.1;  // of a stress, as the coarse resolution of a search may have it less than the task's own
  const DesignTask& task = problem.task();
  if (task.over != Aggregate::Worst || found.scene_measures.empty()) return designs;
  const auto worst = static_cast<int>(std::ranges::max_element(found.scene_measures) - found.scene_measures.begin());
  const bool over_spectrum = task.combined_objective().over_spectrum();
  const int spectrum = task.scenes[static_cast<std::size_t>(worst)].spectrum;
  std::vector<int> scenes;
  for (int s = 0; s < problem.scenes(); ++s) {
    if (s == worst || (over_spectrum && task.scenes[static_cast<std::size_t>(s)].spectrum == spectrum)) scenes.push_back(s);
  }
  const std::vector<ComparedDesign> compared = compare_designs_by_two_levels(problem.over_scenes(scenes), designs);
  const double margin = std::pow(1.0 + by_resolution, task.combined_objective().growth()) - 1.0;
  std::vector<NamedDesign> some;
  for (const ComparedDesign& of : compared) {
    if (of.failure.empty() && of.objective < found.objective + margin * std::abs(found.objective)) some.push_back(of.design);
  }
  return some;
}

void OptimiseSearch::go_on_from_better(DesignProblem& problem, const DesignOptions& options, const Eigen::VectorXd& x, TwoLevelDesign& found) {
  const Stopwatch clock;
  TwoLevelDesign further = found;
  problem.set_start(x);
  go_on(problem, options, further);
  const bool was_infeasible = found.design.status == SolverStatus::Infeasible;
  if (further.design.status == SolverStatus::Infeasible) return;
  if (!was_infeasible && !(further.design.after.objective < found.design.after.objective)) return;
  found = std::move(further);
  found.fine.seconds += clock.seconds();
}

void OptimiseSearch::keep_constraints_where_finer(DesignProblem& problem, const DesignOptions& options, std::vector<double> by_intervals,
                                                  TwoLevelDesign& found) {
  constexpr int most_turns = 3;
  struct Turn {
    TwoLevelDesign found;
    DesignTask task;
    double excess;
  };
  const std::vector<OutputConstraint>& asked = task_.constraints;
  const auto infeasible = [&] { return found.design.status == SolverStatus::Infeasible; };
  if (!seeks_extremes(results_.study) || asked.empty() || infeasible()) return;
  std::optional<Turn> best;
  double last = INFINITY;
  for (int turn = 0; turn <= most_turns && !infeasible(); ++turn) {
    const Stopwatch clock;
    const double seconds = found.design.seconds;
    if (turn > 0 && !by_intervals.empty()) by_intervals = look_finer(problem, found.design.after, false).excess_changes;
    const std::vector<double> excesses = finer_excesses(shown_between_positions(problem, found.design.after), by_intervals);
    last = std::max(DesignLog::tolerance, std::ranges::max(excesses));
    if (!best || last < best->excess) best = Turn{found, problem.task(), last};
    DesignTask tighter = problem.task();
    if (!spare_limits(tighter.constraints, asked, found.design.after.constraint_values, excesses) || turn == most_turns) break;
    const Eigen::VectorXd x = problem.nearest_design(exact_of(found).variables);
    problem = DesignProblem(tighter);
    problem.set_start(x);
    go_on(problem, options, found);
    found.fine.seconds += clock.seconds();
    found.design.seconds = seconds + clock.seconds();
  }
  if (!infeasible() && last <= best->excess) return;
  const double seconds = found.design.seconds, fine_seconds = found.fine.seconds;
  problem = DesignProblem(best->task);
  found = std::move(best->found);
  found.design.seconds = seconds;
  found.fine.seconds = fine_seconds;
}

bool OptimiseSearch::exceeds_between_positions(const DesignProblem& problem, const TwoLevelDesign& found) {
  const DesignResult& design = found.design;
  if (design.status == SolverStatus::Infeasible || !design.after.analysis.usable() || (task_.constraints.empty() && design.stages.empty()))
    return false;
  const DesignReport shown = shown_between_positions(problem, design.after);
  double excess = excess_of(shown);
  for (std::size_t k = 0; k + 1 < design.stages.size(); ++k) excess = std::max(excess, shown.objective_of_stage(k) / design.stages[k].limit - 1.0);
  return excess > results_.study.fidelity.resolution_accuracy;
}

std::vector<double> OptimiseSearch::finer_excesses(const DesignReport& shown, const std::vector<double>& by_intervals) const {
  const std::vector<OutputConstraint>& asked = task_.constraints;
  std::vector<double> excesses;
  for (std::size_t c = 0; c < asked.size(); ++c)
    excesses.push_back(asked[c].excess(shown.constraint_values[c]) + (by_intervals.empty() ? 0.0 : std::max(0.0, by_intervals[c])));
  return excesses;
}

DesignScene OptimiseSearch::scene_of(const DesignAnalysis& analysis, int s) const {
  DesignScene scene = task_.scenes[static_cast<std::size_t>(s)];
  scene.condition = scene.with_design(analysis.modification);
  return scene;
}

std::vector<ResolvedCycle> OptimiseSearch::resolved_cycles(const DesignProblem& problem, const DesignAnalysis& analysis, bool with_errors) {
  std::vector<StudyRun::SolvedCase> cases;
  for (int s = 0; s < problem.scenes(); ++s) {
    cases.push_back({scene_of(analysis, s), &problem.model(s), &analysis.cycles[static_cast<std::size_t>(s)]});
  }
  return run_.resolved(cases, with_errors);
}

}  // namespace flankwright::studies
