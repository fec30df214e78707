#pragma once

#include "optimize/solvers/recorder.hpp"
#include "optimize/solvers/solver_options.hpp"

namespace flankwright {

/// Runs Ipopt: a primal-dual interior-point method with a filter line search [Wächter & Biegler 2006], its Hessian from
/// limited-memory BFGS updates, its linear systems from MUMPS.
///
/// Strictly inside the bounds: they are neither relaxed nor left. A point that cannot be evaluated makes the line
/// search step back. Returns multipliers when it converged. Calls from several threads are safe: Ipopt's own work takes
/// turns (MUMPS keeps global state), evaluations of the programmes run side by side.
SolverEnding solve_with_ipopt(Recorder& recorder, const SolverOptions& options);

}  // namespace flankwright
