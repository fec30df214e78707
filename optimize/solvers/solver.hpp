#pragma once

#include "optimize/solvers/nonlinear_program.hpp"
#include "optimize/solvers/solver_options.hpp"

namespace flankwright {

/// Solves a programme with the solver of options.name. Same input, same bits (unless the time limit cuts the run).
///
/// The start is always evaluated first, so the result is never worse than it. Throws InvalidInput for an unknown name,
/// for a solver that cannot take the programme (an unconstrained method with constraints, a global one without finite
/// bounds), and for bounds or a start that contradict each other; everything else is a status.
SolverResult solve(NonlinearProgram& program, const SolverOptions& options);

}  // namespace flankwright
