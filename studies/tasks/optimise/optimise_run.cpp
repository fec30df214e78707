#include "studies/tasks/optimise/optimise_run.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"
#include "core/fidelity/resolved_analysis.hpp"
#include "optimize/assessment/usual_signs.hpp"
#include "optimize/design/between_positions.hpp"
#include "optimize/design/more_intervals.hpp"
#include "optimize/design/spare_limits.hpp"
#include "studies/tasks/optimise/drawn_scenes.hpp"
#include "studies/tasks/optimise/life_error.hpp"
#include "studies/analysis/study_effects.hpp"
#include "studies/compliance/study_compliance.hpp"
#include "studies/study_file/study_life.hpp"
#include "studies/tasks/optimise/assessment.hpp"
#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/tasks/optimise/scatter.hpp"
#include "studies/tasks/optimise/unmet_constraints.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

namespace {

class OptimiseRun {
 public:
  OptimiseRun(StudyRun& run, OptimiseResults& found) : run_(run), results_(run.results()), found_(found) {}

  void run() {
    const Study& study = results_.study;
    run_.set_phases();
    found_.task = design_task();
    SolverOptions options = study.table<OptimiseTable>().solver;
    const std::string unit = study.table<OptimiseTable>().objective.size() == 1 ? study.table<OptimiseTable>().objective.front().unit() : "";
    options.progress = [&](int analyses, double best) {
      run_.report("optimising", analyses, 0, std::isnan(best) ? "none within the limits so far" : fmt::format("best so far {:.5g} {}", best, unit));
    };
    DesignProblem problem(found_.task);
    const DesignOptions choice{options, study.table<OptimiseTable>().starts};
    announce_violations_of_start(problem);
    DesignOptions exact = choice;
    exact.to_grind = false;
    TwoLevelDesign found = optimise_by_two_levels(problem, exact);
    take_more_positions(problem, exact, found);
    take_better_usual_design(problem, exact, found);
    const std::vector<double> by_intervals = take_more_intervals(problem, exact, found);
    choose_what_to_grind(problem, choice, found);
    keep_constraints_where_finer(problem, choice, by_intervals, found);
    if (seeks_extremes(study))
      search_between_positions(
          problem, [&](const DesignAnalysis& of) { return resolved_cycles(problem, of, false); }, found);
    found_.design = found.design;
    found_.search_work = {found.search, found.fine, found.objective_seen_by_search, found.design.after.objective};
    if (!study.table<OptimiseTable>().pareto_objectives.empty()) {
      problem.set_start({});  // the file's own values again
      const std::vector<Eigen::VectorXd> known{problem.scaled_design(found_.design.after.variables).cwiseMax(0.0).cwiseMin(1.0)};
      found_.front = trace_front(problem, study.table<OptimiseTable>().pareto_objectives, study.table<OptimiseTable>().pareto_points, choice, known);
      if (seeks_extremes(study))
        resolve_front(
            problem, [&](const DesignAnalysis& of) { return resolved_cycles(problem, of, false); }, known, *found_.front);
    }
    const DesignResult& design = found_.design;
    results_.steps.push_back({"load_distribution", "all analyses of the optimisation", design.seconds});
    Assessment assessment = assess_optimum(study, problem, found_.task, design, run_.progress());
    if (study.table<OptimiseTable>().scatter.asked()) {
      assessment.is_of = AssessedDesign::WithoutScatter;
      choose_over_draws(problem);
    }
    // It tries the design that is shown, which scatter may have chosen.
    const std::vector<DesignScene> drawn = run_.loaded(draw_scenes(study, study.table<OptimiseTable>().assessment.validation));
    if (!drawn.empty()) {
      run_.report("validating", 0, 1, fmt::format("{} draws", study.table<OptimiseTable>().assessment.validation.samples));
      assessment.validation = validate(study, found_.task, design, drawn, best_of(assessment.rules));
      assessment.seconds += assessment.validation->seconds;
    }
    found_.assessment = std::move(assessment);
    results_.steps.push_back({"proof_of_the_optimum", "rules of thumb, variants, sensitivities", found_.assessment.seconds});
    const Stopwatch clock;
    const std::size_t first = add_both_designs(problem);
    results_.steps.push_back({"before_and_after", "both designs with their errors, wide ones beside a finer mesh", clock.seconds()});
    run_.rate();
    run_.rate_life();
    show_what_is_resolved(problem, first);
    if (found_.assessment.relaxation) state_shown_excess();
    add_unmet_by_design(problem, results_.study.table<OptimiseTable>(), found_.design, results_.requirements);
    if (found_.scatter) add_unmet_over_draws();
  }

 private:
  /// What is to be ground is the design over the draws; the listed scenes show it.
  void choose_over_draws(const DesignProblem& problem) {
    const auto load_cases = [&](const std::vector<Scene>& scenes) { return run_.loaded(scenes); };
    ScatterResult scatter = run_scatter(results_.study, found_.task, found_.design, load_cases, run_.progress());
    results_.steps.push_back({"scatter", "search over drawn gears and assemblies", scatter.design.seconds});
    const auto add = [this](const char* name, const char* why, double seconds) {
      if (seconds > 0.0) results_.steps.push_back({name, why, seconds});
    };
    add("prediction", "the statistic from draws that the search has not seen", scatter.predicted.seconds);
    add("fresh_draws", "the designs on further draws", scatter.fresh_seconds);
    if (!scatter.classes.empty()) add("tolerance_classes", "the right design of each class", scatter.classes_seconds);
    found_.design.after = report_design(problem, problem.analyse_design(scatter.design.modification));
    found_.design.exact.reset();  // of the search over the listed scenes
    found_.design.choices = scatter.design.choices;
    found_.scatter = std::move(scatter);
  }

  void add_unmet_over_draws() {
    const ScatterDesign& design = found_.scatter->design;
    if (design.status == SolverStatus::Converged || design.status == SolverStatus::Stalled) return;
    results_.requirements.push_back(fmt::format("the search over the draws ended early ({}): {}", to_string(design.status), design.message));
  }

  /// Said before the search, which may take long and find that the constraints cannot be kept.
  void announce_violations_of_start(const DesignProblem& problem) const {
    const OptimiseTable& asked = results_.study.table<OptimiseTable>();
    if (asked.constraints.empty() && asked.modification_constraints.empty()) return;
    const DesignAnalysis start = problem.analyse_given();
    if (!std::ranges::all_of(start.cycles, [](const LoadedCycle& cycle) { return cycle.usable(); })) return;
    for (const std::string& violated : violated_constraints(problem, asked, report_design(problem, start))) {
      spdlog::info("the search starts outside the constraints: {}", violated);
    }
  }

  /// The listed ones and those drawn from tolerances.
  std::vector<DesignScene> all_scenes() const {
    std::vector<DesignScene> scenes = run_.loaded_scenes();
    const int spectra = static_cast<int>(results_.study.scenes.size());
    for (DesignScene& scene : run_.loaded(draw_scenes(results_.study, results_.study.table<OptimiseTable>().assessment.scenes))) {
      if (scene.spectrum >= 0) scene.spectrum += spectra;
      scene.draw = -1;  // here each of its load cases is a scene like those listed
      scenes.push_back(std::move(scene));
    }
    return scenes;
  }

  DesignTask design_task() {
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

  /// Of an accuracy that asks for finite elements: the fitted compliance, whose optima lie near theirs.
  std::shared_ptr<const PairCompliance> structure_to_search_by() const {
    Study fitted = results_.study;
    fitted.fidelity.compliance = ComplianceModel::Fitted;
    return gear_structures(fitted, results_.pair, run_.progress()).pair;
  }

  /// The excess of the design as it is shown, with what lies between the positions, in place of that at the positions.
  void state_shown_excess() {
    double& excess = found_.assessment.relaxation->excess;
    excess = std::max(excess, excess_of(found_.design.after));
    found_.design.message = message_of_excess(excess);
  }

  /// By how much a design exceeds the constraint that it exceeds most [-, relative to the limit]; below 0: it keeps all.
  double excess_of(const DesignReport& report) const {
    double excess = -INFINITY;
    const std::vector<OutputConstraint>& constraints = found_.task.constraints;
    for (std::size_t c = 0; c < constraints.size(); ++c) excess = std::max(excess, constraints[c].excess(report.constraint_values[c]));
    return excess;
  }

  /// A design as it is shown, with what lies between the positions.
  DesignReport shown_between_positions(const DesignProblem& problem, const DesignReport& report) {
    DesignReport shown = report;
    resolve_report(problem, resolved_cycles(problem, shown.analysis, false), shown);
    return shown;
  }

  /// Whether the positions see too little of a design. Between them the objective, or the value of a constraint that is exceeded, rises by more than the accuracy for
  /// which an analysis chooses its positions. Where no design keeps the constraints, the excess takes the objective's place.
  bool rises_between_positions(const DesignReport& at_positions, const DesignReport& shown, bool infeasible) const {
    constexpr double accuracy = AutomaticResolution{}.accuracy;
    if (infeasible) return 1.0 + excess_of(shown) > (1.0 + accuracy) * (1.0 + excess_of(at_positions));
    const std::vector<OutputConstraint>& constraints = found_.task.constraints;
    for (std::size_t c = 0; c < constraints.size(); ++c) {
      const double value = shown.constraint_values[c], rise = value - at_positions.constraint_values[c];
      if (constraints[c].excess(value) > DesignLog::tolerance && rise > accuracy * std::abs(constraints[c].limit())) return true;
    }
    return shown.objective > (1.0 + accuracy) * at_positions.objective;
  }

  /// A search at few positions may leave a peak between them, such as that of an edge which a hundredth of a micrometre of relief keeps from touching. It goes
  /// on at twice the positions then.
  void take_more_positions(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found) {
    constexpr int most_turns = 2;
    const Cycle& cycle = results_.study.cycle;
    for (int turn = 0; turn < most_turns && seeks_extremes(results_.study) && cycle.automatic_positions; ++turn) {
      const Stopwatch clock;
      const double seconds = found.design.seconds;
      const DesignReport& best = exact_of(found);
      const bool infeasible = found.design.status == SolverStatus::Infeasible;  // then it is the excess that was searched for
      if (!rises_between_positions(best, shown_between_positions(problem, best), infeasible)) return;
      const Eigen::VectorXd x = problem.scaled_design(best.variables).cwiseMax(0.0).cwiseMin(1.0);
      run_.set_positions(2 * cycle.positions);
      go_on_at_resolution(problem, options, x, found);
      found.fine.seconds += clock.seconds();
      found.design.seconds = seconds + clock.seconds();
    }
  }

  /// The best design met, before choices and steps.
  static const DesignReport& exact_of(const TwoLevelDesign& found) { return found.design.exact ? *found.design.exact : found.design.after; }

  /// A search with few points along the contact lines may see a transmission error, or an order of the scenes, that more points do not. It goes on with twice
  /// the intervals then, up to those of an analysis.
  /// @returns by how much still more intervals change the constraints, as FinerLook has it; empty where that is not known
  std::vector<double> take_more_intervals(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found) {
    while (may_look_finer()) {
      const Stopwatch clock;
      const double seconds = found.design.seconds;
      const DesignReport& best = exact_of(found);
      const bool usable = std::ranges::all_of(best.analysis.cycles, [](const LoadedCycle& cycle) { return cycle.usable(); });
      if (!usable) return {};
      const FinerLook look = look_finer(problem, best, found.design.status == SolverStatus::Infeasible);
      if (!look.needs_more) return look.excess_changes;
      const Eigen::VectorXd x = problem.scaled_design(best.variables).cwiseMax(0.0).cwiseMin(1.0);
      run_.set_intervals(2 * results_.study.fidelity.quadrature.intervals);
      go_on_at_resolution(problem, options, x, found);
      found.fine.seconds += clock.seconds();
      found.design.seconds = seconds + clock.seconds();
    }
    return {};
  }

  bool may_look_finer() const {
    const Fidelity& fidelity = results_.study.fidelity;
    return fidelity.automatic_intervals && 2 * fidelity.quadrature.intervals <= AutomaticResolution{}.most_intervals;
  }

  /// Continues from a design, or from optima beside it, at a resolution that has changed.
  void go_on_at_resolution(DesignProblem& problem, const DesignOptions& options, const Eigen::VectorXd& x, TwoLevelDesign& found) {
    found_.task = design_task();
    problem = DesignProblem(found_.task);
    go_on_from_best(problem, options, best_starts(problem, found.design, x), found);
    found.fine.resolution = problem.task().resolution;
  }

  /// A search may get stuck at a design that is seldom ground. Where the best design within the limits that flanks have as a rule is better, the search goes on
  /// from there. A list of objectives is left out, because each of its objectives has a limit from the ones before.
  void take_better_usual_design(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found) {
    const DesignReport& best = found.design.after;
    const bool usable = std::ranges::all_of(best.analysis.cycles, [](const LoadedCycle& cycle) { return cycle.usable(); });
    if (!usable || best.analysis.cycles.empty() || found.design.status == SolverStatus::Infeasible || !problem.task().later_objectives.empty())
      return;
    const Stopwatch clock;
    run_.report("looking for the usual signs", 0, 1, "");
    const std::optional<UsualSigns> usual = find_usual_signs(problem, best, left_of(options.solver, found.design).max_seconds);
    if (!usual || !usual->design || !(usual->price < -worth_going_on)) return;
    const double seconds = found.design.seconds;
    TwoLevelDesign further = found;
    problem.set_start(problem.scaled_design(usual->design->variables).cwiseMax(0.0).cwiseMin(1.0));
    go_on(problem, options, further);
    if (further.design.status == SolverStatus::Infeasible || !(further.design.after.objective < found.design.after.objective)) return;
    found = std::move(further);
    found.fine.seconds += clock.seconds();
    found.design.seconds = seconds + clock.seconds();
  }
  /// Relative gain of the objective below which two designs are as good.
  static constexpr double worth_going_on = 1e-3;

  /// Constraints that are kept at the positions may be exceeded between them, or with more intervals along the contact lines. They are then asked for at the positions with as much
  /// to spare, and the search goes on from there; `problem` has these limits afterwards. A limit that would fall to 0 stays as it is. Of
  /// all designs met, the one is kept that exceeds the constraints least as it is seen more finely. Nothing to do where no design keeps the constraints at all.
  /// @param by_intervals  of the design found, see take_more_intervals()
  void keep_constraints_where_finer(DesignProblem& problem, const DesignOptions& options, std::vector<double> by_intervals, TwoLevelDesign& found) {
    constexpr int most_turns = 3;
    struct Turn {
      TwoLevelDesign found;
      DesignTask task;
      double excess;
    };
    const std::vector<OutputConstraint>& asked = found_.task.constraints;
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
      const Eigen::VectorXd x = problem.scaled_design(exact_of(found).variables);
      problem = DesignProblem(tighter);
      problem.set_start(x.cwiseMax(0.0).cwiseMin(1.0));
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

  /// Per constraint the excess of a design with what more intervals would add to it; what they would take from it is left out.
  /// @param shown         with what lies between the positions
  /// @param by_intervals  FinerLook::excess_changes
  std::vector<double> finer_excesses(const DesignReport& shown, const std::vector<double>& by_intervals) const {
    const std::vector<OutputConstraint>& asked = found_.task.constraints;
    std::vector<double> excesses;
    for (std::size_t c = 0; c < asked.size(); ++c)
      excesses.push_back(asked[c].excess(shown.constraint_values[c]) + (by_intervals.empty() ? 0.0 : std::max(0.0, by_intervals[c])));
    return excesses;
  }

  /// A scene with the modifications of a design.
  DesignScene scene_of(const DesignAnalysis& analysis, int s) const {
    DesignScene scene = found_.task.scenes[static_cast<std::size_t>(s)];
    scene.condition = scene.with_design(analysis.modification);
    return scene;
  }

  std::vector<ResolvedCycle> resolved_cycles(const DesignProblem& problem, const DesignAnalysis& analysis, bool with_errors) {
    std::vector<StudyRun::SolvedCase> cases;
    for (int s = 0; s < problem.scenes(); ++s) {
      cases.push_back({scene_of(analysis, s), &problem.model(s), &analysis.cycles[static_cast<std::size_t>(s)]});
    }
    return run_.resolved(cases, with_errors);
  }

  /// Adds the load cases of the design before, and behind them those of the design after.
  /// @returns the index of the first
  std::size_t add_both_designs(const DesignProblem& problem) {
    const std::size_t first = results_.loaded.size();
    add_load_cases(problem, "before", found_.design.before.analysis);
    add_load_cases(problem, "after", found_.design.after.analysis);
    run_.hold_against_finer(first);
    return first;
  }

  /// Puts what the load cases show, and how well it is known, into the reports.
  /// @param first  the load case of the first scene before
  void show_what_is_resolved(const DesignProblem& problem, std::size_t first) {
    const auto resolve = [&](std::size_t begin, DesignReport& report) {
      std::vector<ResolvedCycle> cycles;
      for (int s = 0; s < problem.scenes(); ++s) cycles.push_back(results_.loaded[begin + static_cast<std::size_t>(s)].resolved);
      const auto life_error_in = [&](const ObjectiveTerm& term, int scene) {
        return results_.life ? life_error(*results_.life, begin + static_cast<std::size_t>(scene), term.output) : not_given;
      };
      return resolve_report(problem, cycles, report, life_error_in);
    };
    found_.before_errors = resolve(first, found_.design.before);
    found_.after_errors = resolve(first + static_cast<std::size_t>(problem.scenes()), found_.design.after);
    if (found_.design.exact) resolve_report(problem, resolved_cycles(problem, found_.design.exact->analysis, false), *found_.design.exact);
  }

  void add_load_cases(const DesignProblem& problem, const std::string& name, const DesignAnalysis& analysis) {
    std::vector<DesignScene> scenes;
    for (int s = 0; s < problem.scenes(); ++s) scenes.push_back(scene_of(analysis, s));
    run_.add_loaded(scenes, name, analysis.cycles);
  }

  StudyRun& run_;
  StudyResults& results_;
  OptimiseResults& found_;
};

}  // namespace

void run_optimise(StudyRun& run) {
  const auto found = std::make_shared<OptimiseResults>();
  OptimiseRun(run, *found).run();
  found->task.meshes = nullptr;  // they are the run's
  if (found->assessment.judged) found->assessment.judged->meshes = nullptr;
  const DesignResult& design = found->design;
  run.results().designs = {{"before", design.before.analysis.modification}, {"after", design.after.analysis.modification}};
  run.results().set_found<OptimiseResults>(found);
}

}  // namespace flankwright::studies
