#include "core/load/load_problem.hpp"

#include "core/load/load_solver.hpp"

namespace flankwright {

LoadDistribution solve_load_distribution(const LoadProblemView& problem, const LoadOptions& options, const Eigen::VectorXd& start) {
  return LoadSolver().solve(problem, options, start);
}

}  // namespace flankwright
