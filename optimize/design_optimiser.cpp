#include "optimize/design_optimiser.hpp"

#include <chrono>
#include <cmath>

namespace flankwright {

namespace {

constexpr int most_rounds = 20;
constexpr double round_tolerance = 1e-6;  // see optimise_design()

DesignReport report(const DesignProblem& problem, DesignAnalysis analysis) {
  DesignReport report;
  for (const DesignVariable& v : problem.task().variables) {
    report.variables.push_back(
        get(v.member == Member::Pinion ? analysis.pinion_modification : analysis.wheel_modification, v.parameter));
  }
  for (int s = 0; s < problem.scenes(); ++s) report.scene_measures.push_back(problem.scene_measure(analysis, s));
  for (const OutputConstraint& c : problem.task().constraints) {
    report.constraint_values.push_back(problem.constraint_value(analysis, c));
  }
  report.objective = problem.objective(analysis);
  report.analysis = std::move(analysis);
  return report;
}

/// What is left of the budget for the next round.
SolverOptions remaining(const SolverOptions& options, int used, double seconds) {
  SolverOptions left = options;
  left.max_evaluations = std::max(1, options.max_evaluations - used);
  left.max_seconds = std::max(1e-3, options.max_seconds - seconds);
  left.progress = nullptr;  // the design log reports progress
  return left;
}

}  // namespace

DesignResult optimise_design(DesignProblem& problem, const SolverOptions& options) {
  options.validate();
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  DesignResult result;
  result.solver = options.name;
  result.before = report(problem, problem.analyse_given());
  const int analyses_before = problem.analyses();
  const bool gradients = uses_gradients(options.name);
  const bool epigraph = gradients && accepts_constraints(options.name) &&
                        problem.task().over != Aggregate::MeanPlusTwoSigma;
  DesignLog log(options.progress);
  SolverResult solved;
  result.failures = 0;
  if (!epigraph) {
    result.formulation = "direct";
    DirectProgram program(problem, log);
    solved = solve(program, remaining(options, 0, 0.0));
    result.failures = solved.failures;
    result.rounds = 1;
  } else {
    result.formulation = "epigraph";
    EpigraphProgram program(problem, log);
    for (result.rounds = 1; result.rounds <= most_rounds; ++result.rounds) {
      solved = solve(program, remaining(options, problem.analyses() - analyses_before, elapsed()));
      result.failures += solved.failures;
      if (solved.x.size() == 0 || solved.status == SolverStatus::EvaluationLimit || solved.status == SolverStatus::TimeLimit) break;
      const Eigen::VectorXd x = program.design(solved.x);
      const DesignAnalysis& analysis = problem.analyse(x, true);
      log.record(problem, x, analysis);
      // Done when the true peaks are what the candidates promised.
      const double promised = solved.objective * program.objective_scale();
      const bool holds = log.entries().back().objective <= promised * (1.0 + round_tolerance) &&
                         log.entries().back().constraint_violation <= DesignLog::tolerance;
      if (holds || program.add_candidates(x) == 0) break;
      program.restart_from(log.best()->x);
    }
  }
  result.status = solved.status;
  result.message = solved.message;
  result.evaluations = problem.analyses() - analyses_before;
  result.gradient_evaluations = gradients ? result.evaluations : 0;
  for (std::size_t i = 0; i < log.entries().size(); ++i) {
    result.history.push_back({static_cast<int>(i) + 1, log.entries()[i].objective, log.entries()[i].constraint_violation});
  }
  const Eigen::VectorXd best = log.best() ? log.best()->x : problem.start();
  result.after = report(problem, problem.analyse(best, false));
  result.seconds = elapsed();
  return result;
}

}  // namespace flankwright
