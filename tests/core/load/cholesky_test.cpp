#include "core/load/solve/cholesky.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <limits>

#include "tests/core/load/load_cases.hpp"
#include "tests/hard_cases/floating_point_traps.hpp"

using namespace flankwright;
using load_cases::Random;

namespace {

Eigen::MatrixXd definite(Eigen::Index n, Random& random) {
  const Eigen::MatrixXd factor = random.matrix(n, n);
  return factor * factor.transpose() + Eigen::MatrixXd::Identity(n, n);
}

}  // namespace

TEST_CASE("A Cholesky factor solves as Eigen's does, whatever the size", "[core][load][independent]") {
  constexpr double kRoundOff = 1e-12;  // condition up to about 1e3
  Random random(61);
  for (Eigen::Index n = 1; n <= 70; ++n) {
    const Eigen::MatrixXd H = definite(n, random), right = random.matrix(n, 3);
    Cholesky factor;
    Eigen::MatrixXd& rows = factor.prepare(n, 1);
    rows.topRows(n).triangularView<Eigen::Lower>() = H;
    rows.topRows(n).triangularView<Eigen::StrictlyUpper>().setConstant(std::numeric_limits<double>::signaling_NaN());
    rows.row(n) = right.col(0).transpose();
    {
      const hard_cases::FloatingPointTraps traps;  // what is above the diagonal is not read
      factor.factorise();
    }
    CAPTURE(n);
    REQUIRE(factor.singular_pivots() == 0);
    const Eigen::LLT<Eigen::MatrixXd> reference(H);
    Eigen::MatrixXd solution = right;
    factor.solve(solution);
    CHECK((solution - reference.solve(right)).norm() <= kRoundOff * solution.norm());
    Eigen::VectorXd carried = factor.carried(0).transpose();
    factor.solve_transposed(carried);
    CHECK((carried - solution.col(0)).norm() <= kRoundOff * solution.norm());
    const double norm = H.inverse().cwiseAbs().colwise().sum().maxCoeff();
    CHECK(factor.inverse_norm() <= norm * (1.0 + kRoundOff));
    CHECK(factor.inverse_norm() >= norm / 3.0);
  }
}

TEST_CASE("A singular matrix solves what it can, without the unknowns that it does not know", "[core][load][hard]") {
  constexpr double kRoundOff = 1e-9;
  Random random(62);
  for (const Eigen::Index n : {2, 5, 11, 40}) {
    // The second half repeats the first: rank n/2, to the last bit.
    const Eigen::Index half = n / 2;
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
    H.topLeftCorner(half, half) = definite(half, random);
    H.block(half, 0, half, half) = H.block(0, half, half, half) = H.block(half, half, half, half) = H.topLeftCorner(half, half);
    if (2 * half < n) H(n - 1, n - 1) = 1.0;
    const Eigen::VectorXd right = H * random.vector(n, -1.0, 1.0);
    Cholesky factor;
    factor.prepare(n) = H;
    factor.factorise();
    Eigen::VectorXd solution = right;
    factor.solve(solution);
    CAPTURE(n);
    CHECK(factor.singular_pivots() >= 1);
    CHECK((H * solution - right).norm() <= kRoundOff * right.norm());
  }
}
