#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "optimize/design/design_problem.hpp"
#include "optimize/solvers/solver_options.hpp"

namespace flankwright {

/// Outcome of search_over_draws().
struct ScatterDesign {
  SolverStatus status{SolverStatus::NotRun};
  std::string message{"search_over_draws() was not called"};
  Eigen::VectorXd x;  ///< scaled; on the variables' steps where they have any
  PerGear<Modification> modification;
  double start_value{not_given};  ///< statistic of the start over the draws, outside units
  double exact_value{not_given};  ///< of the best design before it was rounded; NaN without steps
  double value{not_given};        ///< of `x`
  double violation{not_given};    ///< DesignProblem::violation() of `x` over all draws [-]
  std::vector<double> measures;   ///< per draw, of `x`, outside units
  std::vector<double> weights;    ///< d(value)/d(measure): which draws the statistic hangs on
  std::vector<double> bounds;     ///< value of every objective bound, outside units
  int turns{0};                   ///< searches over some of the draws, each followed by an analysis of all
  std::size_t searched{0};        ///< draws in the last of them
  std::int64_t cycles{0};         ///< mesh cycles analysed
  double seconds{not_given};
};

/// Chooses the design whose statistic over drawn scenes is least, with the same draws for every design (common random numbers): the objective is
/// then an ordinary function of the design with exact gradients, and the same draws give the same design.
///
/// - quantile, cvar: only the worst draws count. The search is the epigraph over the worst three times 1 - level of the weight, with a level that makes
///   the statistic the same as long as no other draw rises among them. All draws are analysed at its optimum; those that have risen join, until none
///   matters.
/// - mean, mean + k sigma: all draws count. The statistic of the true peaks, with the gradient of each draw's leading candidate, is one function of the
///   variables: kinks of single draws have 1/n of the weight.
///
/// Searched with few points first, then with the task's own (coarser()), then rounded to the steps.
///
/// @param task     scenes are the draws; constraints on outputs are objective bounds with the statistic, and task.constraints is empty
/// @param start    a design to begin with, such as the optimum without scatter, in the order of the variables [mm; parabolic_te 1/rad]
/// @param options  max_evaluations counts analyses, of however many draws
/// @throws InvalidInput as DesignProblem
ScatterDesign search_over_draws(const DesignTask& task, const std::vector<double>& start, const SolverOptions& options);

}  // namespace flankwright
