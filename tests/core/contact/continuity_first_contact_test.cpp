#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;
using units::arcsec;

TEST_CASE("Around crossing that a lead error takes back the transmission error neither fails nor jumps", "[core][contact]") {
  // TM-107451, fig. 9: crossing 3' and lead angle -3'. Contact jumps over the whole face there, its angle must not: to first
  // order a change d of the crossing turns the wheel by d times half the face over r_b2, and a few times that with the gears'
  // size.
  const GearPair pair = make_gear_pair(reference::nasa_tm_107451::pair_data());
  const auto contact_at = [&](double change, double phi1, int tooth) {
    Misalignment m;
    m.crossing = reference::nasa_tm_107451::error + change;
    m.pinion_lead_angle = -reference::nasa_tm_107451::error;
    return find_tooth_contact(scene_of(pair, m), tooth, phi1);
  };
  for (const double phi1 : {-0.1, -0.05, 0.0, 0.03, 0.08}) {
    const ToothContact at_balance = contact_at(0.0, phi1, 0);
    REQUIRE(at_balance.exists());
    CHECK(std::abs(at_balance.transmission_error - contact_at(0.0, 0.0, 0).transmission_error) <= 1e-3 * arcsec);
    for (const double step : {1e-3, 1e-6, 1e-9}) {
      for (const double side : {-1.0, 1.0}) {
        const double change = side * step * arcmin;
        const ToothContact near = contact_at(change, phi1, 0);
        CAPTURE(phi1, step, side, to_string(near.kind), near.transmission_error - at_balance.transmission_error);
        REQUIRE(near.exists());
        constexpr double kRoundOff = 1e-14;  // rad
        CHECK(std::abs(near.transmission_error - at_balance.transmission_error) <= std::abs(change) + kRoundOff);
      }
    }
  }
}

TEST_CASE("The answer does not depend on what was asked before", "[core][contact]") {
  Random random(5);
  const GearPair pair = make_gear_pair(pair_data(21, 37, 18 * units::deg));
  const Misalignment misalignment = random_misalignment(random);
  const FlankAssembly scene = scene_of(pair, misalignment, random_modification(random, pair.pinion));
  const ToothContactSolver solver(scene);
  const ToothContact fresh = find_tooth_contact(scene, 0, 0.02);
  solver.find(0, -0.1);
  solver.find(1, 0.05);
  const ToothContact later = solver.find(0, 0.02);
  CHECK(later.phi2 == fresh.phi2);  // same bits
  CHECK(later.pinion_z == fresh.pinion_z);
  CHECK(later.slope == fresh.slope);
}
