#include "studies/tasks/optimise/scatter.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"
#include "optimize/design/search/design_log.hpp"
#include "optimize/design/scatter/draws.hpp"
#include "studies/tasks/optimise/drawn_scenes.hpp"
#include "studies/tasks/optimise/scatter_reading.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

namespace {

/// A constraint on an output over draws: its statistic is bounded. For a lower limit this is the statistic of the reciprocal, which is large where the output is too small.
ObjectiveBound bound_over_draws(const OutputConstraint& bound, const Aggregation& statistic) {
  ObjectiveTerm output = bound.output;
  output.reciprocal = bound.is_least();
  return {{{output}, statistic}, (bound.is_least() ? 1.0 / bound.minimum : bound.maximum) * output.outside_factor()};
}

/// The task over draws: its objective and its constraints on outputs by the statistic.
DesignTask over_draws(DesignTask task, std::vector<DesignScene> draws, const Aggregation& statistic) {
  task.scenes = std::move(draws);
  task.over = statistic;
  for (const OutputConstraint& bound : task.constraints) task.objective_bounds.push_back(bound_over_draws(bound, statistic));
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
  const auto excess = [](const ScatterDesign& of) { return of.violation > DesignLog::tolerance ? of.violation : 0.0; };
  return excess(design) != excess(than) ? excess(design) < excess(than) : design.value < than.value;
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
    result.design = search_again(over, (found.exact ? *found.exact : found.after).variables);
    predict(result);
    result.without_value = statistic_over(over, found.after.analysis.modification);
    try_afresh(found, result);
    price_classes(found, result);
    return result;
  }

 private:
  /// A search over draws that begins again at the design found, with a wide box, while that gains more than thousands of draws tell apart: contact on edges may hide better
  /// designs. All searches together keep to the limits of the study.
  ScatterDesign search_again(const DesignTask& over, const std::vector<double>& start) const {
    constexpr double worth_it = 2.5e-3;
    constexpr int most_searches = 4;
    SolverOptions options = study_.table<OptimiseTable>().solver;
    ScatterDesign best = search_over_draws(over, start, options);
    for (int search = 1; search < most_searches && best.status == SolverStatus::Converged; ++search) {
      options.max_seconds = study_.table<OptimiseTable>().solver.max_seconds - best.seconds;
      options.max_evaluations = study_.table<OptimiseTable>().solver.max_evaluations - best.steps;
      if (!(options.max_seconds > 0.0) || options.max_evaluations < 1) break;
      ScatterDesign next = search_over_draws(over, unscaled(best.x, task_), options);
      const bool gains = is_better(next, best), goes_on = gains && !(next.value > (1.0 - worth_it) * best.value);
      ScatterDesign& other = gains ? best : next;
      ScatterDesign& taken = gains ? next : best;
      taken.seconds += other.seconds;
      taken.steps += other.steps;
      taken.cycles += other.cycles;
      taken.screening_cycles += other.screening_cycles;
      if (gains) best = std::move(next);
      if (!goes_on) break;
    }
    return best;
  }
  void report(const std::string& label) const {
    if (progress_) progress_(label, 0, 1, "");
  }

  /// The statistic of a design over the draws of a task, as a prediction has it: of a quantile or CVaR only the draws that may decide are analysed at the task's
  /// resolution, and draws that cannot be analysed are left out.
  static double statistic_over(const DesignTask& task, const PerGear<Modification>& modification) {
    return predict_statistic(task, modification).value;
  }

  void predict(ScatterResult& result) const {
    if (asked_.predicted_from == 0 || result.design.status == SolverStatus::Failed) return;
    report("predicting from " + std::to_string(asked_.predicted_from) + " further draws");
    const auto scenes = draw(study_, study_.tolerances, asked_.predicted_from, asked_.predicted_seed, load_cases_);
    result.predicted = predict_statistic(over_draws(task_, scenes, asked_.statistic), result.design.modification);
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
      ClassDesign priced{.tolerance_class = tolerance_class, .design = is_own ? result.design : search_class(over, found, result)};
      priced.without_scatter = is_own ? result.without_value : statistic_over(over, found.after.analysis.modification);
      add_outputs(over, priced);
      result.classes.push_back(std::move(priced));
    }
    result.classes_seconds = clock.seconds();
  }

  /// What else a class costs. The output that was searched for has the value of the search.
  void add_outputs(const DesignTask& over, ClassDesign& priced) const {
    if (priced.design.status == SolverStatus::Failed) return;
    const bool has_stress = is_objective(task_, Output::PeakContactStress), has_te = is_objective(task_, Output::TePeakToPeak);
    const auto statistic = [&](const char* output) {
      DesignTask of_output = over;
      of_output.objective = {*find_term(output)};
      of_output.objective_bounds.clear();
      return statistic_over(of_output, priced.design.modification);
    };
    priced.contact_stress = has_stress ? priced.design.value : statistic("peak_contact_stress");
    priced.te = has_te ? priced.design.value : statistic("te_peak_to_peak");
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
