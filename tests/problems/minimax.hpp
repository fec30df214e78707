#pragma once

#include <cmath>
#include <numbers>

#include "tests/problems/known_problem.hpp"

namespace flankwright::problems {

/// Minimax as an epigraph, the form of the worst-scene designs: minimise t subject to f_i(x) - t <= 0, with t the last
/// variable. A derived class fills values and gradients of the f_i.
class Epigraph : public KnownProblem {
 protected:
  using KnownProblem::KnownProblem;

  /// @param f  values, size m;  @param jacobian  m x (n - 1)
  virtual void functions(const Eigen::VectorXd& x, Eigen::VectorXd& f, Eigen::MatrixXd& jacobian) = 0;

 private:
  ProgramValues values_at(const Eigen::VectorXd& xt, bool with_gradients) final {
    const Eigen::Index n = xt.size() - 1;
    Eigen::VectorXd f(constraints());
    Eigen::MatrixXd jacobian(constraints(), n);
    functions(xt.head(n), f, jacobian);
    ProgramValues values;
    values.objective = xt[n];
    values.constraints = f.array() - xt[n];
    if (with_gradients) {
      values.objective_gradient = Eigen::VectorXd::Unit(n + 1, n);
      values.constraint_jacobian.resize(constraints(), n + 1);
      values.constraint_jacobian.leftCols(n) = jacobian;
      values.constraint_jacobian.col(n).setConstant(-1.0);
    }
    return values;
  }
};

/// Charalambous & Bandler, Non-linear minimax optimization as a sequence of least pth optimization, Int. J. Systems
/// Sci. 7 (1976), known as CB2.
class CharalambousBandler2 final : public Epigraph {
 public:
  CharalambousBandler2()
      : Epigraph({.name = "CB2",
                  .constraints = 3,
                  .lower = vector_of(-2.0, -2.0, 0.0),
                  .upper = vector_of(2.0, 2.0, 10.0),
                  .start = vector_of(1.0, -0.1, 6.0),
                  .optimum = 1.9522245,
                  .minimiser = {}}) {}

 private:
  void functions(const Eigen::VectorXd& x, Eigen::VectorXd& f, Eigen::MatrixXd& jacobian) override {
    const double a = x[0], b = x[1], exponential = 2.0 * std::exp(b - a);
    f << a * a + std::pow(b, 4), (2.0 - a) * (2.0 - a) + (2.0 - b) * (2.0 - b), exponential;
    jacobian << 2.0 * a, 4.0 * std::pow(b, 3), -2.0 * (2.0 - a), -2.0 * (2.0 - b), -exponential, exponential;
  }
};

/// Best approximation of s^d by polynomials of lower degree, as a linear programme: minimise t subject to
/// +-(s_k^d - sum_j x_j s_k^j) - t <= 0. Chebyshev: the error is T_d / 2^(d-1), so the optimum is 2^(1-d), provided
/// that the points s_k = cos(pi k / (points - 1)) contain the extremes cos(pi k / d).
class ChebyshevApproximation final : public Epigraph {
 public:
  /// @param degree  d >= 1;  @param intervals  points - 1, a multiple of d
  ChebyshevApproximation(int degree, int intervals)
      : Epigraph({.name = "Chebyshev approximation",
                  .constraints = 2 * (intervals + 1),
                  .lower = with_last(Eigen::VectorXd::Constant(degree, -4.0), 0.0),
                  .upper = with_last(Eigen::VectorXd::Constant(degree, 4.0), 2.0),
                  .start = with_last(Eigen::VectorXd::Zero(degree), 1.5),
                  .optimum = std::pow(2.0, 1 - degree),
                  .minimiser = {}}),
        degree_(degree),
        intervals_(intervals) {}

 private:
  static Eigen::VectorXd with_last(Eigen::VectorXd head, double last) {
    head.conservativeResize(head.size() + 1);
    head[head.size() - 1] = last;
    return head;
  }

  void functions(const Eigen::VectorXd& x, Eigen::VectorXd& f, Eigen::MatrixXd& jacobian) override {
    for (int k = 0; k <= intervals_; ++k) {
      const double s = std::cos(std::numbers::pi * k / intervals_);
      double error = std::pow(s, degree_);
      for (int j = 0; j < degree_; ++j) {
        const double power = std::pow(s, j);
        error -= x[j] * power;
        jacobian(2 * k, j) = -power;
        jacobian(2 * k + 1, j) = power;
      }
      f[2 * k] = error;
      f[2 * k + 1] = -error;
    }
  }

  int degree_, intervals_;
};

}  // namespace flankwright::problems
