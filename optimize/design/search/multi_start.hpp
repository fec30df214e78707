#pragma once

#include "optimize/design/search/local_run.hpp"

namespace flankwright {

/// Space-filling starts of a scaled design: `first`, then the Halton sequence in the unit cube, shifted as a whole by numbers that the
/// seed draws [Cranley, Patterson, SIAM J. Numer. Anal. 13 (1976)].
std::vector<Eigen::VectorXd> space_filling_starts(const Eigen::VectorXd& first, int count, unsigned long seed);

/// Parallel runs from several starts, at least one, each with an equal part of options.max_evaluations and its own seed. The result does not depend on the
/// number of threads.
std::vector<LocalRun> run_from(const DesignProblem& problem, const SolverOptions& options, const std::vector<Eigen::VectorXd>& starts);
/// The same from space_filling_starts(), the first of which is where the problem starts.
/// @param count  >= 1
std::vector<LocalRun> run_from_starts(const DesignProblem& problem, const SolverOptions& options, int count);

/// A design that some of the starts found.
struct LocalOptimum {
  std::size_t run{0};  ///< the best of the runs that ended here
  int found_by{0};     ///< how many did
};

/// The different optima of runs that ended well and feasible, best first. Two are the same where objectives differ by at most
/// `same_objective` (relative); of equal objectives a minimax optimum is often flat.
std::vector<LocalOptimum> distinct_optima(const std::vector<LocalRun>& runs, double same_objective);

/// The run to go on with: feasible with the least objective, else the least violation.
std::size_t best_run(const std::vector<LocalRun>& runs);

}  // namespace flankwright
