#include "studies/tasks/optimise/optimise_run.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"
#include "studies/analysis/case_life.hpp"
#include "studies/analysis/study_notes.hpp"
#include "studies/base/plain_names.hpp"
#include "studies/study_file/study_life.hpp"
#include "studies/tasks/optimise/drawn_scenes.hpp"
#include "studies/tasks/optimise/edge_advice.hpp"
#include "studies/tasks/optimise/life_error.hpp"
#include "studies/tasks/optimise/assessment.hpp"
#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/tasks/optimise/optimise_search.hpp"
#include "studies/tasks/optimise/scatter.hpp"
#include "studies/tasks/optimise/unmet_constraints.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

namespace {

class OptimiseRun {
 public:
  OptimiseRun(StudyRun& run, OptimiseResults& found) : run_(run), results_(run.results()), found_(found), search_(run) {}

  void run() {
    const Study& study = results_.study;
    SolverOptions options = study.table<OptimiseTable>().solver;
    const OptimiseTable& asked = study.table<OptimiseTable>();
    const std::string unit = asked.objective.size() == 1 && asked.later_objectives.empty() ? asked.objective.front().unit() : "";
    options.progress = [&](int analyses, double best) {
      run_.report("optimising", analyses, 0, std::isnan(best) ? "none within the limits so far" : fmt::format("best so far {:.5g} {}", best, unit));
    };
    DesignProblem problem(search_.task());
    const DesignOptions choice{options, study.table<OptimiseTable>().starts};
    announce_violations_of_start(problem);
    const TwoLevelDesign found = search_.find(problem, choice);
    found_.task = search_.task();
    found_.design = found.design;
    found_.search_work = {found.search, found.fine, found.objective_seen_by_search, found.confirmed, found.design.after.objective};
    if (found_.search_work.confirmed) found_.search_work.confirmed->problem = nullptr;  // its meshes are large
    if (!study.table<OptimiseTable>().pareto_objectives.empty()) {
      const Stopwatch clock;
      problem.set_start({});  // the file's own values again
      const std::vector<Eigen::VectorXd> known{problem.nearest_design(found_.design.after.variables)};
      DesignOptions tracing = choice;
      tracing.solver.progress = [&](int analyses, double) { run_.report("tracing the front", analyses, 0, ""); };
      found_.front = trace_front(problem, asked.pareto_objectives, asked.pareto_points, tracing, known);
      const auto with_errors = [&](const DesignAnalysis& of) { return search_.resolved_cycles(problem, of, true); };
      if (seeks_extremes(study))
        resolve_front(problem, found_.task.constraints, with_errors, known, *found_.front,
                      [&](const auto& of, const auto& cycles) { return life_errors_of(problem, of, cycles); });
      results_.steps.push_back({"front", "compromises of several objectives", clock.seconds()});
    }
    const DesignResult& design = found_.design;
    results_.steps.push_back({"load_distribution", "all analyses of the optimisation", design.seconds});
    Assessment assessment = assess_optimum(study, problem, found_.task, found, run_.progress());
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
    if (found_.scatter) {
      add_unmet_over_draws();
      note_steep_statistic();
    }
    if (found_.front) add_what_the_front_lacks();
    for (const std::string& note : steep_lead_notes(found_.design.after.analysis.modification, results_.pair))
      results_.notes.push_back("of the design found, " + note);
    if (const auto advice = edge_advice(study.table<OptimiseTable>(), results_.loaded)) results_.notes.push_back(*advice);
  }

 private:
  /// Errors of film, temperatures and their safeties of a design of the front.
  FurtherError life_errors_of(const DesignProblem& problem, const DesignAnalysis& analysis, const std::vector<ResolvedCycle>& cycles) const {
    const std::shared_ptr<const LifeModel> model = life_model(results_.study);
    if (!model) return {};
    const auto life = std::make_shared<StudyLife>();
    for (int s = 0; s < problem.scenes(); ++s) {
      const auto at = static_cast<std::size_t>(s);
      const DesignScene& scene = problem.task().scenes[at];
      LoadedResult loaded;
      loaded.torque = scene.torque;
      loaded.operation = scene.operation;
      loaded.cycle = analysis.cycles[at];
      loaded.resolved = cycles[at];
      loaded.summary = cycles[at].summary;
      life->cases.push_back(case_life(problem.model(s), *model, loaded, nullptr));
      life->cases.back().loaded = at;
    }
    return [life](const ObjectiveTerm& term, int scene) { return life_error(*life, static_cast<std::size_t>(scene), term.output); };
  }

  /// What is to be ground is the design over the draws; the listed scenes show it.
  void choose_over_draws(const DesignProblem& problem) {
    const auto load_cases = [&](const std::vector<Scene>& scenes) { return run_.loaded(scenes); };
    ScatterResult scatter = run_scatter(results_.study, found_.task, found_.design, load_cases, run_.progress());
    results_.steps.push_back({"scatter", "search over drawn gears and assemblies", scatter.design.seconds});
    const auto add = [this](const char* name, const char* why, double seconds) {
      if (seconds > 0.0) results_.steps.push_back({name, why, seconds});
    };
    add("prediction", "statistics from draws that the search has not seen", scatter.prediction_seconds);
    add("fresh_draws", "the designs on further draws", scatter.fresh_seconds);
    if (!scatter.classes.empty()) add("tolerance_classes", "the right design of each class", scatter.classes_seconds);
    found_.design.after = report_design(problem, problem.analyse_design(scatter.design.modification));
    found_.design.exact.reset();  // of the search over the listed scenes
    found_.design.choices = scatter.design.choices;
    found_.scatter = std::move(scatter);
  }

  void add_unmet_over_draws() {
    const ScatterDesign& design = found_.scatter->design;
    for (std::string& exceeded : limits_exceeded_over_draws(*found_.scatter, found_.task, results_.study.table<OptimiseTable>().scatter.statistic))
      results_.requirements.push_back(std::move(exceeded));
    if (design.status == SolverStatus::Converged || design.status == SolverStatus::Stalled) return;
    results_.requirements.push_back(fmt::format("the search over the draws ended early ({}): {}", to_string(design.status), design.message));
  }

  /// Where the distribution over draws rises steeply, as where tip edges begin to touch, the search may have ended on the wrong side of the step.
  void note_steep_statistic() {
    constexpr double steep = 0.1;  // width of the interval over the statistic: that of smooth distributions is a few per cent
    const PredictedStatistic& predicted = found_.scatter->predicted;
    if (!(predicted.high - predicted.low > steep * predicted.value)) return;
    results_.notes.push_back(fmt::format(
        "the statistic of the design found lies where its distribution rises steeply, between {:.4g} and {:.4g}{}: more of optimise.scatter.draws or "
        "another optimise.scatter.seed may find a better design",
        predicted.low, predicted.high, behind_number(found_.task.objective_unit())));
  }

  void add_what_the_front_lacks() {
    const ParetoFront& front = *found_.front;
    if (!front.message.empty()) (front.ended_early ? results_.requirements : results_.notes).push_back(front.message);
  }

  /// Said before the search, which may take long and find that the constraints cannot be kept.
  void announce_violations_of_start(const DesignProblem& problem) const {
    const OptimiseTable& asked = results_.study.table<OptimiseTable>();
    if (asked.constraints.empty() && asked.modification_constraints.empty()) return;
    const DesignAnalysis start = problem.analyse_given();
    if (!start.usable()) return;
    for (const std::string& violated : violated_constraints(problem, asked, report_design(problem, start))) {
      spdlog::info("the search starts outside the constraints: {}", violated);
    }
  }

  /// The excess of the design as it is shown, with what lies between the positions, in place of that at the positions.
  void state_shown_excess() {
    double& excess = found_.assessment.relaxation->excess;
    if (const double shown = search_.excess_of(found_.design.after); shown > 0.0) excess = shown;  // else a limit of a list of objectives is exceeded
    found_.design.message = message_of_excess(excess);
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
    const auto cycles_from = [&](std::size_t begin) {
      std::vector<ResolvedCycle> cycles;
      for (int s = 0; s < problem.scenes(); ++s) cycles.push_back(results_.loaded[begin + static_cast<std::size_t>(s)].resolved);
      return cycles;
    };
    const auto life_errors_from = [&](std::size_t begin) -> FurtherError {
      return [&, begin](const ObjectiveTerm& term, int scene) {
        return results_.life ? life_error(*results_.life, begin + static_cast<std::size_t>(scene), term.output) : not_given;
      };
    };
    const std::size_t after = first + static_cast<std::size_t>(problem.scenes());
    found_.before_errors = resolve_report(problem, cycles_from(first), found_.design.before, life_errors_from(first));
    found_.after_errors = resolve_report(problem, cycles_from(after), found_.design.after, life_errors_from(after));
    if (found_.front) show_in_front(problem, cycles_from(after), life_errors_from(after));
    if (found_.design.exact) resolve_report(problem, search_.resolved_cycles(problem, found_.design.exact->analysis, false), *found_.design.exact);
  }

  /// The design found, where it is a point of the front, has the values and errors of its load cases there too.
  void show_in_front(const DesignProblem& problem, const std::vector<ResolvedCycle>& cycles, const FurtherError& further_error) {
    const Eigen::VectorXd x = problem.nearest_design(found_.design.after.variables);
    for (ParetoPoint& point : found_.front->points) {
      if (point.x != x || point.errors.empty()) continue;
      const std::vector<ResolvedValue> shown =
          resolved_values(problem, found_.front->objectives, found_.design.after.analysis, cycles, further_error);
      for (std::size_t k = 0; k < shown.size(); ++k) {
        point.values[k] = shown[k].value;
        point.errors[k] = shown[k].error;
      }
    }
  }

  void add_load_cases(const DesignProblem& problem, const std::string& name, const DesignAnalysis& analysis) {
    std::vector<DesignScene> scenes;
    for (int s = 0; s < problem.scenes(); ++s) scenes.push_back(search_.scene_of(analysis, s));
    run_.add_loaded(scenes, name, analysis.cycles);
  }

  StudyRun& run_;
  StudyResults& results_;
  OptimiseResults& found_;
  OptimiseSearch search_;
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
