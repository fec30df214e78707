#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <string>

#include "tests/core/contact/contact_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;
using units::deg;
using units::pi;

namespace {

struct Transition {
  ToothContact before, after;  ///< at neighbouring angles, of different kinds
};

/// Where the kind changes between two angles, halved to where no number is left between them but round-off.
Transition locate(const ToothContactSolver& solver, ToothContact before, ToothContact after) {
  constexpr double kNeighbours = 1e-13;  // rad
  while (after.phi1 - before.phi1 > kNeighbours) {
    const ToothContact middle = solver.find(0, 0.5 * (before.phi1 + after.phi1));
    (middle.kind == before.kind ? before : after) = middle;
  }
  return {before, after};
}

}  // namespace

TEST_CASE("Between kinds of contact the transmission error is continuous, and its slope where the point does not jump", "[core][contact]") {
  constexpr double kRoundOff = 1e-14;      // rad: two angles
  constexpr double kSlopeRoundOff = 1e-8;  // a maximum known to about 1e-6 mm, times the change of slope with its position
  constexpr double kSamePlace = 1e-3;      // mm
  std::set<std::string> seen;
  struct Case {
    double beta, crossing, end_relief, lead_crown, profile_crown;  // deg, arcmin, mm
  };
  // The wheel is the narrower of the two: it ends inside the pinion's face.
  for (const Case& c : {Case{0.0, 0.0, 0.0, 0.0, 0.0}, Case{0.0, 3.0, 0.0, 0.0, 0.0}, Case{0.0, 0.0, 0.0, 0.010, 0.0},
                        Case{20.0, 2.0, 0.0, 0.010, 0.010}, Case{20.0, -4.0, 0.020, 0.0, 0.0}, Case{12.0, 6.0, 0.0, 0.004, 0.0},
                        Case{20.0, 10.0, 0.0, 0.0, 0.0}, Case{20.0, -10.0, 0.0, 0.0, 0.015}, Case{8.0, 8.0, 0.0, 0.0, 0.005}}) {
    const GearPair pair = make_gear_pair(pair_data(24, 47, c.beta * deg, 0.1, 0.0, 32.0, 30.0));
    Modification pinion, wheel;
    pinion.lead_crowning = c.lead_crown;
    pinion.addendum_crowning = pinion.dedendum_crowning = c.profile_crown;
    wheel.end_relief = {c.end_relief, c.end_relief > 0.0 ? 4.0 : 0.0};
    Misalignment misalignment;
    misalignment.crossing = c.crossing * arcmin;
    const FlankAssembly scene = scene_of(pair, misalignment, pinion, wheel);
    const ToothContactSolver solver(scene);
    const double reach = 0.6 * (pair.total_contact_ratio() + 0.5) * 2 * pi / scene.pinion_teeth;
    constexpr int kSteps = 120;
    ToothContact last = solver.find(0, -reach);
    for (int i = 1; i <= kSteps; ++i) {
      const ToothContact next = solver.find(0, reach * (2.0 * i / kSteps - 1.0));
      if (last.exists() && next.exists() && last.kind != next.kind) {
        const Transition t = locate(solver, last, next);
        const std::string kinds = std::string(to_string(t.before.kind)).append(" to ").append(to_string(t.after.kind));
        seen.insert(kinds);
        const double jump = std::hypot(t.after.pinion_z - t.before.pinion_z, t.after.pinion_radius - t.before.pinion_radius);
        CAPTURE(c.beta, c.crossing, kinds, t.before.phi1, jump, t.before.slope, t.after.slope);
        const double step = t.after.phi1 - t.before.phi1;
        CHECK(std::abs(t.after.transmission_error - t.before.transmission_error) <=
              kRoundOff + step * std::max(std::abs(t.before.slope), std::abs(t.after.slope)));
        // The higher of two maxima takes over where the point jumps: the slope rises.
        if (jump <= kSamePlace)
          CHECK(std::abs(t.after.slope - t.before.slope) <= kSlopeRoundOff);
        else
          CHECK(t.after.slope >= t.before.slope - kSlopeRoundOff);
        // Both sides' slopes are those of differences away from the transition.
        constexpr double kStep = 1e-6;
        const ToothContact earlier = solver.find(0, t.before.phi1 - kStep), later = solver.find(0, t.after.phi1 + kStep);
        const double ahead = (later.transmission_error - t.after.transmission_error) / kStep;
        const double behind = (t.before.transmission_error - earlier.transmission_error) / kStep;
        constexpr double kDifferences = 1e-4;  // curvature of the transmission error times the step, and round-off
        CHECK(std::abs(behind - t.before.slope) <= kDifferences);
        CHECK(std::abs(ahead - t.after.slope) <= kDifferences);
      }
      last = next;
    }
  }
  for (const char* kinds : {"wheel_tip to surface", "surface to pinion_tip", "wheel_tip to line", "line to pinion_tip", "wheel_tip to corner",
                            "corner to face_end", "face_end to corner", "corner to pinion_tip", "face_end to surface"}) {
    CAPTURE(kinds);
    CHECK(seen.count(kinds) == 1);
  }
}
