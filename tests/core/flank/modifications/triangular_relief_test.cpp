#include "core/flank/modifications/triangular_relief.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/contact/path/path_of_contact.hpp"
#include "core/flank/removal.hpp"
#include "tests/core/flank/sample_flank_frame.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

GearPair helical_pair(Hand hand, WorkingFlank flank) {
  PairData data;
  data.normal_module = 4.0;
  data.helix_angle = 18 * units::deg;
  data.pinion.teeth = 21;
  data.wheel.teeth = 40;
  data.pinion.face_width = data.wheel.face_width = 30.0;
  data.pinion_hand = hand;
  data.working_flank = flank;
  return make_gear_pair(data);
}

double radius_at(const Gear& gear, double roll) { return std::hypot(gear.base_radius, roll); }

}  // namespace

TEST_CASE("A triangular relief removes the same all along a line of contact, and most where the lines leave", "[core][flank][closed-form]") {
  const Hand hand = GENERATE(Hand::Right, Hand::Left);
  const WorkingFlank flank = GENERATE(WorkingFlank::Right, WorkingFlank::Left);
  const GearPair pair = helical_pair(hand, flank);
  const PathOfContact path(pair);
  const double both_rolls = pair.centre_distance * std::sin(pair.working_transverse_pressure_angle);
  Modification m;
  m.triangular_tip_relief = {0.020, 1.5, ReliefShape::Parabolic};
  m.triangular_root_relief = {0.012, 1.0, ReliefShape::Linear};
  const FlankFrame pinion = pair.flank_frame(Member::Pinion), wheel = pair.flank_frame(Member::Wheel);
  int lines_with_removal = 0;
  double last_pinion_tip = -1.0, first_wheel_tip = -1.0;  // z of the point at the tip corner
  for (double line = path.before; line < path.last_line_phase() - path.beyond; line += 0.02) {
    double of_pinion = not_given, of_wheel = not_given;
    for (double z = -15.0; z <= 15.0; z += 1.0) {
      const double rho1 = path.roll_at(path.phase_at(line, z)), rho2 = both_rolls - rho1;
      if (rho1 <= 0.0 || rho2 <= 0.0) continue;
      const double r1 = radius_at(pair.pinion, rho1), r2 = radius_at(pair.wheel, rho2);
      const bool touches = r1 <= pinion.tip_radius && r2 <= wheel.tip_radius;
      if (!touches) continue;
      if (first_wheel_tip == -1.0) first_wheel_tip = z;
      last_pinion_tip = z;
      const double here1 = removal(m, pinion, r1, z), here2 = removal(m, wheel, r2, z);
      if (std::isnan(of_pinion)) {
        of_pinion = here1;
        of_wheel = here2;
      }
      CAPTURE(line, z, r1, r2);
      CHECK(here1 == tests::about(of_pinion, 1e-14));  // round-off of roll lengths of some 20 mm
      CHECK(here2 == tests::about(of_wheel, 1e-14));
    }
    lines_with_removal += of_pinion > 0.0 || of_wheel > 0.0;
  }
  CHECK(lines_with_removal > 10);
  const ContactLineCorner of_pinion(pinion, ContactLineCorner::At::Tip, 1.5), of_wheel(wheel, ContactLineCorner::At::Tip, 1.5);
  CHECK(last_pinion_tip == of_pinion.face_end());  // the last lines leave over the pinion's tip corner
  CHECK(first_wheel_tip == of_wheel.face_end());   // and the first ones enter over the wheel's
  CHECK(removal(m, pinion, pinion.tip_radius, of_pinion.face_end()) == Approx(0.020).epsilon(1e-12));
  CHECK(removal(m, pinion, pinion.tip_radius, -of_pinion.face_end()) == 0.0);
  CHECK(removal(m, pinion, pinion.active_root_radius, -of_pinion.face_end()) == Approx(0.012).epsilon(1e-12));
  CHECK(removal(m, pinion, pinion.tip_radius - 1.5, of_pinion.face_end()) == 0.0);
  // Half of the roll at the face end, half of the reach along the tip.
  const auto tip_at = [&](double from_end) {
    return removal(m, pinion, pinion.tip_radius, of_pinion.face_end() - std::copysign(from_end, of_pinion.face_end()));
  };
  CHECK(tip_at(0.5 * of_pinion.reach_along_face()) == Approx(0.25 * 0.020).epsilon(1e-10));
  CHECK(tip_at(of_pinion.reach_along_face()) == tests::about(0.0, 1e-15));
}

TEST_CASE("Both derivatives of a triangular relief are those of its value", "[core][flank]") {
  const FlankFrame frame = sample_flank_frame();
  const ReliefShape shape = GENERATE(ReliefShape::Linear, ReliefShape::Parabolic);
  Modification m;
  m.triangular_tip_relief = {0.020, 2.0, shape};
  m.triangular_root_relief = {0.015, 1.5, shape};
  const auto value = [&](double r, double z) { return removal(m, frame, r, z); };
  constexpr double step = 1e-4;  // differences are off by step^2 and by round-off over step^2: some 1e-9 and 1e-10 mm/mm^2
  for (const auto& [r, z] : {std::pair{53.5, -14.2}, std::pair{53.9, -13.0}, std::pair{47.4, 14.6}, std::pair{50.0, 0.0}}) {
    const Jet exact = DeviationFormula(m, {}, frame).at(r, z);
    CAPTURE(r, z);
    CHECK(exact.u == tests::about((value(r + step, z) - value(r - step, z)) / (2 * step), 1e-9));
    CHECK(exact.v == tests::about((value(r, z + step) - value(r, z - step)) / (2 * step), 1e-9));
    CHECK(exact.uu == tests::about((value(r + step, z) - 2 * value(r, z) + value(r - step, z)) / (step * step), 2e-8));
    CHECK(exact.vv == tests::about((value(r, z + step) - 2 * value(r, z) + value(r, z - step)) / (step * step), 2e-8));
    const double mixed = value(r + step, z + step) - value(r + step, z - step) - value(r - step, z + step) + value(r - step, z - step);
    CHECK(exact.uv == tests::about(mixed / (4 * step * step), 2e-8));
  }
  CHECK(value(53.5, -14.2) > 0.0);
  CHECK(value(47.4, 14.6) > 0.0);
  CHECK(value(53.5, 14.2) == 0.0);
}
