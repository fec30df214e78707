#pragma once

#include "optimize/design/search/design_log.hpp"
#include "optimize/solvers/solver.hpp"

namespace flankwright {

/// One search from one start.
struct LocalRun {
  SolverStatus status{SolverStatus::NotRun};
  std::string message;
  std::string finished_by;                 ///< the finisher where it went on from a kink, else empty
  bool epigraph{false};                    ///< smooth, exact gradients; else values of the true peaks
  Eigen::VectorXd start, x;                ///< scaled designs: first and best
  double objective{not_given};             ///< at x, outside units
  double constraint_violation{not_given};  ///< at x [-]
  int evaluations{-1};                     ///< designs analysed, in all scenes or in those that decide
  int failures{-1};                        ///< analyses that did not converge; survived
  int rounds{-1};                          ///< of candidate generation (1 without epigraph)
  double seconds{not_given};
  std::vector<SolverStep> history;  ///< one entry per analysis: true objective and violation, by the scenes that were analysed
};

/// Searches from problem.start().
///
/// Solvers with gradients that take constraints get the epigraph form, re-solved from its own optimum until no peak
/// outside its candidates exceeds them by 1e-6 of the objective at the start (by the solver's tolerance where that is
/// larger), or 20 rounds are done. A round ends early where the solver no longer gains, and one that
/// gained nothing is repeated once with more patience, unless no design that keeps the limits was met: that is said at once, as the least excess is
/// searched next (optimise_design()). On a kink
/// options.finisher continues from its best design; `finished_by` and `message` then say so.
/// Other solvers get the direct form.
///
/// Of many scenes the epigraph form has those that decide (single_scenes_decide()). Its optimum is held against all, and where another scene exceeds it,
/// the search goes on from there with that one as well.
///
/// The best design met under the true outputs is returned, wherever the solver
/// stopped.
LocalRun run_local(DesignProblem& problem, const SolverOptions& options);

}  // namespace flankwright
