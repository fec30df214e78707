#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <map>
#include <string>

#include "tests/core/contact/wild_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;
using units::deg;
using units::pi;
using units::um;

namespace {

/// Whether the slope lies between those of forward and backward differences of the transmission error, which enclose it
/// wherever the error bends one way, or jumps. Short steps tell apart what is near, long ones what is little.
bool slope_is_that_of_differences(const ToothContactSolver& solver, const ToothContact& contact) {
  constexpr double kRoundOff = 2e-14;  // rad: of two angles, on kinks of their places too
  for (const double step : {1e-5, 1e-6, 1e-7}) {
    const ToothContact later = solver.find(0, contact.phi1 + step), earlier = solver.find(0, contact.phi1 - step);
    if (!later.exists() || !earlier.exists()) return true;  // nothing to compare with
    const double ahead = (later.transmission_error - contact.transmission_error) / step;
    const double behind = (contact.transmission_error - earlier.transmission_error) / step;
    const double round_off = kRoundOff / step;
    if (contact.slope >= std::min(ahead, behind) - round_off && contact.slope <= std::max(ahead, behind) + round_off) return true;
  }
  return false;
}

/// One answer each, no point of the grid inside the mate beyond round-off, and the slope that of differences.
std::map<std::string, int> check_wild_cases(unsigned seed, int count, int grid) {
  constexpr double kRoundOff = 1e-11;  // rad
  std::map<std::string, int> kinds;
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    const WildCase c = wild_case(random);
    const ToothContactSolver solver(c.scene);
    const ToothContact contact = solver.find(0, c.phi1);
    const double highest = highest_on_grid(c.scene, c.phi1, grid);
    ++kinds[to_string(contact.kind)];
    CAPTURE(seed, i, to_string(contact.kind), highest - contact.phi2, contact.pinion_radius, contact.pinion_z);
    if (!contact.exists()) {
      CHECK(std::isinf(highest));
      continue;
    }
    CHECK(highest <= contact.phi2 + kRoundOff);
    CHECK(slope_is_that_of_differences(solver, contact));
    if (contact.kind != ContactKind::Surface) continue;  // on a bound round-off decides what is outside
    const double rho = c.scene.pinion.roll_at(contact.pinion_radius);
    CHECK(std::abs(wheel_angle(c.scene, 0, c.phi1, rho, contact.pinion_z) - contact.phi2) <= kRoundOff);
  }
  return kinds;
}

}  // namespace

TEST_CASE("First contact of wild random gears has one answer, and nothing penetrates", "[core][contact][independent][slow]") {
  const std::map<std::string, int> kinds = check_wild_cases(20260301, 200, 50);
  // Every kind of contact that is not rare is among them.
  for (const char* kind : {"surface", "pinion_tip", "wheel_tip", "face_end", "corner"}) CHECK(kinds.count(kind) == 1);
}

TEST_CASE("First contact of ten thousand wild random gears", "[.soak]") {
  const auto start = std::chrono::steady_clock::now();
  const std::map<std::string, int> kinds = check_wild_cases(20260302, 10000, 60);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::string counts;
  for (const auto& [kind, count] : kinds) counts += " " + kind + " " + std::to_string(count);
  WARN("10000 contacts and their grids in " << seconds << " s:" << counts);
}

namespace {

/// A wavy flank as a measurement may show it.
class Waves : public DeviationField {
 public:
  Waves(double amplitude, double profile_length, double face_length, double phase)
      : amplitude_(amplitude), profile_(2 * pi / profile_length), face_(2 * pi / face_length), phase_(phase) {}
  Jet at(double rho, double z) const override {
    return amplitude_ * (sin(profile_ * Jet::variable_u(rho) + phase_) + cos(face_ * Jet::variable_v(z) - phase_));
  }

 private:
  double amplitude_, profile_, face_, phase_;
};

}  // namespace

TEST_CASE("The highest of many maxima of wavy flanks touches", "[core][contact][independent]") {
  constexpr double kRoundOff = 1e-11;  // rad
  Random random(27);
  int with_several_maxima = 0;
  for (int i = 0; i < 40; ++i) {
    const double beta = i % 2 == 0 ? 0.0 : random(5.0, 30.0) * deg;
    const GearPair pair = make_gear_pair(pair_data(22, 51, beta, 0.1, 0.0));
    Modification pinion, wheel;
    const double profile = random(2.0, 6.0), face = random(6.0, 30.0), phase = random(0.0, 6.0);
    pinion.topography = std::make_shared<Waves>(random(2 * um, 15 * um), profile, face, phase);
    wheel.lead_crowning = random(-10 * um, 10 * um);
    if (random.coin()) wheel.topography = std::make_shared<Waves>(random(1 * um, 5 * um), 4.0, 12.0, phase);
    Misalignment misalignment;
    misalignment.crossing = random(-2.0, 2.0) * arcmin;
    const FlankAssembly scene = scene_of(pair, misalignment, pinion, wheel);
    with_several_maxima += search_density(scene).cells > 1;
    const double phi1 = random(-0.1, 0.1);
    const ToothContact contact = find_tooth_contact(scene, 0, phi1);
    CAPTURE(i, beta / deg, profile, face, phi1, to_string(contact.kind), contact.pinion_z);
    REQUIRE(contact.exists());
    CHECK(highest_on_grid(scene, phi1, 100) <= contact.phi2 + kRoundOff);
  }
  CHECK(with_several_maxima >= 10);
}
