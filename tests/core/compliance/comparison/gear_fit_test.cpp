#include "core/compliance/comparison/gear_fit.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/base/error.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"

using namespace flankwright;

namespace {

GearFitTask small_task() {
  GearFitTask task;
  task.gear = test::gear_of(20, 25, 3);
  task.material = {1, 0.3};
  task.mesh = test::coarse();
  task.teeth_apart = 1;
  task.radii = 4;
  task.adjacent_radii = 4;
  task.form = KernelForm::one_tooth();
  task.fit.solver.max_iterations = 50;
  return task;
}

const FormResiduals& residuals_of(const GearFitResult& result, const std::string& form) {
  const auto found =
      std::find_if(result.residuals.begin(), result.residuals.end(), [&](const FormResiduals& residuals) { return residuals.form == form; });
  REQUIRE(found != result.residuals.end());
  return *found;
}

}  // namespace

TEST_CASE("A gear's fit is compared with finite elements at unseen stations and drawn beside the other models", "[core][compliance][comparison]") {
  int last = -1;
  std::vector<std::string> labels;
  const GearFitResult result = fit_gear(small_task(), [&](const std::string& label, int done, int total) {
    if (labels.empty() || labels.back() != label) labels.push_back(label);
    CHECK(done <= total);
    last = done;
  });
  CHECK(labels == std::vector<std::string>{"meshing and factorising", "solving loads", "fitting", "comparing"});
  CHECK(last == 3);
  REQUIRE(result.fit.fit);
  CHECK(result.eigenvalue_teeth == 1);
  CHECK(result.lowest_eigenvalue > -1e-12);  // round-off

  const FormResiduals &ours = residuals_of(result, "kernels"), &theirs = residuals_of(result, "thesis_separate");
  REQUIRE(ours.unseen.size() == 1);
  CHECK(ours.fitted[0].median() == result.fit.fit->record().residuals.front().median);
  // Model. Kernels come within a few percent where the fit has not looked, the thesis' curves do not.
  CHECK(ours.unseen[0].median() < 0.03);
  CHECK(ours.unseen[0].median() < 0.5 * theirs.unseen[0].median());
  CHECK(ours.fitted[0].pairs + ours.unseen[0].pairs > result.loads);

  // Right under the load the fitted curve is the finite elements'; the plate and the slices stand on a massive rim.
  for (const DeflectionCurve& curve : result.curves) {
    if (curve.tooth != 0 || curve.model != "fitted") continue;
    const auto other = std::find_if(result.curves.begin(), result.curves.end(), [&](const DeflectionCurve& candidate) {
      return candidate.model == "finite elements" && candidate.tooth == 0 && candidate.load == curve.load;
    });
    REQUIRE(other != result.curves.end());
    const auto at = std::find(curve.zeta.begin(), curve.zeta.end(), curve.load.zeta);
    if (at == curve.zeta.end()) continue;
    const auto i = static_cast<std::size_t>(at - curve.zeta.begin());
    CHECK(curve.value[i] == Approx(other->value[i]).epsilon(0.1));
  }
}

TEST_CASE("Several teeth are fitted at once, and the block matrix over five of them is semi-definite", "[core][compliance][comparison]") {
  GearFitTask task = small_task();
  task.form = KernelForm::several_teeth();
  task.test_grid = false;
  task.fit.solver.max_iterations = 4;
  const GearFitResult result = fit_gear(task);
  REQUIRE(result.fit.fit);
  CHECK(result.fit.fit->record().range.teeth_apart == 1);
  CHECK(result.eigenvalue_teeth == 5);
  CHECK(result.lowest_eigenvalue > -1e-12);  // round-off
  const FormResiduals& ours = residuals_of(result, "kernels");
  CHECK(ours.fitted.size() == 2);
  CHECK(ours.unseen.empty());
  // A load moves the neighbours, in the finite elements and in the fit; not in a plate or in slices.
  for (const char* model : {"finite elements", "fitted", "plate"}) {
    const bool has_neighbours =
        std::any_of(result.curves.begin(), result.curves.end(), [&](const DeflectionCurve& c) { return c.model == model && c.tooth == 1; });
    CHECK(has_neighbours == (std::string(model) != "plate"));
  }
}

TEST_CASE("A fit refuses grids and teeth that it cannot have", "[core][compliance][comparison]") {
  GearFitTask task = small_task();
  task.radii = 3;
  CHECK_THROWS_AS(fit_gear(task), InvalidInput);
  task = small_task();
  task.teeth_apart = 2;  // the coarse mesh has one on either side
  CHECK_THROWS_AS(fit_gear(task), InvalidInput);
}
