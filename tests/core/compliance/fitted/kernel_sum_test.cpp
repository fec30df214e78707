#include "core/compliance/fitted/kernel_sum.hpp"

#include <catch2/catch.hpp>

#include "tests/common/random.hpp"
#include "tests/core/compliance/fitted/random_gear.hpp"
#include "tests/reference/eigenvalues.hpp"

using namespace flankwright;
using namespace flankwright::testing;

namespace {

/// Every kind of kernel and body part.
KernelForm everything() {
  KernelForm form = KernelForm::several_teeth();
  form.kernels.push_back({Smoothness::Matern52, Reach::Turning, {2, {1, 0, 0}}, {1, {}}, {1, {}}});
  form.bodies.push_back({3, Coupling::Turning});
  return form;
}

double smallest_over_largest(const Eigen::MatrixXd& K) {
  const Eigen::VectorXd values = symmetric_eigenvalues(K);
  return values[0] / values[values.size() - 1];
}

}  // namespace

TEST_CASE("The matrix over any points of five teeth is symmetric and positive semi-definite, whatever the coefficients",
          "[core][compliance][fitted]") {
  tests::Random32 random(GENERATE(1u, 2u, 3u, 4u, 5u));
  const KernelForm form = everything();
  const GearProportions gear = helical_gear();
  KernelSum sum(form, gear, random_stations(200, gear.relative_face, -2, 2, random));
  sum.set_coefficients(random_coefficients(form, random));
  for (const Eigen::MatrixXd& K : {sum.tooth_matrix(), sum.body_matrix()}) {
    CHECK(K == K.transpose());
    CHECK(smallest_over_largest(K) >= -1e-12);  // round-off
  }
}

TEST_CASE("Pair by pair and as a matrix the kernels are the same, and their derivatives are those of differences", "[core][compliance][fitted]") {
  tests::Random32 random(7);
  const KernelForm form = everything();
  const GearProportions gear = helical_gear();
  const std::vector<FlankStation> stations = random_stations(12, gear.relative_face, -1, 2, random);
  KernelSum sum(form, gear, stations);
  const std::vector<double> x = random_coefficients(form, random, 0.3);
  sum.set_coefficients(x);
  const Eigen::MatrixXd K = sum.tooth_matrix() + sum.body_matrix();

  const auto n = static_cast<Eigen::Index>(stations.size());
  const std::size_t size = x.size();
  std::vector<double> gradients(static_cast<std::size_t>(n * n) * size);
  const auto gradient = [&](Eigen::Index p, Eigen::Index q) {
    return std::span(gradients).subspan(static_cast<std::size_t>(p * n + q) * size, size);
  };
  for (Eigen::Index p = 0; p < n; ++p) {
    for (Eigen::Index q = 0; q < n; ++q) {
      CHECK(sum.with_gradient(p, q, gradient(p, q)) == Approx(K(p, q)).epsilon(1e-13));  // round-off
    }
  }
  constexpr double kStep = 1e-4, kDiscretisation = 1e-6;  // the square of the step, times third derivatives
  double worst = 0;
  for (std::size_t c = 0; c < size; ++c) {
    std::vector<double> moved = x;
    moved[c] = x[c] + kStep;
    sum.set_coefficients(moved);
    const Eigen::MatrixXd above = sum.tooth_matrix() + sum.body_matrix();
    moved[c] = x[c] - kStep;
    sum.set_coefficients(moved);
    const Eigen::MatrixXd difference = (above - sum.tooth_matrix() - sum.body_matrix()) / (2 * kStep);
    for (Eigen::Index p = 0; p < n; ++p) {
      for (Eigen::Index q = 0; q < n; ++q) {
        worst = std::max(worst, std::abs(difference(p, q) - gradient(p, q)[c]) / (1 + std::abs(gradient(p, q)[c])));
      }
    }
  }
  CHECK(worst < kDiscretisation);
}

TEST_CASE("A kernel of constant lengths without warp is its closed form", "[core][compliance][fitted][closed-form]") {
  const Smoothness smoothness = GENERATE(Smoothness::Matern32, Smoothness::Matern52);
  KernelForm form{{Kernel{smoothness, Reach::Tooth, {1, {}}, {1, {}}, {1, {}}}}, {}};
  const double g = 1.7, lz = 2.3, lr = 0.8;
  std::vector<double> x{0, 0, 0, 0, 0, std::log(g), std::log(lz), std::log(lr)};
  REQUIRE(form.count() == 8);
  const std::vector<FlankStation> stations{{0, 0.3, 4}, {0, -0.5, 7}, {1, 0.3, 4}};
  KernelSum sum(form, helical_gear(), stations);
  sum.set_coefficients(x);
  const Eigen::MatrixXd K = sum.tooth_matrix();
  const double Q = 9 / (lz * lz) + 0.64 / (lr * lr);
  const double t = std::sqrt((smoothness == Smoothness::Matern32 ? 3 : 5) * Q);
  const double rho = (1 + t + (smoothness == Smoothness::Matern32 ? 0 : t * t / 3)) * std::exp(-t);
  constexpr double kRoundOff = 1e-13;
  CHECK(K(0, 0) == Approx(g * g).epsilon(kRoundOff));
  CHECK(K(0, 1) == Approx(g * g * rho).epsilon(kRoundOff));
  CHECK(K(0, 2) == 0);  // another tooth
}

TEST_CASE("The body twists as a shaft in torsion", "[core][compliance][fitted][closed-form]") {
  KernelForm form{{Kernel{Smoothness::Matern32, Reach::Tooth, {1, {}}, {1, {}}, {1, {}}}}, {}, true};
  const double c = 0.02, w = GENERATE(1e-3, 2.0);
  const std::vector<double> x{0, 0, 0, 0, 0, 0, 0, 0, std::log(c), std::log(w)};
  REQUIRE(form.count() == 10);
  const std::vector<FlankStation> stations{{0, 0.3, 4}, {2, -0.5, 7}, {1, 0, 0}};
  KernelSum sum(form, helical_gear(), stations);
  sum.set_coefficients(x);
  const Eigen::MatrixXd K = sum.body_matrix();
  // Model: rounding off takes less than w from the length that is twisted.
  CHECK(K(0, 1) <= c * 4);
  CHECK(K(0, 1) >= c * (4 - w));
  CHECK(K(0, 1) == K(1, 0));
  CHECK(K(1, 1) >= c * (7 - w));
  CHECK(std::abs(K(2, 0)) < 1e-15);  // no twist where the torque leaves; round-off
}

TEST_CASE("The compliance is smooth where a point passes the load", "[core][compliance][fitted]") {
  tests::Random32 random(11);
  const KernelForm form = everything();
  const double h = 1e-4;
  const std::vector<FlankStation> stations{{0, 0.1, 5}, {0, 0.1, 5 - h}, {0, 0.1, 5 + h}, {0, 0.1 - h, 5}, {0, 0.1 + h, 5}};
  KernelSum sum(form, helical_gear(), stations);
  sum.set_coefficients(random_coefficients(form, random, 0.3));
  const Eigen::MatrixXd K = sum.tooth_matrix() + sum.body_matrix();
  // A kink would leave a jump in slope of the size of K over a length; what is left is the curvature times h.
  const double axial_jump = (K(2, 0) - 2 * K(0, 0) + K(1, 0)) / h, radial_jump = (K(4, 0) - 2 * K(0, 0) + K(3, 0)) / h;
  constexpr double kDiscretisation = 1e-2;
  CHECK(std::abs(axial_jump) < kDiscretisation * K(0, 0));
  CHECK(std::abs(radial_jump) < kDiscretisation * K(0, 0));
}
