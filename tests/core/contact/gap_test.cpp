#include "core/contact/gap/plane_of_action_gap.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <string>

#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;
using units::deg;
using units::pi;
using units::um;

namespace {

constexpr int fine_intervals = 600;

struct Comparison {
  double gap, contact;  ///< smallest gap; the same from unloaded contact, normal to the flank [mm]
};

/// The smallest gap over all teeth and what the first contact says of it: the wheel turns back by the smallest gap.
Comparison compare(const GearPair& pair, const FlankCondition& condition, double phi1) {
  const FlankAssembly scene = assemble_flanks(pair, condition);
  double te = -INFINITY;
  for (int tooth = -5; tooth <= 5; ++tooth) {
    const ToothContact contact = find_tooth_contact(scene, tooth, phi1);
    if (contact.exists()) te = std::max(te, contact.transmission_error);
  }
  const PathOfContact path(pair);
  const double b = 0.5 * pair.face_width;
  const std::vector<ContactPoint> points =
      contact_points(pair, path, {QuadratureRule::Midpoint, fine_intervals}, path.line_phase_at(phi1, pair), true, -b, b);
  return {plane_of_action_gap(pair, points, condition).total.minCoeff(), -te * pair.wheel.base_radius * std::cos(pair.base_helix_angle)};
}

std::vector<GearPair> pairs() {
  PairData left = pair_data(23, 57, 25 * deg, 0.3, -0.1, 40.0, 50.0);
  left.working_flank = WorkingFlank::Left;
  return {make_gear_pair(reference::nasa_tm_107451::pair_data()), make_gear_pair(pair_data(20, 40, 0.0)),
          make_gear_pair(pair_data(23, 57, 15 * deg, 0.3, -0.1, 40.0, 30.0)), make_gear_pair(left)};
}

}  // namespace

TEST_CASE("The smallest gap in the plane of action is the unloaded transmission error, to first order in any misalignment",
          "[core][contact][independent]") {
  const double size = GENERATE(1.0, -1.0, 0.1);
  const std::vector<std::pair<std::string, std::function<void(Misalignment&)>>> misalignments{
      {"crossing", [&](Misalignment& m) { m.crossing = size * 2 * arcmin; }},
      {"intersecting", [&](Misalignment& m) { m.intersecting = size * 2 * arcmin; }},
      {"pinion_lead_angle", [&](Misalignment& m) { m.pinion_lead_angle = size * 2 * arcmin; }},
      {"pinion_pressure_angle", [&](Misalignment& m) { m.pinion_pressure_angle = size * 2 * arcmin; }},
      {"mesh_misalignment", [&](Misalignment& m) { m.mesh_misalignment = size * 20 * um; }},
      {"centre_distance", [&](Misalignment& m) { m.centre_distance = size * 0.02; }},
      {"axial_offset", [&](Misalignment& m) { m.axial_offset = size * 0.05; }}};
  // model: second order, (2')^2 = 3.4e-7 on lengths below 100 mm, and 0.02^2/(a sin(alpha)) for the centre distance
  const double kModel = 3e-5 * size * size;  // mm
  for (const GearPair& pair : pairs()) {
    for (const auto& [name, apply] : misalignments) {
      FlankCondition condition;
      apply(condition.misalignment);
      for (const double turn : {-0.4, -0.1, 0.3}) {
        const Comparison c = compare(pair, condition, turn * 2 * pi / pair.data.pinion.teeth);
        CAPTURE(name, size, pair.data.pinion.teeth, turn, c.gap, c.contact);
        // discretisation: the last point lies half an interval from the end, and the gap slopes along z by no more
        // than 1.2 times the angles of 2' (F_beta_y: 20 um over 30 mm, about as much)
        const double kDiscretisation = 1.2 * std::abs(size) * 2.4 * arcmin * 0.5 * pair.face_width / fine_intervals;
        CHECK(std::abs(c.gap - c.contact) <= kModel + kDiscretisation);
      }
    }
  }
}

TEST_CASE("The smallest gap of modified flanks is the unloaded transmission error, to first order in the amounts", "[core][contact][independent]") {
  FlankCondition condition;
  condition.modification.pinion.lead_crowning = 12 * um;
  condition.modification.pinion.tip_relief = {25 * um, 1.2, ReliefShape::Linear};
  condition.modification.pinion.twist = 5 * um;
  condition.modification.wheel.addendum_crowning = 6 * um;
  condition.modification.wheel.end_relief = {10 * um, 5.0};
  condition.modification.wheel.profile_slope = -4 * um;
  condition.error.wheel.helix_slope = 8 * um;
  condition.error.pinion.profile_slope = 5 * um;
  condition.misalignment.crossing = 0.5 * arcmin;
  condition.misalignment.axial_offset = 0.3;
  for (const GearPair& pair : pairs()) {
    for (const double turn : {-0.4, -0.1, 0.3}) {
      const Comparison c = compare(pair, condition, turn * 2 * pi / pair.data.pinion.teeth);
      CAPTURE(pair.data.pinion.teeth, turn, c.gap, c.contact);
      // model: contact slides off the plane of action, gaining slope^2/(2 k) with slopes below 1 um/mm in the path's
      // middle and k of about 0.01/mm; nothing is lost, so the first contact is never later
      CHECK(c.gap - c.contact <= 0.1 * um);
      CHECK(c.contact - c.gap <= 0.02 * um);
    }
  }
}

TEST_CASE("Each of two gears and both sides of a ledger make the same gap", "[core][contact]") {
  const GearPair pair = make_gear_pair(pair_data(23, 46, 15 * deg));
  const PathOfContact path(pair);
  const std::vector<ContactPoint> points = contact_points(pair, path, {}, 1.4, true, -path.half_face, path.half_face);
  const double cos_b = std::cos(pair.base_helix_angle);
  FlankCondition removed, added;
  removed.modification.pinion.lead_slope = removed.modification.wheel.lead_slope = 6 * um;
  added.error.pinion.helix_slope = added.error.wheel.helix_slope = -6 * um;
  added.error.pinion.pitch_step = 2 * um;
  const Gap none = plane_of_action_gap(pair, points, {}), a = plane_of_action_gap(pair, points, removed);
  const Gap b = plane_of_action_gap(pair, points, added);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Index k = static_cast<Eigen::Index>(i);
    CHECK(std::abs(none.total[k] - points[i].clearance) <= 1e-15);
    CHECK(std::abs(none.error[k]) <= 1e-15);
    CHECK(std::abs(a.total[k] - points[i].clearance - cos_b * 2 * 6 * um * points[i].z / pair.face_width) <= 1e-15);
    CHECK(std::abs(b.total[k] - a.total[k] + cos_b * 2 * um * points[i].tooth) <= 1e-15);
    CHECK(std::abs(b.total[k] + b.error[k] - points[i].clearance) <= 1e-15);
  }
}

TEST_CASE("Every tooth pair in mesh has the errors of its own two teeth", "[core][contact]") {
  const GearPair pair = make_gear_pair(pair_data(23, 46, 15 * deg));
  const PathOfContact path(pair);
  const std::vector<ContactPoint> points = contact_points(pair, path, {}, 1.4, true, -path.half_face, path.half_face);
  FlankCondition listed;
  listed.error.pinion.helix_slopes.resize(23);
  listed.error.wheel.profile_slopes.resize(46);
  listed.error.wheel.twists.resize(46);
  const auto slope = [](int tooth) { return (2.0 + 3 * tooth) * um; };
  for (int tooth = -2; tooth < 4; ++tooth) {
    listed.error.pinion.helix_slopes[static_cast<std::size_t>((tooth + 23) % 23)] = slope(tooth);
    listed.error.wheel.profile_slopes[static_cast<std::size_t>((tooth + 46) % 46)] = 0.5 * slope(tooth);
    listed.error.wheel.twists[static_cast<std::size_t>((tooth + 46) % 46)] = -slope(tooth);
  }
  const Gap gap = plane_of_action_gap(pair, points, listed);
  int teeth = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int tooth = points[i].tooth;
    if (i == 0 || tooth != points[i - 1].tooth) ++teeth;
    FlankCondition alike;  // all teeth as this pair's
    alike.error.pinion.helix_slope = slope(tooth);
    alike.error.wheel.profile_slope = 0.5 * slope(tooth);
    alike.error.wheel.twist = -slope(tooth);
    const Eigen::Index k = static_cast<Eigen::Index>(i);
    CHECK(std::abs(gap.total[k] - plane_of_action_gap(pair, points, alike).total[k]) <= 1e-15);
  }
  CHECK(teeth >= 3);
}

TEST_CASE("Errors of single teeth make the same unloaded contact as gap, to first order", "[core][contact][independent]") {
  /// A crown of 8 um over 20 mm either way and a slope in roll length.
  struct Crown final : DeviationField {
    Jet at(double rho, double z) const override {
      const double c = 8 * um / 400, k = 0.2 * um;
      return {c * z * z + k * rho, k, 2 * c * z, 0.0, 0.0, 2 * c};
    }
  };
  const GearPair pair = make_gear_pair(pair_data(23, 57, 15 * deg, 0.3, -0.1, 40.0, 30.0));
  FlankCondition condition;
  condition.modification.pinion.lead_crowning = 6 * um;  // contact stays off the face ends
  condition.error.pinion.helix_slopes.resize(23);
  condition.error.wheel.cumulative_pitch.resize(57);
  condition.error.wheel.topographies.resize(57);
  for (const int tooth : {-1, 0, 1, 2}) {
    condition.error.pinion.helix_slopes[static_cast<std::size_t>((tooth + 23) % 23)] = 4 * tooth * um;
    condition.error.wheel.cumulative_pitch[static_cast<std::size_t>((tooth + 57) % 57)] = (tooth % 2 == 0 ? 3 : -2) * um;
  }
  condition.error.wheel.topographies[1] = condition.error.wheel.topographies[56] = std::make_shared<Crown>();
  for (const double turn : {-0.4, -0.2, 0.0, 0.2, 0.4}) {
    const Comparison c = compare(pair, condition, turn * 2 * pi / pair.data.pinion.teeth);
    CAPTURE(turn, c.gap, c.contact);
    // model: as above
    CHECK(c.gap - c.contact <= 0.1 * um);
    CHECK(c.contact - c.gap <= 0.02 * um);
  }
}

TEST_CASE("The gap's derivative for every parameter agrees with central differences", "[core][contact]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GrindingKind process = GENERATE(GrindingKind::None, GrindingKind::GeneratingGrinding, GrindingKind::FormGrinding);
  const GearPair pair = make_gear_pair(pair_data(23, 46, 15 * deg, 0.2));
  const PathOfContact path(pair);
  const std::vector<ContactPoint> points = contact_points(pair, path, {QuadratureRule::Gauss2, 7}, 1.37, true, -path.half_face, path.half_face);
  REQUIRE(points.size() >= 14);
  FlankCondition condition;
  for (Modification* m : {&condition.modification.pinion, &condition.modification.wheel}) {
    m->lead_crowning = 8 * um;
    m->lead_slope = -5 * um;
    m->addendum_crowning = m->dedendum_crowning = 6 * um;
    m->profile_slope = 3 * um;
    m->tip_relief = {20 * um, 1.53, ReliefShape::Parabolic};
    m->root_relief = {15 * um, 1.13, ReliefShape::Linear};
    m->end_relief = {10 * um, 5.1};
    m->triangular_tip_relief = {9 * um, 4.2, ReliefShape::Parabolic};  // high enough for the lines of this phase
    m->triangular_root_relief = {8 * um, 3.9, ReliefShape::Parabolic};
    m->twist = 7 * um;
    m->process.kind = process;
  }
  condition.misalignment.axial_offset = 0.4;
  condition.misalignment.crossing = 1 * arcmin;
  constexpr double kStep = 1e-6;  // mm
  constexpr double kDiscretisation =
      1e-8;  // third derivative by the parameter (touches move) times step^2, most of shapes of order 4; round-off/step
  for (const ModificationDescriptor& p : modification_parameters) {
    FlankCondition up = condition, down = condition;
    const auto side = [member](FlankCondition& c) -> Modification& { return c.modification[member]; };
    const double value = get(side(condition), p.parameter);
    set(side(up), p.parameter, value + kStep);
    set(side(down), p.parameter, value - kStep);
    const Eigen::VectorXd difference = (plane_of_action_gap(pair, points, up).total - plane_of_action_gap(pair, points, down).total) / (2 * kStep);
    const Eigen::VectorXd exact = gap_derivative(points, plane_of_action_gap(pair, points, condition), {pair, condition, member, p.parameter});
    CAPTURE(std::string(p.key));
    CHECK((exact - difference).lpNorm<Eigen::Infinity>() <= kDiscretisation);
    CHECK(exact.lpNorm<Eigen::Infinity>() > 0.0);
  }
}
