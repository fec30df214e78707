#include "core/flank/manufacturing_error.hpp"

#include <catch2/catch.hpp>

using namespace flankwright;

TEST_CASE("A tooth's errors are those of all teeth and its own, lists going round the gear", "[core][gear]") {
  ManufacturingError error;
  error.helix_slope = 1.0;
  error.twist = -2.0;
  error.helix_slopes = {0.0, 0.5, -4.0};
  error.profile_slopes = {7.0, 8.0, 9.0};
  CHECK(tooth_error(error, 0).helix_slope == 1.0);
  CHECK(tooth_error(error, 2).helix_slope == -3.0);
  for (int tooth = -7; tooth < 7; ++tooth) {
    const ToothError here = tooth_error(error, tooth);
    CHECK(here.helix_slope == tooth_error(error, tooth + 3).helix_slope);
    CHECK(here.profile_slope == 7.0 + (tooth + 9) % 3);
    CHECK(here.twist == -2.0);
  }
}
