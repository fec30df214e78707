#include "core/compliance/thin_slice/iso_stiffness.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using units::deg;

namespace {

GearPair pair_of(int z1, int z2, double beta = 0, double x1 = 0, double x2 = 0, double dedendum = 1.2) {
  PairData data;
  data.normal_module = 4;
  data.helix_angle = beta;
  for (GearData* gear : {&data.pinion, &data.wheel}) {
    gear->face_width = 40;
    gear->rack.dedendum = dedendum;
    gear->rack.root_radius = 0.3;
  }
  data.pinion.teeth = z1;
  data.wheel.teeth = z2;
  data.pinion.profile_shift = x1;
  data.wheel.profile_shift = x2;
  return make_gear_pair(data);
}

}  // namespace

TEST_CASE("ISO's flexibility of two racks is its constant, and 21.2 N/(mm um) the stiffness", "[core][compliance][iso]") {
  CHECK(iso_flexibility(INFINITY, INFINITY, 0, 0) == 0.04723);
  // Worked by hand for z_n 20 / 50, x 0.3 / 0.1.
  const double q = 0.04723 + 0.0077755 + 0.0051582 - 0.001905 - 0.0017481 - 0.000193 - 0.00048376 + 0.0004761 + 0.0000182;
  CHECK(iso_flexibility(20, 50, 0.3, 0.1) == Approx(q).epsilon(1e-12));  // round-off
}

TEST_CASE("A common steel gear has the stiffnesses that ISO 6336-1 gives as usual", "[core][compliance][iso]") {
  // Model: the standard offers c' = 14 and c_gamma = 20 N/(mm um) where nothing better is known, for contact ratios
  // from about 1.2 (c' itself times 1.15) to 1.9 (times 1.675).
  const IsoStiffness iso = iso_stiffness(pair_of(30, 90), {}, {});
  CHECK(iso.c_prime == Approx(14).epsilon(0.06));
  CHECK(iso.c_gamma == Approx(20).epsilon(0.15));
  CHECK(iso.within_range);
  CHECK(iso.mean_within_range);
}

TEST_CASE("ISO's factors for rack, helix and material multiply as stated", "[core][compliance][iso]") {
  const IsoStiffness iso = iso_stiffness(pair_of(30, 90), {}, {});
  constexpr double kRoundOff = 1e-13;
  CHECK(iso.rack_factor == Approx(1).epsilon(kRoundOff));  // h_fP 1.2, alpha 20 deg
  CHECK(iso.c_prime == Approx(0.8 / iso.q_prime).epsilon(kRoundOff));

  const IsoStiffness deep = iso_stiffness(pair_of(30, 90, 0, 0, 0, 1.4), {}, {});
  CHECK(deep.c_prime / iso.c_prime == Approx(0.9).epsilon(kRoundOff));

  const Material soft{103000, 0.3};
  const IsoStiffness mixed = iso_stiffness(pair_of(30, 90), {}, soft);
  CHECK(mixed.c_prime / iso.c_prime == Approx(2.0 / 3).epsilon(kRoundOff));  // 2 * 1 * 0.5 / 1.5

  const double beta = 25 * deg;
  const IsoStiffness helical = iso_stiffness(pair_of(30, 90, beta), {}, {});
  CHECK(helical.c_prime == Approx(helical.normal_section * std::cos(beta)).epsilon(kRoundOff));
  // Model: z/(cos^2 beta_b cos beta) is close to z/cos^3 beta.
  CHECK(helical.virtual_teeth_pinion == Approx(30 / std::pow(std::cos(beta), 3)).epsilon(0.05));
}

TEST_CASE("Whichever gear is called the pinion, ISO's stiffness is the same", "[core][compliance][iso]") {
  const auto same = [](int z1, int z2, double x1, double x2) {
    const IsoStiffness one = iso_stiffness(pair_of(z1, z2, 10 * deg, x1, x2), {}, {}),
                       other = iso_stiffness(pair_of(z2, z1, 10 * deg, x2, x1), {}, {});
    constexpr double kRoundOff = 1e-13;
    CHECK(one.c_prime == Approx(other.c_prime).epsilon(kRoundOff));
    CHECK(one.c_gamma == Approx(other.c_gamma).epsilon(kRoundOff));
    CHECK(one.within_range == other.within_range);
  };
  same(20, 200, 0.3, -0.3);
  same(20, 200, -0.3, 0.3);
  same(33, 33, 0.2, -0.1);
}

TEST_CASE("Outside its range ISO's stiffness says so", "[core][compliance][iso]") {
  CHECK(iso_stiffness(pair_of(30, 90, 0, 0.3, -0.3), {}, {}).within_range);
  CHECK_FALSE(iso_stiffness(pair_of(30, 90, 0, -0.2, 0.3), {}, {}).within_range);
  CHECK_FALSE(iso_stiffness(pair_of(40, 90, 0, -0.3, -0.4), {}, {}).within_range);
  CHECK_THROWS_AS(iso_stiffness(pair_of(30, 90), {-1, 0.3}, {}), InvalidInput);
}
