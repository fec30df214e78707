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

LoadSensitivity::Derivatives LoadSensitivity::with(const Eigen::MatrixXd& gap, const Eigen::RowVectorXd& force) const {
  const Eigen::MatrixXd receding = weight_.asDiagonal() * gap(loaded_, Eigen::all);
  // response' (a dg) is the force lost at fixed f_t; f_t rises until the force is there again.
  Derivatives derivatives{Eigen::MatrixXd::Zero(size_, gap.cols()), (force + response_.transpose() * receding) / stiffness_};
  derivatives.line_load(loaded_, Eigen::all) = response_ * derivatives.transmission_error - factor_.solve(receding);
  return derivatives;
}

}  // namespace flankwright
