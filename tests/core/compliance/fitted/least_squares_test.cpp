#include "core/compliance/fitted/least_squares.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"

using namespace flankwright;

namespace {

/// y = b1 (1 - exp(-b2 x)): NIST's Misra1a, with its certified solution.
class Misra final : public ResidualFunction {
 public:
  int residual_count() const override { return static_cast<int>(kX.size()); }
  int coefficient_count() const override { return 2; }
  bool evaluate(std::span<const double> b, std::span<double> residuals, std::span<double> jacobian) const override {
    for (std::size_t i = 0; i < kX.size(); ++i) {
      const double decay = std::exp(-b[1] * kX[i]);
      residuals[i] = b[0] * (1 - decay) - kY[i];
      if (jacobian.empty()) continue;
      jacobian[2 * i] = 1 - decay;
      jacobian[2 * i + 1] = b[0] * kX[i] * decay;
    }
    return std::isfinite(residuals[0]);
  }

 private:
  static constexpr std::array<double, 14> kY{10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};
  static constexpr std::array<double, 14> kX{77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};
};

}  // namespace

TEST_CASE("Least squares meet NIST's certified values from both of its starts", "[core][compliance][fitted][reference]") {
  const auto start = GENERATE(std::array<double, 2>{500, 0.0001}, std::array<double, 2>{250, 0.0005});
  const LeastSquaresResult result = solve_least_squares(Misra{}, start, {200, 1e-14});
  CHECK(result.status == FitStatus::Converged);
  constexpr double kTolerance = 1e-6;  // discretisation: of the stopping test
  CHECK(result.coefficients[0] == Approx(2.3894212918e2).epsilon(kTolerance));
  CHECK(result.coefficients[1] == Approx(5.5015643181e-4).epsilon(kTolerance));
  CHECK(2 * result.cost == Approx(1.2455138894e-1).epsilon(1e-8));
}

TEST_CASE("A fit that ends early reports it, and so does one that cannot begin", "[core][compliance][fitted]") {
  const std::array<double, 2> start{500, 0.0001}, absurd{1, -1e6};
  const LeastSquaresResult stopped = solve_least_squares(Misra{}, start, {1, 1e-14});
  CHECK(stopped.status == FitStatus::IterationLimit);
  CHECK(stopped.cost <= stopped.initial_cost);
  const LeastSquaresResult failed = solve_least_squares(Misra{}, absurd, {});
  CHECK(failed.status == FitStatus::Failed);
  CHECK(failed.coefficients == std::vector<double>(absurd.begin(), absurd.end()));
  CHECK_FALSE(failed.message.empty());
}

TEST_CASE("Least squares refuse a start of another size and options out of range", "[core][compliance][fitted]") {
  const std::array<double, 3> three{1, 2, 3};
  const std::array<double, 2> two{1, 2};
  CHECK_THROWS_AS(solve_least_squares(Misra{}, three, {}), InvalidInput);
  CHECK_THROWS_AS(solve_least_squares(Misra{}, two, {0, 1e-6}), InvalidInput);
  CHECK_THROWS_AS(solve_least_squares(Misra{}, two, {10, 0.0}), InvalidInput);
}
