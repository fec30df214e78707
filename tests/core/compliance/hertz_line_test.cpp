#include "core/compliance/local/hertz_line.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

using namespace flankwright;
using units::pi;

TEST_CASE("The Hertzian pressure carries the load and fits the bodies' curvature", "[core][compliance][closed-form]") {
  const double w = GENERATE(1.0, 250.0, 2000.0);  // N/mm
  const double radius = GENERATE(2.0, 40.0);      // mm
  const double modulus = contact_modulus({}, {});
  CAPTURE(w, radius);
  const HertzLine contact = hertz_line(w, radius, modulus);
  constexpr double kRoundOff = 1e-14;
  // The half ellipse of pressure is in equilibrium with the load ...
  CHECK(pi / 2 * contact.peak_pressure * contact.half_width == Approx(w).epsilon(kRoundOff));
  // ... and flattens the relative curvature: 2 p_0 / (E' L) = 1/R.
  CHECK(2 * contact.peak_pressure / (modulus * contact.half_width) == Approx(1 / radius).epsilon(kRoundOff));
}

TEST_CASE("Two equal gears have Haddad's half width", "[core][compliance][reference]") {
  const Material steel{209000, 0.3};
  const double w = 79.0, radius = 16.5;
  // Haddad 1991, eq. 1.31, L = sqrt(8 (1 - nu^2) w R / (pi E)).
  const double haddad = std::sqrt(8 * (1 - 0.09) * w * radius / (pi * 209000));
  CHECK(hertz_line(w, radius, contact_modulus(steel, steel)).half_width == Approx(haddad).epsilon(1e-14));  // round-off
}

TEST_CASE("The slopes of the Hertzian contact are its derivatives", "[core][compliance]") {
  const double w = 300, radius = 12, modulus = 1.1e5, step = 1e-3;
  const HertzLine contact = hertz_line(w, radius, modulus);
  const HertzLine below = hertz_line(w - step, radius, modulus), above = hertz_line(w + step, radius, modulus);
  constexpr double kDiscretisation = 1e-9;
  CHECK(contact.half_width_slope == Approx((above.half_width - below.half_width) / (2 * step)).epsilon(kDiscretisation));
  CHECK(contact.peak_pressure_slope == Approx((above.peak_pressure - below.peak_pressure) / (2 * step)).epsilon(kDiscretisation));
}

TEST_CASE("An unloaded line contact has no width and an infinite slope", "[core][compliance]") {
  const HertzLine contact = hertz_line(0, 10, 1e5);
  CHECK(contact.half_width == 0);
  CHECK(contact.peak_pressure == 0);
  CHECK(std::isinf(contact.half_width_slope));
}

TEST_CASE("Hertz refuses what cannot be a contact", "[core][compliance]") {
  CHECK_THROWS_AS(hertz_line(-1, 10, 1e5), InvalidInput);
  CHECK_THROWS_AS(hertz_line(1, 0, 1e5), InvalidInput);
  CHECK_THROWS_AS(hertz_line(1, 10, std::nan("")), InvalidInput);
  CHECK_THROWS_AS(contact_modulus({0, 0.3}, {}), InvalidInput);
  CHECK_THROWS_AS(contact_modulus({}, {206000, 0.5}), InvalidInput);
}
