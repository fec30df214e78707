#pragma once

#include "optimize/solvers/recorder.hpp"
#include "optimize/solvers/solver_options.hpp"

namespace flankwright {

/// Runs the NLopt algorithm that options.name ("nlopt:NAME") asks for [Johnson, The NLopt nonlinear-optimization
/// package].
///
/// Stops when no variable moves by more than tolerance times its range, slsqp within a line search too; crs2_lm and isres when as many points in a row
/// as their population has lie that near to the best; esch, direct_l and mlsl at a limit only. Derivative-free methods
/// start with steps of a tenth of the range (of max(1, |start|) where a bound is infinite). mlsl starts L-BFGS runs
/// from random points. mma and ccsaq can stop short after an infeasible start, so they are started again from the best
/// point until that gains no more than tolerance * max(1, |objective|); they suit few constraints, slsqp and Ipopt take
/// hundreds.
///
/// NLopt has no way to learn that a point cannot be evaluated. Instead it gets, for the objective, the worst value met
/// plus the spread of the values met (at least 1), with the gradient of a straight rise from the best usable point to
/// there; and for the constraints those of that best point, or, for a derivative-free method, the largest violation met
/// and at least 1 in each: a line search or trust region shrinks, a population drops the point.
SolverEnding solve_with_nlopt(Recorder& recorder, const SolverOptions& options);

}  // namespace flankwright
