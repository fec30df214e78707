#pragma once

#include <cmath>

#include "tests/problems/known_problem.hpp"

namespace flankwright::problems {

/// Rosenbrock's valley in [-1.5, 1.5]^2: least at (1, 1), where it is zero.
class Rosenbrock final : public KnownProblem {
 public:
  Rosenbrock()
      : KnownProblem({.name = "Rosenbrock",
                      .lower = vector_of(-1.5, -1.5),
                      .upper = vector_of(1.5, 1.5),
                      .start = vector_of(-1.2, 1.0),
                      .optimum = 0.0,
                      .minimiser = vector_of(1.0, 1.0)}) {}

 private:
  ProgramValues values_at(const Eigen::VectorXd& x, bool with_gradients) override {
    ProgramValues values;
    const double valley = x[1] - x[0] * x[0], slope = 1.0 - x[0];
    values.objective = 100.0 * valley * valley + slope * slope;
    if (with_gradients) {
      values.objective_gradient = vector_of(-400.0 * x[0] * valley - 2.0 * slope, 200.0 * valley);
    }
    return values;
  }
};

/// |x - a|^2 with a outside the unit box in two of four coordinates: by projection, the minimiser is a clipped to the
/// box.
class BoundedSphere final : public KnownProblem {
 public:
  BoundedSphere()
      : KnownProblem({.name = "sphere with active bounds",
                      .lower = Eigen::VectorXd::Zero(4),
                      .upper = Eigen::VectorXd::Ones(4),
                      .start = Eigen::VectorXd::Constant(4, 0.5),
                      .optimum = 0.25 * 0.25 + 0.5 * 0.5,
                      .minimiser = vector_of(0.0, 0.3, 1.0, 0.8)}) {}

 private:
  ProgramValues values_at(const Eigen::VectorXd& x, bool with_gradients) override {
    const Eigen::VectorXd way = x - vector_of(-0.25, 0.3, 1.5, 0.8);
    ProgramValues values;
    values.objective = way.squaredNorm();
    if (with_gradients) values.objective_gradient = 2.0 * way;
    return values;
  }
};

/// Hock & Schittkowski, Test Examples for Nonlinear Programming Codes (1981), problem 71. Its equality |x|^2 = 40 is
/// stated as |x|^2 <= 40: the published multiplier has the sign of that inequality, so the optimum stays.
class HockSchittkowski71 final : public KnownProblem {
 public:
  HockSchittkowski71()
      : KnownProblem({.name = "HS71",
                      .constraints = 2,
                      .lower = Eigen::VectorXd::Constant(4, 1.0),
                      .upper = Eigen::VectorXd::Constant(4, 5.0),
                      .start = vector_of(1.0, 5.0, 5.0, 1.0),
                      .optimum = 17.0140173,
                      .minimiser = vector_of(1.0, 4.7429994, 3.8211503, 1.3794082)}) {}

 private:
  ProgramValues values_at(const Eigen::VectorXd& x, bool with_gradients) override {
    ProgramValues values;
    const double sum = x[0] + x[1] + x[2];
    values.objective = x[0] * x[3] * sum + x[2];
    values.constraints = vector_of(25.0 - x[0] * x[1] * x[2] * x[3], x.squaredNorm() - 40.0);
    if (with_gradients) {
      values.objective_gradient = vector_of(x[3] * (sum + x[0]), x[0] * x[3], x[0] * x[3] + 1.0, x[0] * sum);
      values.constraint_jacobian.resize(2, 4);
      values.constraint_jacobian.row(0) = -vector_of(x[1] * x[2] * x[3], x[0] * x[2] * x[3], x[0] * x[1] * x[3], x[0] * x[1] * x[2]).transpose();
      values.constraint_jacobian.row(1) = 2.0 * x.transpose();
    }
    return values;
  }
};

/// Hock & Schittkowski (1981), problem 100, in the box [-10, 10]^7.
class HockSchittkowski100 final : public KnownProblem {
 public:
  HockSchittkowski100()
      : KnownProblem({.name = "HS100",
                      .constraints = 4,
                      .lower = Eigen::VectorXd::Constant(7, -10.0),
                      .upper = Eigen::VectorXd::Constant(7, 10.0),
                      .start = vector_of(1.0, 2.0, 0.0, 4.0, 0.0, 1.0, 1.0),
                      .optimum = 680.6300573,
                      .minimiser = vector_of(2.330499, 1.951372, -0.4775414, 4.365726, -0.6244870, 1.038131, 1.594227)}) {}

 private:
  ProgramValues values_at(const Eigen::VectorXd& x, bool with_gradients) override {
    const double a = x[0], b = x[1], c = x[2], d = x[3], e = x[4], f = x[5], g = x[6];
    const auto power = [](double base, int exponent) { return std::pow(base, exponent); };
    ProgramValues values;
    values.objective = power(a - 10.0, 2) + 5.0 * power(b - 12.0, 2) + power(c, 4) + 3.0 * power(d - 11.0, 2) + 10.0 * power(e, 6) + 7.0 * f * f +
                       power(g, 4) - 4.0 * f * g - 10.0 * f - 8.0 * g;
    values.constraints =
        vector_of(2.0 * a * a + 3.0 * power(b, 4) + c + 4.0 * d * d + 5.0 * e - 127.0, 7.0 * a + 3.0 * b + 10.0 * c * c + d - e - 282.0,
                  23.0 * a + b * b + 6.0 * f * f - 8.0 * g - 196.0, 4.0 * a * a + b * b - 3.0 * a * b + 2.0 * c * c + 5.0 * f - 11.0 * g);
    if (with_gradients) {
      values.objective_gradient = vector_of(2.0 * (a - 10.0), 10.0 * (b - 12.0), 4.0 * power(c, 3), 6.0 * (d - 11.0), 60.0 * power(e, 5),
                                            14.0 * f - 4.0 * g - 10.0, 4.0 * power(g, 3) - 4.0 * f - 8.0);
      values.constraint_jacobian.resize(4, 7);
      values.constraint_jacobian << 4.0 * a, 12.0 * power(b, 3), 1.0, 8.0 * d, 5.0, 0.0, 0.0,  //
          7.0, 3.0, 20.0 * c, 1.0, -1.0, 0.0, 0.0,                                             //
          23.0, 2.0 * b, 0.0, 0.0, 0.0, 12.0 * f, -8.0,                                        //
          8.0 * a - 3.0 * b, 2.0 * b - 3.0 * a, 4.0 * c, 0.0, 0.0, 5.0, -11.0;
    }
    return values;
  }
};

}  // namespace flankwright::problems
