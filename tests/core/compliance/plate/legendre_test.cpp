#include "core/compliance/plate/legendre.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace flankwright;

TEST_CASE("A Gauss rule of n points is exact to the degree 2n - 1 and not beyond", "[core][compliance][plate][closed-form]") {
  const int n = GENERATE(1, 4, 17);
  const GaussRule rule(n);
  const auto integral = [&](int degree) { return rule.weights.dot(rule.nodes.array().pow(degree).matrix()); };
  constexpr double kRoundOff = 1e-13;
  for (int degree = 0; degree < 2 * n; degree += 2) CHECK(std::abs(integral(degree) - 2.0 / (degree + 1)) < kRoundOff);
  CHECK(std::abs(integral(2 * n) - 2.0 / (2 * n + 1)) > 1e-12);
}

TEST_CASE("Legendre polynomials are orthonormal, their slopes the derivatives, and products of slopes exact",
          "[core][compliance][plate][closed-form]") {
  const LegendreBasis basis(-0.7, 3.1, 9);
  const GaussRule rule(12);
  Eigen::MatrixXd unity = Eigen::MatrixXd::Zero(9, 9), mixed = unity, slopes = unity;
  for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
    const LegendreValues p = basis.at(1.2 + 1.9 * rule.nodes[k]);
    const double dx = 1.9 * rule.weights[k];
    unity += dx * p.value * p.value.transpose();
    mixed += dx * p.slope * p.value.transpose();
    slopes += dx * p.slope * p.slope.transpose();
  }
  constexpr double kRoundOff = 1e-12;
  const Eigen::MatrixXd C = basis.slope_products();
  CHECK((unity - Eigen::MatrixXd::Identity(9, 9)).cwiseAbs().maxCoeff() < kRoundOff);
  CHECK((mixed - C).cwiseAbs().maxCoeff() < kRoundOff * C.cwiseAbs().maxCoeff());
  CHECK((slopes - C * C.transpose()).cwiseAbs().maxCoeff() < kRoundOff * slopes.cwiseAbs().maxCoeff());

  const double x = 0.43, h = 1e-5;
  const Eigen::VectorXd difference = (basis.at(x + h).value - basis.at(x - h).value) / (2 * h);
  CHECK((difference - basis.at(x).slope).cwiseAbs().maxCoeff() < 1e-7);  // discretisation, h^2
}
