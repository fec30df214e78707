#pragma once

#include "optimize/design/search/design_log.hpp"
#include "optimize/solvers/nonlinear_program.hpp"

namespace flankwright {

/// The design task in its direct form: objective and bounded outputs of the true peaks, for derivative-free solvers.
/// Its gradients are those of the leading candidate, correct wherever the maximum is smooth.
class DirectProgram : public NonlinearProgram {
 public:
  DirectProgram(DesignProblem& problem, DesignLog& log) : problem_(problem), log_(log) {}
  int variables() const override { return problem_.variables(); }
  int constraints() const override;
  Eigen::VectorXd lower() const override { return problem_.lower(); }
  Eigen::VectorXd upper() const override { return problem_.upper(); }
  Eigen::VectorXd start() const override { return problem_.start(); }
  ProgramValues evaluate(const Eigen::VectorXd& x, bool with_gradients) override;

 private:
  Eigen::VectorXd leading_gradient(const ObjectiveTerm& term, const DesignAnalysis& analysis, int scene) const;
  Eigen::VectorXd aggregate_gradient(const Objective& objective, const DesignAnalysis& analysis) const;
  Eigen::VectorXd objective_gradient(const DesignAnalysis& analysis) const;

  DesignProblem& problem_;
  DesignLog& log_;
};

}  // namespace flankwright
