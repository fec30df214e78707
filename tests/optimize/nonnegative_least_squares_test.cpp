#include "optimize/solvers/nonnegative_least_squares.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace flankwright;

TEST_CASE("Non-negative least squares satisfies its optimality conditions", "[optimize]") {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  for (int run = 0; run < 200; ++run) {
    const Eigen::Index m = 1 + run % 9, n = 1 + run % 13;
    Eigen::MatrixXd A(m, n);
    Eigen::VectorXd b(m);
    for (double& a : A.reshaped()) a = normal(generator);
    for (double& v : b) v = normal(generator);
    if (n > 2) A.col(2) = A.col(0);  // columns that depend on each other
    const Eigen::VectorXd y = nonnegative_least_squares(A, b);
    const Eigen::VectorXd slope = A.transpose() * (A * y - b);
    constexpr double round_off = 1e-9;
    CHECK(y.minCoeff() >= 0.0);
    CHECK(slope.minCoeff() >= -round_off);
    CHECK((y.array() * slope.array()).abs().maxCoeff() <= round_off);
  }
}

TEST_CASE("A pull is a diagonal below the matrix", "[optimize]") {
  std::mt19937 generator(6);
  std::normal_distribution<double> normal;
  for (int run = 0; run < 60; ++run) {
    const bool many = run >= 50;  // columns, which enter and leave by the dozen
    const Eigen::Index m = many ? 20 : 1 + run % 4, n = many ? 150 : 2 + run % 11;
    Eigen::MatrixXd A(m, n);
    Eigen::VectorXd b(m), pull(n);
    for (double& a : A.reshaped()) a = normal(generator);
    for (double& v : b) v = normal(generator);
    for (double& s : pull) s = std::abs(normal(generator)) + 0.1;  // with each above 0 the minimiser is unique
    Eigen::MatrixXd below = Eigen::MatrixXd::Zero(m + n, n);
    below.topRows(m) = A;
    below.bottomRows(n).diagonal() = pull;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(m + n);
    right.head(m) = b;
    constexpr double round_off = 1e-9;
    CHECK((nonnegative_least_squares(A, b, pull) - nonnegative_least_squares(below, right)).lpNorm<Eigen::Infinity>() <= round_off);
  }
}

TEST_CASE("Columns that nearly depend on each other do not keep it from the least sum of squares", "[optimize]") {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  for (int run = 0; run < 60; ++run) {
    constexpr Eigen::Index m = 8, kinds = 5, alike = 20;
    const double apart = std::pow(10.0, -10 - run % 5);
    Eigen::MatrixXd one(m, kinds), A(m, kinds * alike);
    Eigen::VectorXd b(m);
    for (double& a : one.reshaped()) a = normal(generator);
    for (double& v : b) v = normal(generator);
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      A.col(j) = one.col(j % kinds);
      for (double& a : A.col(j)) a += apart * normal(generator);
    }
    const Eigen::VectorXd y = nonnegative_least_squares(A, b);
    const double least = (one * nonnegative_least_squares(one, b) - b).norm();
    CAPTURE(run, apart);
    CHECK(y.minCoeff() >= 0.0);
    // Loads of the size of b: their columns are off by `apart` each, and what little they differ by is round-off.
    CHECK((A * y - b).norm() <= least + 1e3 * apart * b.norm());
  }
}
