#include "core/compliance/shaft/bearing_clearance.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace flankwright {

namespace {

/// The nearest points within the clearances.
Eigen::VectorXd within(Eigen::VectorXd shift, const Eigen::VectorXd& clearance) {
  for (Eigen::Index i = 0; i < clearance.size(); ++i) {
    const double size = shift.segment<2>(2 * i).norm();
    if (size > clearance[i]) shift.segment<2>(2 * i) *= clearance[i] / size;
  }
  return shift;
}

/// The derivative of within().
Eigen::MatrixXd slope_of_within(const Eigen::VectorXd& shift, const Eigen::VectorXd& clearance) {
  Eigen::MatrixXd slope = Eigen::MatrixXd::Identity(shift.size(), shift.size());
  for (Eigen::Index i = 0; i < clearance.size(); ++i) {
    const Eigen::Vector2d at = shift.segment<2>(2 * i);
    const double size = at.norm();
    if (size <= clearance[i]) continue;
    const Eigen::Vector2d outwards = at / size;
    slope.block<2, 2>(2 * i, 2 * i) = clearance[i] / size * (Eigen::Matrix2d::Identity() - outwards * outwards.transpose());
  }
  return slope;
}

}  // namespace

ClearanceState solve_clearances(const Eigen::VectorXd& forces, const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& clearance) {
  const double largest = clearance.maxCoeff();
  ClearanceState state;
  state.shift = Eigen::VectorXd::Zero(forces.size());
  for (Eigen::Index i = 0; i < clearance.size(); ++i) {
    const Eigen::Vector2d force = forces.segment<2>(2 * i);
    if (force.norm() > 0.0) state.shift.segment<2>(2 * i) = clearance[i] / force.norm() * force;
  }
  // Below 2 over the largest eigenvalue, as projected gradients need; where shifts change no force, of the size of the clearances over the forces.
  const double scale = stiffness.cwiseAbs().rowwise().sum().maxCoeff() + forces.cwiseAbs().maxCoeff() / largest;
  const double gamma = scale > 0.0 ? 1.0 / scale : 1.0;
  const auto pushed = [&](const Eigen::VectorXd& shift) -> Eigen::VectorXd { return shift + gamma * (forces - stiffness * shift); };
  const auto residual = [&](const Eigen::VectorXd& shift) -> Eigen::VectorXd { return shift - within(pushed(shift), clearance); };
  constexpr int most_iterations = 200, gradients_a_step = 200;
  Eigen::VectorXd left = residual(state.shift);
  for (state.iterations = 0; state.iterations < most_iterations; ++state.iterations) {
    state.residual = left.cwiseAbs().maxCoeff() / largest;
    if (state.residual <= clearance_residual) break;
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(left.size(), left.size());
    const Eigen::MatrixXd slope = unit - slope_of_within(pushed(state.shift), clearance) * (unit - gamma * stiffness);
    const Eigen::VectorXd step = slope.completeOrthogonalDecomposition().solve(left);
    const Eigen::VectorXd next = state.shift - step, next_left = residual(next);
    if (next_left.norm() < 0.5 * left.norm()) {
      state.shift = next;
    } else {
      for (int k = 0; k < gradients_a_step; ++k) state.shift = within(pushed(state.shift), clearance);
    }
    left = residual(state.shift);
  }
  state.converged = state.residual <= clearance_residual;
  state.shift = within(state.shift, clearance);
  state.force = forces - stiffness * state.shift;
  for (Eigen::Index i = 0; i < clearance.size(); ++i) {
    // A shaft that touches carries where the push of its force reaches beyond the border by more than the iteration leaves open.
    const double beyond = pushed(state.shift).segment<2>(2 * i).norm() - clearance[i];
    state.carries.push_back(beyond > 10.0 * clearance_residual * largest);
    if (!state.carries.back()) state.force.segment<2>(2 * i).setZero();
  }
  return state;
}

}  // namespace flankwright
