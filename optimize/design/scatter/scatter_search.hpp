#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "optimize/design/problem/design_problem.hpp"
#include "optimize/design/grinding/grindable_design.hpp"
#include "optimize/solvers/solver_options.hpp"

namespace flankwright {

/// Outcome of search_over_draws().
struct ScatterDesign {
  SolverStatus status{SolverStatus::NotRun};
  std::string message{"search_over_draws() was not called"};
  Eigen::VectorXd x;  ///< scaled; on the variables' steps where they have any
  PerGear<Modification> modification;
  double exact_value{
      not_given};  ///< statistic of the best design before choices of what to grind and steps, outside units; NaN where there were none
  std::vector<GrindingChoice> choices;  ///< objectives are the statistic over the draws
  double value{not_given};              ///< of `x`, over the draws
  double violation{not_given};          ///< largest excess over a bound of `x` over all draws [-]
  std::vector<double> measures;         ///< per draw, of `x`, outside units; of draws that do not decide those of the screening
  std::vector<double> weights;          ///< d(value)/d(measure): which draws the statistic hangs on
  std::vector<double> bounds;           ///< value of every objective bound, outside units
  int steps{0};                         ///< designs tried
  std::size_t decided_by{0};            ///< draws analysed at the task's own resolution at `x`; the others lie below, as the screening says
  std::int64_t cycles{0};               ///< mesh cycles analysed, screening included
  std::int64_t screening_cycles{0};
  double seconds{not_given};
};

/// Where the design comes from that a search begins with.
enum class ScatterStart { Elsewhere, FoundOverTheseDraws };

/// Chooses the design whose statistic over drawn scenes is least, with the same draws for every design (common random numbers): the objective is
/// then an ordinary function of the design with exact gradients, and the same draws give the same design.
///
/// A sequence of linear programmes in a trust region. At each step the candidates of every draw are continued along their gradients (StatisticModel); the
/// least statistic of that model in a box about the best design (least_of_model()) is the next design. It is judged by analyses of the draws that decide
/// there (screen()); where the statistic falls the others are screened as well, since contact that reaches an edge is not foreseen by the gradients of a
/// draw without it. The design is accepted where the statistic then still falls. The box halves where it falls by less than a quarter of what the model
/// had promised, and doubles where by three quarters.
///
/// The search goes from cheap to dear: over the first 64 draws, then eight times as many, up to all, each by the screening resolution (screening_task()),
/// and then over all by the task's own. A level that is only the start of another over the same or more draws ends where a step gains less than 1 %, the others
/// where the model promises less than a quarter of a per cent. Draws must therefore be in an order of which every beginning is a sample, as those of a Sobol sequence are. Over
/// fewer draws than all a quantile is approached by the CVaR of its level, which leaves no draw out: from there on the draws left out are those that are
/// hard for every design, not those that happened to be bad at the start. Over all draws the quantile is smoothed, StatisticModel::smooth(); `value` is the
/// quantile itself. Last the design is made one that can be ground: settle_amounts(), whose alternatives continue the search
/// over all draws, and the steps.
///
/// @param task     scenes are the load cases of the draws, see draws_of(); constraints on outputs are objective bounds with the statistic, and task.constraints is empty
/// @param start    a design to begin with, such as the optimum without scatter, in the order of the variables [mm; parabolic_te 1/rad]
/// @param options  max_evaluations counts designs tried
/// @param start_is  where the start was found over these draws already, and no design is better than it by more than 1 % by the screening resolution, the search ends there: at
///                  the start, whose `value` is not computed
/// @throws InvalidInput as DesignProblem and settle_amounts()
ScatterDesign search_over_draws(const DesignTask& task, const std::vector<double>& start, const SolverOptions& options,
                                ScatterStart start_is = ScatterStart::Elsewhere);

}  // namespace flankwright
