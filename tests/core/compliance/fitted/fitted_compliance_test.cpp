#include "core/compliance/fitted/fitted_compliance.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "core/base/error.hpp"
#include "tests/common/random.hpp"
#include "tests/core/compliance/fitted/random_gear.hpp"
#include "tests/reference/eigenvalues.hpp"

using namespace flankwright;
using namespace flankwright::testing;

namespace {

FittedCompliance any_fit(tests::Random32& random) {
  KernelForm form = KernelForm::several_teeth();
  form.bodies.push_back({3, Coupling::Turning});
  const std::vector<double> x = random_coefficients(form, random);
  FitRecord record{{-0.9, 0.9, 0.25, 11.75, 4}, {{0, 100, 0.004, 0.02, 0.07}, {1, 50, 0.01, 0.05, 0.1}}, x};
  for (double& error : record.standard_errors) error = std::abs(error);
  return FittedCompliance(form, helical_gear(), x, record);
}

}  // namespace

TEST_CASE("The fitted matrix is exactly symmetric, and the same bits in any order of points", "[core][compliance][fitted]") {
  tests::Random32 random(3);
  const FittedCompliance fit = any_fit(random);
  std::vector<FlankStation> stations = random_stations(60, 12, -2, 2, random);
  const Eigen::MatrixXd K = fit.evaluate(stations);
  CHECK(K == K.transpose());
  std::reverse(stations.begin(), stations.end());
  for (FlankStation& station : stations) station.tooth += 7;  // only differences of teeth matter
  CHECK(fit.evaluate(stations) == K.reverse().eval());
}

TEST_CASE("A fit goes into a table of names and numbers, each name once", "[core][compliance][fitted]") {
  tests::Random32 random(4);
  const FittedCompliance fit = any_fit(random);
  const FitTable table = fit.to_table();
  REQUIRE(table.names.size() == table.values.size());
  CHECK(std::set<std::string>(table.names.begin(), table.names.end()).size() == table.names.size());
  const auto value = [&](const std::string& name) {
    const auto found = std::find(table.names.begin(), table.names.end(), name);
    REQUIRE(found != table.names.end());
    return table.values[static_cast<std::size_t>(found - table.names.begin())];
  };
  CHECK(value("form.kernels") == static_cast<double>(fit.form().kernels.size()));
  CHECK(value("form.body_0.functions") == fit.form().bodies[0].functions);
  CHECK(value("gear.helix_angle") == fit.gear().helix_angle);
  CHECK(value("residual_1.worst") == fit.record().residuals[1].worst);
  const std::vector<std::string> names = fit.form().coefficient_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    CHECK(value("coefficient." + names[i]) == fit.coefficients()[i]);
    CHECK(value("standard_error." + names[i]) == fit.record().standard_errors[i]);
  }
}

TEST_CASE("A fit refuses points outside its domain, and extends to those beyond its sample", "[core][compliance][fitted]") {
  tests::Random32 random(5);
  const FittedCompliance fit = any_fit(random);
  const std::vector<FlankStation> inside{{0, 0, 6}, {4, 0.9, 0.25}}, edge{{0, 1, 6}}, off{{0, 0, 12.01}}, above{{0, 1.1, 6}},
      apart{{0, 0, 6}, {5, 0, 6}};
  CHECK_NOTHROW(fit.evaluate(inside));
  CHECK_NOTHROW(fit.evaluate(edge));
  CHECK_THROWS_AS(fit.evaluate(off), InvalidInput);
  CHECK_THROWS_AS(fit.evaluate(above), InvalidInput);
  CHECK_THROWS_AS(fit.evaluate(apart), InvalidInput);
  CHECK(fit.evaluate({}).size() == 0);
}

TEST_CASE("Coefficients of a form have names of their own, as many as there are", "[core][compliance][fitted]") {
  for (const KernelForm& form : {KernelForm::one_tooth(), KernelForm::one_tooth_accurate(), KernelForm::several_teeth()}) {
    const std::vector<std::string> names = form.coefficient_names();
    CHECK(static_cast<int>(names.size()) == form.count());
    CHECK(std::set<std::string>(names.begin(), names.end()).size() == names.size());
    CHECK(form.tooth_count() + form.body_count() == form.count());
  }
  // A form that says nothing of two teeth may not claim to.
  tests::Random32 random(6);
  const KernelForm form = KernelForm::one_tooth();
  CHECK_THROWS_AS(FittedCompliance(form, helical_gear(), random_coefficients(form, random), {{-1, 1, 0, 12, 1}, {}, {}}), InvalidInput);
}

TEST_CASE("Blends of two gears' coefficients stay positive semi-definite", "[core][compliance][fitted]") {
  tests::Random32 random(8);
  const KernelForm form = KernelForm::several_teeth();
  const std::vector<double> a = random_coefficients(form, random), b = random_coefficients(form, random);
  std::vector<double> blend(a.size());
  for (const double share : {-0.5, 0.3, 0.5, 1.4}) {
    for (std::size_t i = 0; i < a.size(); ++i) blend[i] = (1 - share) * a[i] + share * b[i];
    const FittedCompliance fit(form, helical_gear(), blend, {{-1, 1, 0, 12, 4}, {}, {}});
    const Eigen::MatrixXd K = fit.evaluate(random_stations(150, 12, -2, 2, random));
    const Eigen::VectorXd values = symmetric_eigenvalues(K);
    CHECK(values[0] >= -1e-12 * values[149]);  // round-off
  }
}
