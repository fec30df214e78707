#include "core/compliance/fitted/corrected_compliance.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "core/base/error.hpp"
#include "core/compliance/fitted/fitted_compliance.hpp"
#include "core/compliance/fitted/correction_library.hpp"
#include "tests/common/random.hpp"
#include "tests/core/compliance/fitted/random_gear.hpp"
#include "tests/reference/eigenvalues.hpp"

using namespace flankwright;
using namespace flankwright::testing;

TEST_CASE("A refined compliance adds to a tooth, not between teeth, and does no negative work", "[core][compliance][fitted]") {
  tests::Random32 random(11);
  const GearProportions gear = helical_gear();
  const KernelForm form = KernelForm::several_teeth();
  FitRecord record;
  record.range.teeth_apart = 4;
  const auto coarse = std::make_shared<FittedCompliance>(form, gear, random_coefficients(form, random, 0.2), record);
  const CorrectedCompliance refined(coarse, gear, CorrectionLibrary::shipped().coefficients(gear));
  const std::vector<FlankStation> stations = random_stations(100, gear.relative_face, -2, 2, random);
  const Eigen::MatrixXd before = coarse->evaluate(stations), after = refined.evaluate(stations);
  CHECK(after == after.transpose());
  for (std::size_t p = 0; p < stations.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    CHECK(after(i, i) > before(i, i));
    for (std::size_t q = 0; q < p; ++q) {
      const auto j = static_cast<Eigen::Index>(q);
      if (stations[p].tooth != stations[q].tooth) CHECK(after(i, j) == before(i, j));
    }
  }
  const Eigen::VectorXd values = symmetric_eigenvalues(after);
  CHECK(values[0] > -1e-13 * values[values.size() - 1]);  // round-off
}

TEST_CASE("A refined compliance needs a coarse one and coefficients of its form", "[core][compliance][fitted]") {
  const GearProportions gear = helical_gear();
  std::vector<double> coefficients = CorrectionLibrary::shipped().coefficients(gear);
  CHECK_THROWS_AS(CorrectedCompliance(nullptr, gear, coefficients), InvalidInput);
  const KernelForm form = KernelForm::one_tooth();
  const auto coarse = std::make_shared<FittedCompliance>(form, gear, std::vector<double>(static_cast<std::size_t>(form.count()), 0.0), FitRecord{});
  CHECK_THROWS_AS(CorrectedCompliance(coarse, gear, {1, 2}), InvalidInput);
  coefficients[3] = NAN;
  CHECK_THROWS_AS(CorrectedCompliance(coarse, gear, coefficients), InvalidInput);
}
