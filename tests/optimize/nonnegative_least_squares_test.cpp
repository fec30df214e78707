#include "optimize/solvers/nonnegative_least_squares.hpp"

#include <catch2/catch.hpp>

#include "tests/common/random.hpp"

using namespace flankwright;

TEST_CASE("Non-negative least squares satisfies its optimality conditions", "[optimize]") {
  tests::Random32 random(5);
  for (int run = 0; run < 200; ++run) {
    const Eigen::Index m = 1 + run % 9, n = 1 + run % 13;
    Eigen::MatrixXd A = random.normal_matrix(m, n);
    const Eigen::VectorXd b = random.normal_matrix(m, 1);
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
  tests::Random32 random(6);
  for (int run = 0; run < 60; ++run) {
    const bool many = run >= 50;  // columns, which enter and leave by the dozen
    const Eigen::Index m = many ? 20 : 1 + run % 4, n = many ? 150 : 2 + run % 11;
    const Eigen::MatrixXd A = random.normal_matrix(m, n);
    const Eigen::VectorXd b = random.normal_matrix(m, 1);
    const Eigen::VectorXd pull = random.normal_matrix(n, 1).array().abs() + 0.1;  // with each above 0 the minimiser is unique
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
  tests::Random32 random(7);
  for (int run = 0; run < 60; ++run) {
    constexpr Eigen::Index m = 8, kinds = 5, alike = 20;
    const double apart = std::pow(10.0, -10 - run % 5);
    const Eigen::MatrixXd one = random.normal_matrix(m, kinds);
    const Eigen::VectorXd b = random.normal_matrix(m, 1);
    const Eigen::MatrixXd A = one.replicate(1, alike) + apart * random.normal_matrix(m, kinds * alike);
    const Eigen::VectorXd y = nonnegative_least_squares(A, b);
    const double least = (one * nonnegative_least_squares(one, b) - b).norm();
    CAPTURE(run, apart);
    CHECK(y.minCoeff() >= 0.0);
    // Loads of the size of b: their columns are off by `apart` each, and what little they differ by is round-off.
    CHECK((A * y - b).norm() <= least + 1e3 * apart * b.norm());
  }
}
