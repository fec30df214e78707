#include "core/compliance/tooth/local_spline.hpp"

#include <catch2/catch.hpp>

#include "core/compliance/tooth/station_grid.hpp"

using namespace flankwright;

TEST_CASE("B-splines and cardinal functions are the same spline", "[core][compliance]") {
  const std::vector<double> nodes = GENERATE(std::vector<double>{0, 1, 1.5, 4}, std::vector<double>{-1, 0, 0.1, 2, 3}, station_grid(12).zetas());
  const SplineAxis cardinal(nodes);
  const LocalSpline local(nodes);
  const double width = nodes.back() - nodes.front();
  for (int i = 0; i <= 50; ++i) {
    const double x = nodes.front() + width * i / 50;
    const LocalSpline::Weights b = local.at(x);
    REQUIRE(b.first >= 0);
    REQUIRE(b.first + 4 <= cardinal.size());
    const Eigen::Vector4d values(b.values.data());
    CHECK(values.sum() == Approx(1).epsilon(1e-14));  // round-off
    CHECK(values.minCoeff() >= 0);
    const Eigen::VectorXd weights = local.coefficients().middleRows(b.first, 4).transpose() * values;
    CHECK((weights - cardinal.weights(x)).cwiseAbs().maxCoeff() < 1e-12);  // round-off of the two inverses
  }
}
