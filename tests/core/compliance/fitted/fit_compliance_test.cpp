#include "core/compliance/fitted/fit_compliance.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "tests/common/random.hpp"
#include "tests/core/compliance/fitted/random_gear.hpp"
#include "tests/core/compliance/fitted/synthetic_gear.hpp"
#include "core/compliance/fitted/thesis_form.hpp"

using namespace flankwright;
using namespace flankwright::testing;

namespace {

/// Small enough for a test: fewer end terms, a body of three functions.
KernelForm small_form(Reach reach = Reach::Tooth) {
  Kernel near{Smoothness::Matern32, Reach::Tooth, {3, {2, 2, 0}}, {2, {1, 1, 0}}, {1, {1, 0, 0}}}, far = near;
  far.reach = reach;
  return {{near, far}, {{3, Coupling::Common}}};
}

FitOptions steps(int count) {
  FitOptions options;
  options.solver.max_iterations = count;
  return options;
}

InfluenceSample sample_of(const FittedCompliance& truth, const std::vector<FlankStation>& points) {
  return {truth.gear(), points, truth.evaluate(points)};
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

}  // namespace

TEST_CASE("A compliance of the form itself is found again from its values", "[core][compliance][fitted]") {
  tests::Random32 random(1);
  const KernelForm form = small_form();
  const SyntheticGear grid(helical_gear());
  std::vector<double> x = flat_start(form, std::vector{grid.sample(grid.grid(4, 8))});
  for (double& c : x) c += random(-0.1, 0.1);
  const FittedCompliance truth(form, helical_gear(), x, {{-1, 1, 0, 12, 0}, {}, {}});
  const InfluenceSample sample = sample_of(truth, grid.grid(5, 12)), unseen = sample_of(truth, grid.grid(3, 9));

  FitOptions options = steps(200);
  options.tooth_ridge = options.body_ridge = 1e-8;
  const FitResult result = fit_compliance({&sample, 1}, form, options);
  REQUIRE(result.fit);
  CHECK(result.pairs == 60 * 61 / 2);
  CHECK(result.cost < 1e-4 * result.initial_cost);
  const auto errors = residual_statistics(*result.fit, {&unseen, 1});
  REQUIRE(errors.size() == 1);
  CHECK(errors[0].pairs == 27 * 28 / 2);
  CHECK(errors[0].worst < 1e-2);  // discretisation: how far the solver has come
}

TEST_CASE("Kernels come closer to unseen values of plates on an elastic base than the thesis' form", "[core][compliance][fitted]") {
  const SyntheticGear gear(helical_gear());
  const InfluenceSample fitted = gear.sample(gear.grid(5, 12)), unseen = gear.sample(gear.grid(4, 9));
  const FitResult kernels = fit_compliance({&fitted, 1}, KernelForm::one_tooth(), steps(120));
  const ThesisFitResult thesis = fit_thesis_form({&fitted, 1}, ThesisBody::Separate);
  REQUIRE(kernels.fit);
  REQUIRE(thesis.fit);
  const ResidualStatistics ours = residual_statistics(*kernels.fit, {&unseen, 1}).front();
  const ResidualStatistics theirs = residual_statistics(*thesis.fit, {&unseen, 1}).front();
  // Model: the plate's root, clamped, is harder than a tooth's.
  CHECK(ours.median < 0.02);
  CHECK(ours.share_95 < 0.08);
  CHECK(ours.median < 0.5 * theirs.median);
  CHECK(ours.share_95 < 0.5 * theirs.share_95);
}

TEST_CASE("Values on several teeth are fitted together", "[core][compliance][fitted]") {
  const SyntheticGear gear(helical_gear());
  const InfluenceSample teeth = gear.sample(gear.grid(3, 7, -1, 1));
  const FitResult result = fit_compliance({&teeth, 1}, small_form(Reach::Gear), steps(60));
  REQUIRE(result.fit);
  CHECK(result.fit->record().range.teeth_apart == 2);
  // 21 x 22 / 2 pairs on one tooth, 21 x 21 on neighbours and as many two apart: each counts once.
  CHECK(result.pairs == 231 + 441 + 441);
  REQUIRE(result.fit->record().residuals.size() == 3);
  CHECK(result.fit->record().residuals[0].pairs == 3 * 231);
  CHECK(result.fit->record().residuals[1].pairs == 2 * 441);
  for (const ResidualStatistics& residual : result.fit->record().residuals) CHECK(residual.median < 0.05);  // model

  // A form for one tooth takes the values on each tooth and leaves out those between them.
  const FitResult alone = fit_compliance({&teeth, 1}, small_form(), steps(20));
  REQUIRE(alone.fit);
  CHECK(alone.fit->record().range.teeth_apart == 0);
}

TEST_CASE("A fit is the same to the last bit when it is repeated", "[core][compliance][fitted]") {
  const SyntheticGear gear(helical_gear());
  const InfluenceSample sample = gear.sample(gear.grid(4, 8));
  const FitResult first = fit_compliance({&sample, 1}, small_form(), steps(25));
  const FitResult again = fit_compliance({&sample, 1}, small_form(), steps(25));
  REQUIRE(first.fit);
  REQUIRE(again.fit);
  CHECK(*first.fit == *again.fit);
  CHECK(first.covariance == again.covariance);
}

TEST_CASE("A fit drawn towards a neighbour's coefficients stays nearer to them", "[core][compliance][fitted]") {
  const KernelForm form = small_form();
  const SyntheticGear gear(helical_gear(12)), neighbour({32, 0.5, 12, 0}, 0.3);
  const InfluenceSample sample = gear.sample(gear.grid(4, 9)), next = neighbour.sample(neighbour.grid(4, 9));
  const FitResult reference = fit_compliance({&sample, 1}, form, steps(60));
  REQUIRE(reference.fit);
  const std::vector<double>& anchor = reference.fit->coefficients();
  double last = std::numeric_limits<double>::infinity(), last_cost = 0;
  for (const double ridge : {2.4e-4, 1e-2, 1e3}) {
    FitOptions options = steps(60);
    options.start = anchor;
    options.tooth_ridge = options.body_ridge = ridge;
    const FitResult result = fit_compliance({&next, 1}, form, options);
    REQUIRE(result.fit);
    const double away = distance(result.fit->coefficients(), anchor);
    CHECK(away < last);
    CHECK(result.cost > last_cost);
    last = away;
    last_cost = result.cost;
  }
  CHECK(last < 1e-5);  // a ridge without end leaves the anchor
}

TEST_CASE("The covariance shrinks as the number of values grows", "[core][compliance][fitted][closed-form]") {
  const SyntheticGear gear(helical_gear());
  const InfluenceSample sample = gear.sample(gear.grid(4, 8));
  const std::vector<InfluenceSample> twice{sample, sample};
  const FitResult once = fit_compliance({&sample, 1}, small_form(), steps(15));
  const FitResult doubled = fit_compliance(twice, small_form(), steps(15));
  REQUIRE(once.fit);
  REQUIRE(doubled.fit);
  // The mean square, and so the fit, is the same; s^2/N falls from 1/(N - n) to 1/(2 N - n).
  const double N = once.pairs, n = small_form().count();
  REQUIRE(doubled.pairs == 2 * once.pairs);
  CHECK(once.covariance.diagonal().minCoeff() > 0);
  constexpr double kRoundOff = 1e-4;  // times the condition of the normal equations
  CHECK(doubled.covariance.trace() / once.covariance.trace() == Approx((N - n) / (2 * N - n)).epsilon(kRoundOff));
  CHECK(once.fit->record().standard_errors[7] == Approx(std::sqrt(once.covariance(7, 7))).epsilon(1e-14));
}

TEST_CASE("A fit that fails, or may not go on, is a status; a sample that cannot be fitted is refused", "[core][compliance][fitted]") {
  const SyntheticGear gear(helical_gear());
  const InfluenceSample sample = gear.sample(gear.grid(3, 6));
  const KernelForm form = small_form();
  CHECK(fit_compliance({&sample, 1}, form, steps(2)).status == FitStatus::IterationLimit);

  FitOptions options;
  options.start.assign(static_cast<std::size_t>(form.count()), 800.0);
  const FitResult failed = fit_compliance({&sample, 1}, form, options);
  CHECK(failed.status == FitStatus::Failed);
  CHECK_FALSE(failed.fit);

  options.start.pop_back();
  CHECK_THROWS_AS(fit_compliance({&sample, 1}, form, options), InvalidInput);
  CHECK_THROWS_AS(fit_compliance({}, form), InvalidInput);
  std::vector<InfluenceSample> different{sample, sample};
  different[1].gear.teeth = 41;
  CHECK_THROWS_AS(fit_compliance(different, form), InvalidInput);
  KernelForm empty;
  CHECK_THROWS_AS(fit_compliance({&sample, 1}, empty), InvalidInput);
}
