#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/problems/known_problem.hpp"

namespace flankwright::problems {

/// A steep narrow bowl in [0, 1]^2 that throws where x + y > 1.4, as an analysis does when its contact leaves the
/// flank. The minimiser (0.6, 0.5) is usable, a first gradient step is not.
class ThrowingBowl final : public KnownProblem {
 public:
  explicit ThrowingBowl(Eigen::VectorXd from = vector_of(0.1, 0.2))
      : KnownProblem({.name = "throwing bowl",
                      .lower = Eigen::VectorXd::Zero(2),
                      .upper = Eigen::VectorXd::Ones(2),
                      .start = std::move(from),
                      .optimum = 1.0,
                      .minimiser = vector_of(0.6, 0.5)}) {}

 private:
  ProgramValues values_at(const Eigen::VectorXd& x, bool with_gradients) override {
    if (x.sum() > 1.4) throw std::runtime_error("no contact");
    const double a = x[0] - 0.6, b = x[1] - 0.5;
    ProgramValues values;
    values.objective = 1.0 + 20.0 * a * a + 5.0 * b * b + 4.0 * a * b;
    if (with_gradients) values.objective_gradient = vector_of(40.0 * a + 4.0 * b, 10.0 * b + 4.0 * a);
    return values;
  }
};

/// -sqrt(1 - |x|^2) + x/2 is NaN outside the unit disc, in the box [-1, 1]^2. On the sphere the linear term turns the
/// normal: the minimiser is (-1, 0) / sqrt(5), the least value -sqrt(5) / 2. One constraint, not active there: x + y <=
/// 0.5.
class NanOutsideDisc final : public KnownProblem {
 public:
  explicit NanOutsideDisc(bool constrained)
      : KnownProblem({.name = constrained ? "constrained disc with NaN outside" : "disc with NaN outside",
                      .constraints = constrained ? 1 : 0,
                      .lower = Eigen::VectorXd::Constant(2, -1.0),
                      .upper = Eigen::VectorXd::Ones(2),
                      .start = vector_of(0.55, -0.8),
                      .optimum = -0.5 * std::sqrt(5.0),
                      .minimiser = vector_of(-1.0 / std::sqrt(5.0), 0.0)}) {}

 private:
  ProgramValues values_at(const Eigen::VectorXd& x, bool with_gradients) override {
    const double root = std::sqrt(1.0 - x.squaredNorm());
    ProgramValues values;
    values.objective = 0.5 * x[0] - root;
    if (constraints() > 0) values.constraints = vector_of(x.sum() - 0.5);
    if (with_gradients) {
      values.objective_gradient = x / root;
      values.objective_gradient[0] += 0.5;
      if (constraints() > 0) values.constraint_jacobian = Eigen::MatrixXd::Ones(1, 2);
    }
    return values;
  }
};

/// |x|^2 in the unit box with x + y >= 3: no point is feasible, the least violation is 1, at (1, 1).
class Infeasible final : public KnownProblem {
 public:
  Infeasible()
      : KnownProblem({.name = "infeasible",
                      .constraints = 1,
                      .lower = Eigen::VectorXd::Zero(2),
                      .upper = Eigen::VectorXd::Ones(2),
                      .start = vector_of(0.3, 0.4),
                      .optimum = 2.0,
                      .minimiser = vector_of(1.0, 1.0)}) {}

 private:
  ProgramValues values_at(const Eigen::VectorXd& x, bool with_gradients) override {
    ProgramValues values;
    values.objective = x.squaredNorm();
    values.constraints = vector_of(3.0 - x.sum());
    if (with_gradients) {
      values.objective_gradient = 2.0 * x;
      values.constraint_jacobian = -Eigen::MatrixXd::Ones(1, 2);
    }
    return values;
  }
};

/// Distance from (2, 2) to a regular polygon of 24 tangents of the unit circle, each stated eight times: 192
/// constraints of which eight are active, on the tangent at 45 deg. The foot is (1, 1) / sqrt(2).
class RedundantPolygon final : public KnownProblem {
 public:
  RedundantPolygon()
      : KnownProblem({.name = "redundant polygon",
                      .constraints = kSides * kCopies,
                      .lower = Eigen::VectorXd::Constant(2, -2.0),
                      .upper = Eigen::VectorXd::Constant(2, 2.0),
                      .start = vector_of(-0.5, 0.25),
                      .optimum = std::pow(2.0 * std::numbers::sqrt2 - 1.0, 2),
                      .minimiser = vector_of(0.5 * std::numbers::sqrt2, 0.5 * std::numbers::sqrt2)}) {}

 private:
  static constexpr int kSides = 24, kCopies = 8;

  ProgramValues values_at(const Eigen::VectorXd& x, bool with_gradients) override {
    const Eigen::VectorXd way = x.array() - 2.0;
    Eigen::MatrixXd normals(kSides * kCopies, 2);
    for (int i = 0; i < kSides * kCopies; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i % kSides) / kSides;
      normals.row(i) << std::cos(angle), std::sin(angle);
    }
    ProgramValues values;
    values.objective = way.squaredNorm();
    values.constraints = (normals * x).array() - 1.0;
    if (with_gradients) {
      values.objective_gradient = 2.0 * way;
      values.constraint_jacobian = normals;
    }
    return values;
  }
};

}  // namespace flankwright::problems
