#include "core/contact/gap/surface_gap.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/contact/gap/plane_of_action_gap.hpp"
#include "tests/core/contact/wild_cases.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;
using units::deg;
using units::pi;
using units::um;

namespace {

std::vector<GearPair> pairs() {
  PairData left = pair_data(23, 57, 25 * deg, 0.3, -0.1, 40.0, 50.0);
  left.working_flank = WorkingFlank::Left;
  return {make_gear_pair(pair_data(20, 40, 0.0)), make_gear_pair(pair_data(27, 43, 15 * deg)), make_gear_pair(left),
          make_gear_pair(reference::nasa_tm_107451::pair_data())};
}

std::vector<ContactPoint> points_of(const GearPair& pair, double line_phase, int intervals = 7) {
  const double b = 0.5 * pair.face_width;
  return contact_points(pair, PathOfContact(pair), {QuadratureRule::Gauss2, intervals}, line_phase, true, -b, b);
}

FlankCondition misaligned_by(const Misalignment& misalignment) {
  FlankCondition condition;
  condition.misalignment = misalignment;
  return condition;
}

FlankAssembly scene_of(const GearPair& pair, const FlankCondition& c) { return assemble_flanks(pair, c); }

/// A condition that a designer might meet, all kinds of modification, error and misalignment in it.
FlankCondition random_condition(Random& random, const GearPair& pair) {
  FlankCondition c;
  c.modification.pinion = random_modification(random, pair.pinion);
  c.modification.wheel = random_modification(random, pair.wheel);
  if (random.coin()) c.modification.pinion.parabolic_te = random(0.0, 5e-4);
  if (random.coin()) c.modification.wheel.parabolic_te = random(0.0, 5e-4);
  c.error.pinion.pitch_step = random(-5 * um, 5 * um);
  c.error.wheel.helix_slope = random(-8 * um, 8 * um);
  c.misalignment = random_misalignment(random);
  return c;
}

GearPair random_pair(Random& random) {
  while (true) {
    const PairData data = random_pair_data(random);
    if (find_problems(data).empty()) return make_gear_pair(data);
  }
}

}  // namespace

TEST_CASE("Aligned flanks are nearest where the plane of action has them", "[core][contact][closed-form]") {
  constexpr double kRoundOff = 1e-12;  // mm: of wheel angles of up to 1 rad times r_b2
  constexpr double kPlace = 1e-7;      // mm: of a maximum, whose place is known to the root of round-off
  for (const GearPair& pair : pairs()) {
    const PathOfContact path(pair);
    const SurfaceGap surfaces(pair, {});
    const double cos_base_helix = std::cos(pair.base_helix_angle);
    int inside = 0, before = 0, beyond = 0;
    for (double phase = 0.03; phase < 1.0; phase += 0.097) {
      const std::vector<ContactPoint> points = points_of(pair, phase);
      const Gap gap = surfaces.at(points, phase);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const ContactPoint& point = points[i];
        const double rho = path.roll_at(point.phase), g = gap.total[static_cast<Eigen::Index>(i)];
        CAPTURE(pair.data.pinion.teeth, point.tooth, point.z, point.phase, point.clearance, g);
        if (rho >= pair.path_start) {
          CHECK(std::abs(g - point.clearance) <= kRoundOff);
          CHECK(std::abs(gap.nearest[i].pinion_radius - point.pinion_radius) <= kPlace);
          CHECK(std::abs(gap.nearest[i].wheel_radius - point.wheel_radius) <= kPlace);
          ++(rho <= pair.path_end ? inside : beyond);
        } else {
          // The same meeting of the wheel's tip and the pinion's flank, with the pinion turned on by the clearance.
          const double later = phase + point.clearance / cos_base_helix / path.base_pitch;
          CHECK(std::abs(surfaces.at({point}, later).total[0] - point.clearance) <= kRoundOff);
          ++before;
        }
      }
    }
    CHECK(std::min({inside, before, beyond}) >= 10);
  }
}

TEST_CASE("In the section of first contact the gap is the unloaded transmission error, whatever the misalignment", "[core][contact][independent]") {
  constexpr double kRoundOff = 1e-11;  // mm, as above; on kinks of the places too
  Random random(20);
  int touching = 0;
  for (int i = 0; i < 40; ++i) {
    const GearPair pair = random_pair(random);
    const FlankCondition condition = random_condition(random, pair);
    const FlankAssembly scene = scene_of(pair, condition);
    const SurfaceGap surfaces(pair, condition);
    const double scale = pair.wheel.base_radius * std::cos(pair.base_helix_angle);
    const PathOfContact path(pair);
    const double phi1 = random(-0.5, 0.5) * 2 * pi / pair.data.pinion.teeth, phase = path.line_phase_at(phi1, pair);
    for (int tooth = -2; tooth <= 2; ++tooth) {
      const ToothContact contact = find_tooth_contact(scene, tooth, phi1);
      if (!contact.exists()) continue;
      ContactPoint point;
      point.tooth = tooth;
      point.z = contact.pinion_z;
      point.pinion_radius = contact.pinion_radius;
      const Gap gap = surfaces.at({point}, phase);
      CAPTURE(i, tooth, to_string(contact.kind), contact.pinion_radius, contact.pinion_z);
      CHECK(std::abs(gap.total[0] + contact.transmission_error * scale) <= kRoundOff);
      ++touching;
      // Nowhere else is it smaller.
      for (const ContactPoint& other : points_of(pair, phase, 3)) {
        if (other.tooth == tooth) CHECK(surfaces.at({other}, phase).total[0] >= gap.total[0] - kRoundOff);
      }
    }
  }
  CHECK(touching >= 100);
}

TEST_CASE("A misaligned pair's gap leaves that of the plane of action with the square of the misalignment", "[core][contact][independent]") {
  using Case = std::pair<std::string, Misalignment>;
  const auto [name, misalignment] = GENERATE(values<Case>({{"crossing", {.crossing = 8 * arcmin}},
                                                           {"intersecting", {.intersecting = 8 * arcmin}},
                                                           {"pinion_lead_angle", {.pinion_lead_angle = 8 * arcmin}},
                                                           {"pinion_pressure_angle", {.pinion_pressure_angle = 8 * arcmin}}}));
  const GearPair pair = make_gear_pair(pair_data(27, 43, 15 * deg));
  // Points away from A and E, where contact would run off the path.
  std::vector<ContactPoint> inner;
  const PathOfContact path(pair);
  constexpr double kPhase = 0.37;
  for (const ContactPoint& point : points_of(pair, kPhase)) {
    const double rho = path.roll_at(point.phase);
    if (rho > pair.path_start + 1.0 && rho < pair.path_end - 1.0) inner.push_back(point);
  }
  REQUIRE(inner.size() >= 10);
  const auto difference = [&](double size) {
    Misalignment m;
    for (double Misalignment::*part : {&Misalignment::crossing, &Misalignment::intersecting, &Misalignment::centre_distance,
                                       &Misalignment::pinion_lead_angle, &Misalignment::pinion_pressure_angle}) {
      m.*part = size * misalignment.*part;
    }
    const FlankCondition condition = misaligned_by(m);
    return Eigen::VectorXd(SurfaceGap(pair, condition).at(inner, kPhase).total - plane_of_action_gap(pair, inner, condition).total);
  };
  const Eigen::VectorXd whole = difference(1.0), half = difference(0.5), opposite = difference(-0.5);
  CAPTURE(name, whole.cwiseAbs().maxCoeff() / um);
  CHECK(whole.cwiseAbs().maxCoeff() > 0.005 * um);  // there is something to compare, far above round-off
  CHECK(whole.cwiseAbs().maxCoeff() < 2.0 * um);    // model: (8')^2 on lengths below 100 mm
  // discretisation: the third order, a share of the size of the misalignment over the gears' own
  const double third_order = 0.06 * whole.cwiseAbs().maxCoeff();
  CHECK((whole - 4.0 * half).cwiseAbs().maxCoeff() <= third_order);
  CHECK((half - opposite).cwiseAbs().maxCoeff() <= third_order);
}

TEST_CASE("Involutes at another centre distance have the same gap everywhere", "[core][contact][independent]") {
  const GearPair pair = make_gear_pair(pair_data(27, 43, 15 * deg));
  const double apart = GENERATE(-0.05, 0.04, 0.5);
  constexpr double kRoundOff = 1e-10;  // of angles below 1 times radii of 100 mm, through both searches
  Misalignment m;
  m.centre_distance = apart;
  const FlankCondition condition = misaligned_by(m);
  std::vector<ContactPoint> inner;
  const PathOfContact path(pair);
  constexpr double kPhase = 0.37;
  for (const ContactPoint& point : points_of(pair, kPhase)) {
    const double rho = path.roll_at(point.phase);
    if (rho > pair.path_start + 1.0 + 3.0 * std::abs(apart) && rho < pair.path_end - 1.0 - 3.0 * std::abs(apart)) inner.push_back(point);
  }
  REQUIRE(inner.size() >= 10);
  const Eigen::VectorXd plane = plane_of_action_gap(pair, inner, condition).total, whole = SurfaceGap(pair, condition).at(inner, kPhase).total;
  CAPTURE(apart, plane.transpose() / um, whole.transpose() / um);
  // model: third order of the displacement over the sum of the radii of curvature, a sin(alpha)
  const double sum_of_radii = pair.centre_distance * std::sin(pair.working_transverse_pressure_angle);
  const double third_order = std::abs(apart) * std::pow(apart / sum_of_radii, 2);
  CHECK((plane - whole).cwiseAbs().maxCoeff() <= third_order + kRoundOff);
  CHECK(plane.maxCoeff() - plane.minCoeff() <= third_order + kRoundOff);  // they stay conjugate
}

TEST_CASE("Flanks modified along the profile are nearer than where undisturbed ones would touch, by the parabola of both", "[core][contact]") {
  // Contact slides to where less is removed: by slope^2/(2 kappa) with the slope of what is removed and the relative curvature.
  const GearPair pair = make_gear_pair(pair_data(20, 40, 0.0));
  const PathOfContact path(pair);
  FlankCondition condition;
  condition.modification.pinion.profile_slope = 10 * um;
  constexpr double kPhase = 0.8;
  std::vector<ContactPoint> inner;
  for (const ContactPoint& point : points_of(pair, kPhase, 1)) {
    const double rho = path.roll_at(point.phase);
    if (rho > pair.path_start + 1.0 && rho < pair.path_end - 1.0) inner.push_back(point);
  }
  REQUIRE(!inner.empty());
  const Gap surface = SurfaceGap(pair, condition).at(inner, kPhase), plane = plane_of_action_gap(pair, inner, condition);
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const Eigen::Index k = static_cast<Eigen::Index>(i);
    const double rho1 = path.roll_at(inner[i].phase), rho2 = pair.path_length - rho1;
    // D = C (r - r_w)/h: over the arc ds = (rho/r_b) drho, r dr = rho drho, that is C/h r_b/r.
    const double height = pair.pinion.tip_radius - pair.pinion.active_root_radius;
    const double slope = 10 * um / height * pair.pinion.base_radius / inner[i].pinion_radius;
    const double gain = slope * slope / (2.0 * (1.0 / rho1 + 1.0 / rho2));
    const double undisturbed = 10 * um / height * (inner[i].pinion_radius - pair.pinion.working_pitch_radius);
    // model: third order, as slope/(kappa rho) to the gain itself
    const double third_order = 3.0 * slope * gain * (1.0 + rho1 / rho2);
    CHECK(std::abs(undisturbed - surface.total[k] - gain) <= third_order);
    CHECK(std::abs(plane.total[k] - surface.total[k]) <= third_order);
    CHECK(gain > 1e-5 * um);
  }
}

TEST_CASE("The gap's derivative over the whole flanks agrees with central differences", "[core][contact]") {
  constexpr double kStep = 2e-6;  // mm; 1/rad for the parabola, times 1e-2
  Random random(7);
  double largest = 0.0;
  int compared = 0, on_edges = 0;
  for (int i = 0; i < 4; ++i) {
    const GearPair pair = random_pair(random);
    FlankCondition condition = random_condition(random, pair);
    // Extents to vary on every flank.
    for (Member m : {Member::Pinion, Member::Wheel}) {
      Modification& to = condition.modification[m];
      const double height = pair[m].tip_radius - pair[m].active_root_radius;
      to.tip_relief = {15 * um, 0.31 * height, random.coin() ? ReliefShape::Linear : ReliefShape::Parabolic};
      to.root_relief = {10 * um, 0.23 * height, ReliefShape::Parabolic};
      to.end_relief = {8 * um, 0.17 * pair[m].data.face_width};
      to.triangular_tip_relief.height = to.triangular_root_relief.height = 0.2 * height;
      if (i == 2) to.process.kind = GrindingKind::GeneratingGrinding;
      if (i == 3) to.process.kind = GrindingKind::FormGrinding;
    }
    const double phase = random(0.0, 1.0);
    const std::vector<ContactPoint> points = points_of(pair, phase, 3);
    const SurfaceGap here(pair, condition);
    const Gap gap = here.at(points, phase);
    for (Member m : {Member::Pinion, Member::Wheel}) {
      for (const ModificationDescriptor& p : modification_parameters) {
        if (p.needs_helix && pair.data.helix_angle == 0.0) continue;
        const double step = p.parameter == parameter_of("parabolic_te") ? 1e-2 * kStep : kStep;
        const auto moved = [&](double by) {
          FlankCondition c = condition;
          Modification& modification = c.modification[m];
          if (p.parameter == parameter_of("profile_crowning")) {
            modification.addendum_crowning += by;
            modification.dedendum_crowning += by;
          } else {
            set(modification, p.parameter, get(modification, p.parameter) + by);
          }
          return Eigen::VectorXd(SurfaceGap(pair, c).at(points, phase).total);
        };
        const Eigen::VectorXd ahead = (moved(step) - gap.total) / step, behind = (gap.total - moved(-step)) / step;
        const Eigen::VectorXd exact = here.derivative(points, gap, m, p.parameter);
        for (Eigen::Index k = 0; k < exact.size(); ++k) {
          // Between both one-sided slopes: a derivative that jumps (the start of a relief) is one or a mean of them. discretisation: their
          // distance, which is the step times the second derivative, and round-off over the step
          const double kRoundOff = 2e-13 / step;
          const double lower = std::min(ahead[k], behind[k]), upper = std::max(ahead[k], behind[k]);
          const double spread = upper - lower;
          CAPTURE(i, m, std::string(p.key), k, exact[k], ahead[k], behind[k], points[static_cast<std::size_t>(k)].phase);
          CHECK(exact[k] >= lower - 0.5 * spread - kRoundOff);
          CHECK(exact[k] <= upper + 0.5 * spread + kRoundOff);
          largest = std::max(largest, std::abs(exact[k]));
          ++compared;
          if (points[static_cast<std::size_t>(k)].clearance > 0.0) ++on_edges;
        }
      }
    }
  }
  CHECK(largest > 0.5);
  CHECK(compared > 600);
  CHECK(on_edges > 60);
}

TEST_CASE("The gap is continuous through zero misalignment, and so are its points", "[core][contact]") {
  constexpr double kTiny = 1e-9;  // rad or mm
  constexpr double kRoundOff = 1e-12;
  for (const GearPair& pair : pairs()) {
    const double phase = 0.61;
    const std::vector<ContactPoint> points = points_of(pair, phase);
    const Gap aligned = SurfaceGap(pair, {}).at(points, phase);
    const std::vector<ContactPoint> aligned_places = SurfaceGap(pair, {}).place(points, phase);
    CHECK(aligned_places.size() == points.size());
    for (double Misalignment::*part : {&Misalignment::crossing, &Misalignment::intersecting, &Misalignment::centre_distance,
                                       &Misalignment::pinion_lead_angle, &Misalignment::pinion_pressure_angle, &Misalignment::mesh_misalignment}) {
      Misalignment up, down;
      up.*part = kTiny;
      down.*part = -kTiny;
      for (const Misalignment& m : {up, down}) {
        const SurfaceGap surfaces(pair, misaligned_by(m));
        // model: an angle moves no point by more than the wheel's radius or face width, and edges by three times that
        const double reach = 3.0 * (pair.wheel.tip_radius + pair.face_width) * kTiny;
        CHECK((surfaces.at(points, phase).total - aligned.total).cwiseAbs().maxCoeff() <= reach + kRoundOff);
        const std::vector<ContactPoint> places = surfaces.place(points, phase);
        REQUIRE(places.size() == points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
          // a place moves by an angle over the relative curvature, radii of which are below 1000 mm here
          CHECK(std::abs(places[i].pinion_radius - aligned_places[i].pinion_radius) <= 1000.0 * reach + 1e-7);
        }
      }
    }
  }
}

TEST_CASE("Extreme random flanks have a finite gap, finite derivatives and points on both flanks", "[core][contact][random]") {
  Random random(99);
  int points_seen = 0;
  for (int i = 0; i < 60; ++i) {
    const PairData data = wild_pair_data(random);
    if (!find_problems(data).empty()) continue;
    const GearPair pair = make_gear_pair(data);
    FlankCondition condition;
    condition.misalignment = wild_misalignment(random, data.normal_module);
    condition.misalignment.axial_offset = 0.0;
    condition.modification.pinion = wild_modification(random, pair, pair.pinion);
    condition.modification.wheel = wild_modification(random, pair, pair.wheel);
    const double phase = random(0.0, 1.0);
    CHECK_NOTHROW(SurfaceGap(pair, {}));
    std::optional<SurfaceGap> unmodified, modified;
    try {
      unmodified.emplace(pair, misaligned_by(condition.misalignment));
      modified.emplace(pair, condition);
    } catch (const InvalidInput&) {
      continue;  // an error or a parabola that leaves no usable flank
    }
    const std::vector<ContactPoint> places = unmodified->place(points_of(pair, phase, 3), phase);
    const Gap gap = modified->at(places, phase);
    CAPTURE(i, data.pinion.teeth, data.wheel.teeth);
    CHECK(gap.total.allFinite());
    for (Member m : {Member::Pinion, Member::Wheel}) {
      for (const ModificationDescriptor& p : modification_parameters) {
        // The amount of a relief without extent has no derivative.
        const Modification& given = condition.modification[m];
        if (!p.extent.empty() && find_parameter(p.extent)->get(given) == 0.0) continue;
        CAPTURE(std::string(p.key));
        CHECK(modified->derivative(places, gap, m, p.parameter).allFinite());
      }
    }
    for (const ContactPoint& place : places) {
      constexpr double kRoundOff = 1e-6;  // mm: places on a circle of the wheel are found to 1e-7 mm
      CHECK(place.relative_radius > 0.0);
      CHECK(std::isfinite(place.pinion_depth + place.wheel_depth + place.pinion_tip_distance + place.wheel_tip_distance));
      CHECK(place.pinion_radius <= pair.pinion.tip_radius + kRoundOff);
      CHECK(place.wheel_radius <= pair.wheel.tip_radius + kRoundOff);
      CHECK(place.pinion_radius >= pair.pinion.form_radius - kRoundOff);
      CHECK(place.wheel_radius >= pair.wheel.form_radius - kRoundOff);
      ++points_seen;
    }
  }
  CHECK(points_seen > 300);
}
