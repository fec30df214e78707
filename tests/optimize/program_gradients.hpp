#pragma once

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "optimize/solvers/nonlinear_program.hpp"

namespace flankwright::design_tasks {

/// Checks a programme's gradients against central differences.
inline void check_gradients(NonlinearProgram& program, const Eigen::VectorXd& x) {
  // Steps of 1e-5 of a range: differences lose 1e-12 / 1e-5 to round-off and step^2 to curvature.
  constexpr double difference_step = 1e-5, discretisation = 1e-6;
  const ProgramValues at = program.evaluate(x, true);
  REQUIRE(at.constraints.size() == program.constraints());
  const int n = program.variables();
  Eigen::VectorXd gradient(n);
  Eigen::MatrixXd jacobian(program.constraints(), n);
  for (int i = 0; i < n; ++i) {
    const Eigen::VectorXd shift = difference_step * Eigen::VectorXd::Unit(n, i);
    const ProgramValues up = program.evaluate(x + shift, false), down = program.evaluate(x - shift, false);
    gradient[i] = (up.objective - down.objective) / (2.0 * difference_step);
    jacobian.col(i) = (up.constraints - down.constraints) / (2.0 * difference_step);
  }
  CAPTURE(at.objective_gradient.transpose(), gradient.transpose());
  CHECK((at.objective_gradient - gradient).cwiseAbs().maxCoeff() <= discretisation * gradient.cwiseAbs().maxCoeff());
  if (program.constraints() == 0) return;
  CHECK((at.constraint_jacobian - jacobian).cwiseAbs().maxCoeff() <= discretisation * jacobian.cwiseAbs().maxCoeff());
}

}  // namespace flankwright::design_tasks
