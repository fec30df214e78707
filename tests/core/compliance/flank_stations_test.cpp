#include "core/compliance/tooth/flank_stations.hpp"

#include <catch2/catch.hpp>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

using namespace flankwright;

TEST_CASE("u counts radii from the start of the involute to the tip", "[core][compliance]") {
  GearData gear;
  gear.teeth = 30;
  const ToothForm form(gear, 4, 20 * units::deg, 0);
  CHECK(flank_radius(form, -1) == form.form_radius());
  CHECK(flank_radius(form, 1) == form.tip_radius());
  CHECK(flank_radius(form, 0) == Approx(0.5 * (form.form_radius() + form.tip_radius())).epsilon(1e-15));
}

TEST_CASE("A station off the flank is refused by the name of its wrong coordinate", "[core][compliance]") {
  CHECK_NOTHROW(require_on_flank({3, 1, 0}, 6));
  CHECK_NOTHROW(require_on_flank({0, -1, 6}, 6));
  CHECK_THROWS_WITH(require_on_flank({0, 1.01, 3}, 6), Catch::Contains("place.u"));
  CHECK_THROWS_WITH(require_on_flank({0, 0, 6.01}, 6), Catch::Contains("place.zeta"));
  CHECK_THROWS_AS(require_on_flank({0, 0, -0.01}, 6), InvalidInput);
}
