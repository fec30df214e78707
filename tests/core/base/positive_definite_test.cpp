#include "core/base/positive_definite.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/common/random.hpp"

using namespace flankwright;

TEST_CASE("A stiffness that leaves a motion free is refused whatever round-off makes of it", "[core][base]") {
  tests::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const auto size = static_cast<Eigen::Index>(random.integer(2, 9));
    // Rows in units that differ as N/mm and N mm/rad do.
    const Eigen::VectorXd units = Eigen::VectorXd::NullaryExpr(size, [&] { return random.log_uniform(1e-3, 1e3); });
    const Eigen::MatrixXd free = units.asDiagonal() * random.matrix(size, size - 1);
    const Eigen::MatrixXd singular = free * free.transpose();
    CHECK_FALSE(is_positive_definite(singular));
    const Eigen::MatrixXd held = singular + Eigen::MatrixXd(1e-3 * singular.diagonal().asDiagonal());
    CHECK(is_positive_definite(held));
    CHECK_FALSE(is_positive_definite(-held));
  }
  Eigen::MatrixXd floating(2, 2);  // of two seats that hold each other and nothing else
  for (const double k : {1.0, 123.4, 300.0, 7e5}) {
    floating << k, -k, -k, k;
    CHECK_FALSE(is_positive_definite(floating));
  }
  CHECK_FALSE(is_positive_definite(Eigen::MatrixXd::Zero(3, 3)));
  CHECK_FALSE(is_positive_definite(Eigen::MatrixXd::Constant(1, 1, NAN)));
}
