#pragma once

#include <string>
#include <vector>

#include "optimize/design_problem.hpp"
#include "optimize/design_programs.hpp"
#include "optimize/solver.hpp"

namespace flankwright {

/// One design with what the task asks of it.
struct DesignReport {
  std::vector<double> variables;          ///< value of each design variable [mm]
  double objective{not_given};            ///< outside units (MPa, um, N/mm; weighted sum for a table)
  std::vector<double> scene_measures;     ///< per scene, outside units
  std::vector<double> constraint_values;  ///< per constraint, worst over the scenes, inside units
  DesignAnalysis analysis;
};

/// Outcome of a design run.
struct DesignResult {
  SolverStatus status{SolverStatus::NotRun};
  std::string message{"optimise_design() was not called"};
  std::string solver;
  std::string formulation;       ///< "epigraph" (smooth, exact gradients) or "direct" (values of the true peaks)
  DesignReport before, after;    ///< the task's own modifications as given, and the best design met
  int evaluations{-1};           ///< analyses of the whole scene set
  int gradient_evaluations{-1};  ///< of these, with derivatives
  int failures{-1};              ///< analyses that did not converge; survived
  int rounds{-1};                ///< of candidate generation (1 for "direct")
  double seconds{not_given};
  std::vector<SolverStep> history;  ///< one entry per analysis: true objective and violation
};

/// Chooses the modifications of a task.
///
/// Solvers with gradients that take constraints get the epigraph form, re-solved from its own optimum until no peak outside its
/// candidates exceeds them by 1e-6 (relative) or 20 rounds are done; the others, and mean + 2 sigma, the direct form. The
/// best design met under the true outputs is returned, whatever the solver stopped at.
/// @throws InvalidInput for an unknown solver or one that cannot take the task's constraints
DesignResult optimise_design(DesignProblem& problem, const SolverOptions& options);

}  // namespace flankwright
