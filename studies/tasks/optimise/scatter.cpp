#include "studies/tasks/optimise/scatter.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"
#include "studies/tasks/optimise/drawn_scenes.hpp"
#include "studies/tasks/optimise/scatter_reading.hpp"

namespace flankwright::studies {

namespace {

/// The task over draws: its objective and its constraints on outputs by the statistic.
DesignTask over_draws(DesignTask task, std::vector<DesignScene> draws, const Aggregation& statistic) {
  task.scenes = std::move(draws);
  task.over = statistic;
  for (const OutputConstraint& bound : task.constraints) {
    task.objective_bounds.push_back({{{bound.output}, statistic}, bound.maximum * bound.output.outside_factor()});
  }
  task.constraints.clear();
  return task;
}

std::vector<DesignScene> draw(const Study& study, const std::vector<SceneTolerance>& tolerances, int draws, unsigned long seed,
                              const LoadCases& load_cases) {
  return load_cases(draw_scenes(study, tolerances, {.samples = draws, .seed = seed}));
}

double statistic_of(const std::vector<double>& measures, const Aggregation& statistic) {
  std::vector<double> known;
  std::ranges::copy_if(measures, std::back_inserter(known), [](double m) { return !std::isnan(m); });
  return known.empty() ? not_given : aggregate(statistic, known, std::vector<double>(known.size(), 1.0));
}

class ScatterRun {
 public:
  ScatterRun(const Study& study, const DesignTask& task, const LoadCases& load_cases, const ProgressReport& progress)
      : study_(study), asked_(study.optimise.scatter), task_(task), load_cases_(load_cases), progress_(progress) {}

  ScatterResult run(const DesignResult& found) {
    ScatterResult result;
    result.search_seconds = found.seconds;
    result.without = found.after.variables;
    const std::vector<SceneTolerance>& tolerances = study_.optimise.assessment.tolerances;
    report("searching over " + std::to_string(asked_.draws) + " draws");
    result.draws = draw(study_, tolerances, asked_.draws, asked_.seed, load_cases_);
    const DesignTask over = over_draws(task_, result.draws, asked_.statistic);
    result.design = search_over_draws(over, (found.exact ? *found.exact : found.after).variables, study_.optimise.solver);
    predict(result);
    result.without_value = statistic_over(over, found.after.analysis.modification, over.combined_objective());
    try_afresh(found, result);
    price_classes(found, result);
    return result;
  }

 private:
  void report(const std::string& label) const {
    if (progress_) progress_(label, 0, 1, "");
  }

  static double statistic_over(const DesignTask& task, const PerGear<Modification>& modification, const Objective& objective) {
    const DesignProblem problem(task);
    return problem.value(objective, problem.analyse_design(modification));
  }

  void predict(ScatterResult& result) const {
    if (asked_.predicted_from == 0 || result.design.status == SolverStatus::Failed) return;
    report("predicting from " + std::to_string(asked_.predicted_from) + " further draws");
    const auto scenes = draw(study_, study_.optimise.assessment.tolerances, asked_.predicted_from, asked_.predicted_seed, load_cases_);
    result.predicted = predict_statistic(over_draws(task_, scenes, asked_.statistic), asked_.predicted_from, result.design.modification);
  }

  void try_afresh(const DesignResult& found, ScatterResult& result) const {
    if (asked_.fresh == 0) return;
    const Stopwatch clock;
    report("trying the designs on " + std::to_string(asked_.fresh) + " fresh draws");
    const auto scenes = draw(study_, study_.optimise.assessment.tolerances, asked_.fresh, asked_.fresh_seed, load_cases_);
    const std::vector<NamedDesign> designs{{"before", "", found.before.analysis.modification},
                                           {"without scatter", "", found.after.analysis.modification},
                                           {"after", "", result.design.modification}};
    for (ValidatedDesign& design : validate_designs(task_, scenes, designs)) {
      const double statistic = statistic_of(design.measures, asked_.statistic);
      result.fresh.push_back({std::move(design), statistic});
    }
    result.fresh_seconds = clock.seconds();
  }

  /// Each class from the design of the one before: neighbours are near.
  void price_classes(const DesignResult& found, ScatterResult& result) const {
    const Stopwatch clock;
    std::vector<double> start = result.without;
    for (const int tolerance_class : asked_.classes) {
      report("searching the right design of class " + std::to_string(tolerance_class));
      const auto tolerances = with_class(study_.optimise.assessment.tolerances, task_.pair, tolerance_class);
      const DesignTask over = over_draws(task_, draw(study_, tolerances, asked_.draws, asked_.seed, load_cases_), asked_.statistic);
      ClassDesign priced{.tolerance_class = tolerance_class, .design = search_over_draws(over, start, study_.optimise.solver)};
      const DesignProblem problem(over);
      priced.without_scatter = problem.objective(problem.analyse_design(found.after.analysis.modification));
      const DesignAnalysis analysis = problem.analyse_design(priced.design.modification);
      priced.contact_stress = problem.value({{*find_term("peak_contact_stress")}, asked_.statistic}, analysis);
      priced.te = problem.value({{*find_term("te_peak_to_peak")}, asked_.statistic}, analysis);
      for (std::size_t i = 0; i < start.size(); ++i) start[i] = task_.variables[i].unscaled(priced.design.x[static_cast<Eigen::Index>(i)]);
      result.classes.push_back(std::move(priced));
    }
    result.classes_seconds = clock.seconds();
  }

  const Study& study_;
  const ScatterTable& asked_;
  const DesignTask& task_;
  const LoadCases& load_cases_;
  const ProgressReport& progress_;
};

}  // namespace

ScatterResult run_scatter(const Study& study, const DesignTask& task, const DesignResult& found, const LoadCases& load_cases,
                          const ProgressReport& progress) {
  return ScatterRun(study, task, load_cases, progress).run(found);
}

}  // namespace flankwright::studies
