#include "core/load/solve/sensitivity.hpp"

#include <cassert>

namespace flankwright {

namespace {

std::vector<Eigen::Index> loaded_points(const LoadDistribution& distribution) {
  assert(distribution.usable());
  std::vector<Eigen::Index> loaded;
  for (Eigen::Index i = 0; i < distribution.line_load.size(); ++i) {
    if (distribution.line_load[i] > 0.0) loaded.push_back(i);
  }
  return loaded;
}

Cholesky factor_of(const LoadProblemView& problem, const LoadDistribution& distribution, const std::vector<Eigen::Index>& loaded) {
  Cholesky factor;
  Eigen::MatrixXd& hessian = factor.prepare(std::ssize(loaded));
  const Eigen::VectorXd weight = problem.weight(loaded);
  hessian = weight.asDiagonal() * problem.influence(loaded, loaded) * weight.asDiagonal();
  for (std::size_t i = 0; i < loaded.size() && !problem.laws.empty(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    hessian(row, row) += weight[row] * problem.laws[static_cast<std::size_t>(loaded[i])].slope(distribution.line_load[loaded[i]]);
  }
  factor.factorise();
  return factor;
}

}  // namespace

LoadSensitivity::LoadSensitivity(Eigen::Index size, std::vector<Eigen::Index> loaded, Eigen::VectorXd weight, Cholesky factor)
    : size_(size), loaded_(std::move(loaded)), weight_(std::move(weight)), factor_(std::move(factor)), response_(weight_) {
  assert(!loaded_.empty() && factor_.size() == std::ssize(loaded_) && weight_.size() == factor_.size());
  factor_.solve(response_);
  stiffness_ = weight_.dot(response_);
}

LoadSensitivity::LoadSensitivity(const LoadProblemView& problem, const LoadDistribution& distribution)
    : LoadSensitivity(problem.gap.size(), loaded_points(distribution), problem.weight(loaded_points(distribution)),
                      factor_of(problem, distribution, loaded_points(distribution))) {}

LoadSensitivity::Derivatives LoadSensitivity::with(const Eigen::MatrixXd& gap, const Eigen::RowVectorXd& force) const {
  Eigen::MatrixXd yielding = weight_.asDiagonal() * gap(loaded_, Eigen::all);
  // response' (a dg) is the force lost at fixed f_t; f_t rises until the force is there again.
  Derivatives derivatives{Eigen::MatrixXd::Zero(size_, gap.cols()), (force + response_.transpose() * yielding) / stiffness_};
  factor_.solve(yielding);
  derivatives.line_load(loaded_, Eigen::all) = response_ * derivatives.transmission_error - yielding;
  return derivatives;
}

}  // namespace flankwright
