#include "core/load/sensitivity.hpp"

#include <cassert>

namespace flankwright {

LoadSensitivity::LoadSensitivity(const LoadProblem& problem, const LoadDistribution& distribution)
    : size_(problem.gap.size()) {
  assert(distribution.usable());
  for (Eigen::Index i = 0; i < size_; ++i) {
    if (distribution.line_load[i] > 0.0) loaded_.push_back(i);
  }
  assert(!loaded_.empty());
  weight_ = problem.weight(loaded_);
  Eigen::MatrixXd hessian = weight_.asDiagonal() * problem.influence(loaded_, loaded_) * weight_.asDiagonal();
  if (!problem.laws.empty()) {
    for (std::size_t i = 0; i < loaded_.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      hessian(row, row) +=
          weight_[row] * problem.laws[static_cast<std::size_t>(loaded_[i])].slope(distribution.line_load[loaded_[i]]);
    }
  }
  factor_.compute(hessian);
  response_ = factor_.solve(weight_);
  stiffness_ = weight_.dot(response_);
}

LoadSensitivity::Derivative LoadSensitivity::spread(const Eigen::VectorXd& loads, double f) const {
  Derivative derivative{Eigen::VectorXd::Zero(size_), f};
  derivative.line_load(loaded_) = loads;
  return derivative;
}

LoadSensitivity::Derivative LoadSensitivity::with_gap(const Eigen::VectorXd& gap_derivative) const {
  const Eigen::VectorXd given = gap_derivative(loaded_);
  // response' (a dg) is the change of force at fixed f_t; f_t rises until the force is back.
  const double f = response_.dot(weight_.cwiseProduct(given)) / stiffness_;
  const Eigen::VectorXd right = weight_.cwiseProduct(given);
  return spread(f * response_ - factor_.solve(right), f);
}

LoadSensitivity::Derivative LoadSensitivity::with_force() const {
  return spread(response_ / stiffness_, 1.0 / stiffness_);
}

}  // namespace flankwright
