#include "studies/tasks/optimise/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/stopwatch.hpp"
#include "optimize/design/search/design_log.hpp"
#include "optimize/design/scatter/draws.hpp"
#include "studies/tasks/optimise/drawn_scenes.hpp"
#include "studies/tasks/optimise/scatter_reading.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

namespace {

/// The task over draws: its objective and its constraints on outputs by the statistic.
DesignTask over_draws(DesignTask task, std::vector<DesignScene> draws, const Aggregation& statistic) {
  task.scenes = std::move(draws);
  task.over = statistic;
  for (const OutputConstraint& bound : task.constraints) task.objective_bounds.push_back(bound_on(bound, statistic));
  task.constraints.clear();
  return task;
}

std::vector<DesignScene> draw(const Study& study, const std::vector<SceneTolerance>& tolerances, int draws, unsigned long seed,
                              const LoadCases& load_cases) {
  return load_cases(draw_scenes(study, tolerances, {.samples = draws, .seed = seed}));
}

/// Whether it is the better design: it can be analysed, it exceeds the limits by less, or its statistic is less.
bool is_better(const ScatterDesign& design, const ScatterDesign& than) {
  if (std::isnan(design.value) || std::isnan(than.value)) return !std::isnan(design.value);
  const double excess = DesignLog::beyond_tolerance(design.violation), than_excess = DesignLog::beyond_tolerance(than.violation);
  return excess != than_excess ? excess < than_excess : design.value < than.value;
}

double statistic_of(const std::vector<double>& measures, const Aggregation& statistic) {
  std::vector<double> known;
  std::ranges::copy_if(measures, std::back_inserter(known), [](double m) { return !std::isnan(m); });
  return known.empty() ? not_given : aggregate(statistic, known, std::vector<double>(known.size(), 1.0));
}

class ScatterRun {
 public:
  ScatterRun(const Study& study, const DesignTask& task, const LoadCases& load_cases, const ProgressReport& progress)
      : study_(study), asked_(study.table<OptimiseTable>().scatter), task_(task), load_cases_(load_cases), progress_(progress) {}

  ScatterResult run(const DesignResult& found) {
    ScatterResult result;
    result.search_seconds = found.seconds;
    result.without = found.after.variables;
    const std::vector<SceneTolerance>& tolerances = study_.tolerances;
    report("searching over " + std::to_string(asked_.draws) + " draws");
    const DesignTask over = over_draws(task_, draw(study_, tolerances, asked_.draws, asked_.seed, load_cases_), asked_.statistic);
    for (const std::vector<int>& load_cases : draws_of(over.scenes, over.combined_objective().over_spectrum())) {
      std::vector<DesignScene>& listed = result.draws.emplace_back();
      for (const int s : load_cases) listed.push_back(over.scenes[static_cast<std::size_t>(s)]);
    }
    result.states = operating_states(study_, tolerances);
    static_cast<PredictedDesign&>(result) =
        with_prediction(search_again(over, (found.exact ? *found.exact : found.after).variables), over, tolerances, result.prediction_seconds);
    result.without_value = statistic_over(over, found.after.analysis.modification);
    if (!std::isnan(result.predicted.value)) {
      result.without_predicted = predict(further_draws(tolerances), found.after.analysis.modification, result.prediction_seconds);
    }
    try_afresh(found, result);
    price_classes(found, result);
    return result;
  }

 private:
  /// The limits of the study for what a design took already.
  SolverOptions left_after(const ScatterDesign& design) const {
    SolverOptions options = study_.table<OptimiseTable>().solver;
    options.max_seconds -= design.seconds;
    options.max_evaluations -= design.steps;
    return options;
  }
  static bool is_spent(const SolverOptions& left) { return !(left.max_seconds > 0.0) || left.max_evaluations < 1; }

  static void add_books(const ScatterDesign& of, ScatterDesign& to) {
    to.seconds += of.seconds;
    to.steps += of.steps;
    to.cycles += of.cycles;
    to.screening_cycles += of.screening_cycles;
  }

  /// A search over draws that begins again at the design found, with a wide box, while that gains more than thousands of draws tell apart: contact on edges may hide better
  /// designs. The screening resolution says whether it does. All searches together keep to the limits of the study.
  ScatterDesign search_again(const DesignTask& over, const std::vector<double>& start) const {
    constexpr int most_searches = 4;
    ScatterDesign best = search_over_draws(over, start, study_.table<OptimiseTable>().solver);
    for (int search = 1; search < most_searches && best.status == SolverStatus::Converged; ++search) {
      const SolverOptions left = left_after(best);
      if (is_spent(left)) break;
      ScatterDesign next = search_over_draws(over, unscaled(best.x, task_), left, ScatterStart::FoundOverTheseDraws);
      const bool gains = is_better(next, best), goes_on = gains && !(next.value > (1.0 - told_apart) * best.value);
      add_books(gains ? best : next, gains ? next : best);
      if (gains) best = std::move(next);
      if (!goes_on) break;
    }
    return best;
  }

  /// A design with its prediction. While that exceeds a limit, the search goes on with the limit lower by as much as its draws show less than the further ones; the design
  /// that exceeds the limits by least is kept.
  /// @param over     the task of its search
  /// @param seconds  what predictions take is added, from 0 where it is NaN
  PredictedDesign with_prediction(ScatterDesign design, const DesignTask& over, const std::vector<SceneTolerance>& tolerances,
                                  double& seconds) const {
    constexpr int most_rounds = 2;
    const std::size_t first = task_.objective_bounds.size();  // bounds of the constraints follow those of earlier objectives
    PredictedDesign best{.design = std::move(design)};
    for (std::size_t c = 0; c < task_.constraints.size(); ++c) best.searched_limits.push_back(over.objective_bounds[first + c].limit);
    if (asked_.predicted_from == 0 || best.design.status == SolverStatus::Failed) return best;
    const DesignTask further = further_draws(tolerances);
    best.predicted_limits = predicted_limits(further, best.design.modification, seconds);
    DesignTask tighter = over;
    for (int round = 0; round < most_rounds && excess(best) > told_apart && best.design.status == SolverStatus::Converged; ++round) {
      const SolverOptions left = left_after(best.design);
      if (is_spent(left)) break;
      report("searching within tighter limits, which further draws exceed");
      PredictedDesign next;
      for (std::size_t c = 0; c < task_.constraints.size(); ++c) {
        double& limit = tighter.objective_bounds[first + c].limit;
        const double asked = over.objective_bounds[first + c].limit, foreseen = best.predicted_limits[c].value;
        if (foreseen > asked) limit = std::min(limit, asked * best.design.bounds[first + c] / foreseen);
        next.searched_limits.push_back(limit);
      }
      next.design = search_over_draws(tighter, unscaled(best.design.x, task_), left);
      judge_by(over, next.design);
      if (next.design.status != SolverStatus::Failed) next.predicted_limits = predicted_limits(further, next.design.modification, seconds);
      const bool gains = next.design.status == SolverStatus::Converged && excess(next) < excess(best);
      add_books(gains ? best.design : next.design, gains ? next.design : best.design);
      if (!gains) break;
      best = std::move(next);
    }
    best.predicted = predict(further, best.design.modification, seconds);
    return best;
  }

  /// A design that does not keep the tighter limits of its search may keep those of the task.
  void judge_by(const DesignTask& over, ScatterDesign& design) const {
    if (design.status != SolverStatus::Infeasible) return;
    design.violation = DesignProblem(task_).violation(design.modification);
    for (std::size_t b = 0; b < design.bounds.size(); ++b)
      design.violation = std::max(design.violation, design.bounds[b] / over.objective_bounds[b].limit - 1.0);
    if (design.violation > DesignLog::tolerance) return;
    design.status = SolverStatus::Converged;
    design.message = "no design keeps limits as tight as further draws ask for; this one is the nearest found";
  }

  /// By how much the prediction exceeds the limits at most, relative [-]; 0 where none is exceeded or nothing is predicted.
  double excess(const PredictedDesign& of) const {
    double most = 0.0;
    for (std::size_t c = 0; c < of.predicted_limits.size(); ++c)
      most = std::max(most, of.predicted_limits[c].value / bound_on(task_.constraints[c], asked_.statistic).limit - 1.0);
    return most;
  }

  void report(const std::string& label) const {
    if (progress_) progress_(label, 0, 1, "");
  }

  /// The statistic of a design over the draws of a task, as a prediction has it: of a quantile or CVaR only the draws that may decide are analysed at the task's
  /// resolution, and draws that cannot be analysed are left out.
  static double statistic_over(const DesignTask& task, const PerGear<Modification>& modification) {
    return predict_statistic(task, modification).value;
  }

  /// The task over draws of a prediction.
  DesignTask further_draws(const std::vector<SceneTolerance>& tolerances) const {
    return over_draws(task_, draw(study_, tolerances, asked_.predicted_from, asked_.predicted_seed, load_cases_), asked_.statistic);
  }

  /// The statistic of the objective of a task.
  /// @param seconds  what it takes is added, from 0 where it is NaN
  PredictedStatistic predict(const DesignTask& further, const PerGear<Modification>& modification, double& seconds) const {
    report("predicting from " + std::to_string(asked_.predicted_from) + " further draws");
    DesignTask unbounded = further;
    unbounded.objective_bounds.clear();
    PredictedStatistic predicted = predict_statistic(unbounded, modification);
    seconds = (std::isnan(seconds) ? 0.0 : seconds) + predicted.seconds;
    return predicted;
  }

  /// The statistics of all constraints on outputs.
  std::vector<PredictedStatistic> predicted_limits(const DesignTask& further, const PerGear<Modification>& modification, double& seconds) const {
    std::vector<PredictedStatistic> limits;
    for (std::size_t c = 0; c < task_.constraints.size(); ++c) {
      DesignTask of_output = further;
      of_output.objective = further.objective_bounds[task_.objective_bounds.size() + c].objective.terms;
      limits.push_back(predict(of_output, modification, seconds));
    }
    return limits;
  }

  void try_afresh(const DesignResult& found, ScatterResult& result) const {
    if (asked_.fresh == 0) return;
    const Stopwatch clock;
    report("trying the designs on " + std::to_string(asked_.fresh) + " fresh draws");
    const auto scenes = draw(study_, study_.tolerances, asked_.fresh, asked_.fresh_seed, load_cases_);
    const std::vector<NamedDesign> designs{{"before", "", found.before.analysis.modification},
                                           {"without scatter", "", found.after.analysis.modification},
                                           {"after", "", result.design.modification}};
    for (ValidatedDesign& design : validate_designs(task_, scenes, designs)) {
      const double statistic = statistic_of(design.measures, asked_.statistic);
      result.fresh.push_back({std::move(design), statistic});
    }
    result.fresh_seconds = clock.seconds();
  }

  /// The search of a class begins where the study's own does, and again at the design that the study's own found; the better of both is the design of the class.
  /// So a class has the same design whatever the others of the list are, and the study's own class has that of the study.
  ScatterDesign search_class(const DesignTask& over, const DesignResult& found, const ScatterResult& result) const {
    ScatterDesign first = search_over_draws(over, (found.exact ? *found.exact : found.after).variables, study_.table<OptimiseTable>().solver);
    ScatterDesign second = search_over_draws(over, unscaled(result.design.x, task_), study_.table<OptimiseTable>().solver);
    return is_better(second, first) ? second : first;
  }

  void price_classes(const DesignResult& found, ScatterResult& result) const {
    const Stopwatch clock;
    for (const int tolerance_class : asked_.classes) {
      report("searching the right design of class " + std::to_string(tolerance_class));
      const bool is_own = study_.tolerance_class == tolerance_class;
      const auto tolerances = with_class(study_.tolerances, task_.pair, tolerance_class);
      const DesignTask over = over_draws(task_, draw(study_, tolerances, asked_.draws, asked_.seed, load_cases_), asked_.statistic);
      PredictedDesign design = is_own ? result : with_prediction(search_class(over, found, result), over, tolerances, result.prediction_seconds);
      ClassDesign priced{std::move(design), tolerance_class};
      // Of what is searched for a prediction knows more than the draws of the search.
      const DesignTask judged = std::isnan(priced.predicted.value) ? over : further_draws(tolerances);
      priced.without_scatter = statistic_over(judged, found.after.analysis.modification);
      add_outputs(judged, priced);
      result.classes.push_back(std::move(priced));
    }
    result.classes_seconds = clock.seconds();
  }

  /// What else a class costs.
  /// @param judged  the task over the draws that the statistics are from
  void add_outputs(const DesignTask& judged, ClassDesign& priced) const {
    if (priced.design.status == SolverStatus::Failed) return;
    const auto statistic = [&](Output output, const char* name) {
      if (is_objective(task_, output)) return priced.statistic();
      DesignTask of_output = judged;
      of_output.objective = {*find_term(name)};
      of_output.objective_bounds.clear();
      return statistic_over(of_output, priced.design.modification);
    };
    priced.contact_stress = statistic(Output::PeakContactStress, "peak_contact_stress");
    priced.te = statistic(Output::TePeakToPeak, "te_peak_to_peak");
  }

  const Study& study_;
  const ScatterTable& asked_;
  const DesignTask& task_;
  const LoadCases& load_cases_;
  const ProgressReport& progress_;
};

}  // namespace

bool is_objective(const DesignTask& task, Output output) {
  return task.objective.size() == 1 && task.objective.front().output == output && task.objective.front().weight == 1.0;
}

std::vector<double> unscaled(const Eigen::VectorXd& x, const DesignTask& task) {
  std::vector<double> values;
  for (std::size_t i = 0; i < task.variables.size(); ++i) values.push_back(task.variables[i].unscaled(x[static_cast<Eigen::Index>(i)]));
  return values;
}

ScatterResult run_scatter(const Study& study, const DesignTask& task, const DesignResult& found, const LoadCases& load_cases,
                          const ProgressReport& progress) {
  return ScatterRun(study, task, load_cases, progress).run(found);
}

}  // namespace flankwright::studies
