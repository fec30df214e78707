#include "core/compliance/fitted/fitted_compliance.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "core/base/error.hpp"
#include "tests/core/compliance/fitted/random_gear.hpp"
#include "tests/reference/eigenvalues.hpp"

using namespace flankwright;
using namespace flankwright::testing;

namespace {

FittedCompliance any_fit(std::mt19937& random) {
  KernelForm form = KernelForm::several_teeth();
  form.bodies.push_back({3, Coupling::Turning});
  const std::vector<double> x = random_coefficients(form, random);
  FitRecord record{{-0.9, 0.9, 0.25, 11.75, 4}, {{0, 100, 0.004, 0.02, 0.07}, {1, 50, 0.01, 0.05, 0.1}}, x};
  for (double& error : record.standard_errors) error = std::abs(error);
  return FittedCompliance(form, helical_gear(), x, record);
}

}  // namespace

TEST_CASE("The fitted matrix is the sum of tooth and body, exactly symmetric, and the same bits in any order of points",
          "[core][compliance][fitted]") {
  std::mt19937 random(3);
  const FittedCompliance fit = any_fit(random);
  std::vector<FlankStation> stations = random_stations(60, 12, -2, 2, random);
  const Eigen::MatrixXd K = fit.evaluate(stations);
  CHECK(K == K.transpose());
  CHECK(K.isApprox(fit.tooth_part(stations) + fit.body_part(stations), 1e-15));
  std::reverse(stations.begin(), stations.end());
  for (FlankStation& station : stations) station.tooth += 7;  // only differences of teeth matter
  CHECK(fit.evaluate(stations) == K.reverse().eval());
}

TEST_CASE("A fit goes into a table of names and numbers and comes back the same", "[core][compliance][fitted]") {
  std::mt19937 random(4);
  const FittedCompliance fit = any_fit(random);
  const FitTable table = fit.to_table();
  CHECK(std::set<std::string>(table.names.begin(), table.names.end()).size() == table.names.size());
  CHECK(FittedCompliance::from_table(table) == fit);

  // In any order.
  FitTable turned = table;
  std::reverse(turned.names.begin(), turned.names.end());
  std::reverse(turned.values.begin(), turned.values.end());
  CHECK(FittedCompliance::from_table(turned) == fit);
}

TEST_CASE("A table with an entry missing, unknown, double or impossible is refused by the entry's name", "[core][compliance][fitted]") {
  std::mt19937 random(4);
  const FitTable table = any_fit(random).to_table();
  const auto field_of = [](const FitTable& changed) -> std::string {
    try {
      FittedCompliance::from_table(changed);
    } catch (const InvalidInput& error) {
      return error.field();
    }
    return "";
  };
  const auto index = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(table.names.begin(), table.names.end(), name) - table.names.begin());
  };
  FitTable changed = table;
  changed.names[index("coefficient.warp.3")] = "coefficient.warp.33";
  CHECK(field_of(changed) == "coefficient.warp.3");
  changed = table;
  changed.names.push_back("extra");
  changed.values.push_back(1);
  CHECK(field_of(changed) == "extra");
  changed.names.back() = "gear.teeth";
  CHECK(field_of(changed) == "gear.teeth");
  changed = table;
  changed.values[index("form.kernel_0.reach")] = 3;
  CHECK(field_of(changed) == "form.kernel_0.reach");
  changed = table;
  changed.values[index("form.kernels")] = 1.5;
  CHECK(field_of(changed) == "form.kernels");
  changed = table;
  changed.values.pop_back();
  CHECK(field_of(changed) == "fit table");
}

TEST_CASE("A fit refuses points outside its domain, and reports those beyond its sample", "[core][compliance][fitted]") {
  std::mt19937 random(5);
  const FittedCompliance fit = any_fit(random);
  const std::vector<FlankStation> inside{{0, 0, 6}, {4, 0.9, 0.25}}, edge{{0, 1, 6}}, off{{0, 0, 12.01}}, above{{0, 1.1, 6}},
      apart{{0, 0, 6}, {5, 0, 6}};
  CHECK(fit.covers(inside));
  CHECK_FALSE(fit.covers(edge));
  CHECK_FALSE(fit.covers(apart));
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
  std::mt19937 random(6);
  const KernelForm form = KernelForm::one_tooth();
  CHECK_THROWS_AS(FittedCompliance(form, helical_gear(), random_coefficients(form, random), {{-1, 1, 0, 12, 1}, {}, {}}), InvalidInput);
}

TEST_CASE("Blends of two gears' coefficients stay positive semi-definite", "[core][compliance][fitted]") {
  std::mt19937 random(8);
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
