#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>

#include "optimize/solvers/nonlinear_program.hpp"

namespace flankwright::problems {

/// A programme with a known optimum that counts how often it is asked. One library, run through every solver.
class KnownProblem : public NonlinearProgram {
 public:
  int variables() const override { return static_cast<int>(start_.size()); }
  int constraints() const override { return constraints_; }
  Eigen::VectorXd lower() const override { return lower_; }
  Eigen::VectorXd upper() const override { return upper_; }
  Eigen::VectorXd start() const override { return start_; }

  ProgramValues evaluate(const Eigen::VectorXd& x, bool with_gradients) final {
    ++evaluations;
    if (with_gradients) ++gradient_evaluations;
    if ((x.array() < lower_.array()).any() || (x.array() > upper_.array()).any()) ++outside_bounds;
    return values_at(x, with_gradients);
  }

  const std::string& name() const { return name_; }
  double optimum() const { return optimum_; }                      ///< least objective
  const Eigen::VectorXd& minimiser() const { return minimiser_; }  ///< empty where it is not given

  int evaluations{0};
  int gradient_evaluations{0};
  int outside_bounds{0};  ///< evaluations outside the bounds: none is allowed

 protected:
  struct Statement {
    std::string name;
    int constraints{0};
    Eigen::VectorXd lower, upper, start;
    double optimum{0.0};
    Eigen::VectorXd minimiser;
  };

  explicit KnownProblem(Statement statement)
      : name_(std::move(statement.name)),
        constraints_(statement.constraints),
        lower_(std::move(statement.lower)),
        upper_(std::move(statement.upper)),
        start_(std::move(statement.start)),
        optimum_(statement.optimum),
        minimiser_(std::move(statement.minimiser)) {}

  virtual ProgramValues values_at(const Eigen::VectorXd& x, bool with_gradients) = 0;

 private:
  std::string name_;
  int constraints_;
  Eigen::VectorXd lower_, upper_, start_;
  double optimum_;
  Eigen::VectorXd minimiser_;
};

/// A vector from its entries, in order.
template <typename... Entries>
Eigen::VectorXd vector_of(Entries... entries) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(sizeof...(entries)));
  Eigen::Index i = 0;
  ((v[i++] = entries), ...);
  return v;
}

}  // namespace flankwright::problems
