#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/load/cycle/contact_stress.hpp"
#include "core/load/cycle/cycle_gradient.hpp"
#include "core/load/cycle/mesh_cycle.hpp"
#include "core/load/cycle/mesh_motion.hpp"
#include "core/rating/edge_contact_start.hpp"
#include "core/rating/load_sharing.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

/// A pair with both tips rounded, by parts of the module; 0 is sharp.
GearPair rounded_pair(double helix_angle, double rounding) {
  PairData data = mesh_cases::pair_data(25, 50, helix_angle, 3, 20);
  data.pinion.tip_rounding = data.wheel.tip_rounding = rounding * data.normal_module;
  return make_gear_pair(data);
}

FlankCondition relieved(double amount) {
  FlankCondition condition;
  condition.modification.pinion.tip_relief = condition.modification.wheel.tip_relief = {amount, 0.9, ReliefShape::Linear};
  return condition;
}

constexpr double torque = 150e3;

}  // namespace

TEST_CASE("A tip rounding ends the flank where its arc touches it", "[core][gear][edge]") {
  const double rounding = GENERATE(0.05, 0.1, 0.2);
  const GearPair pair = rounded_pair(0, rounding), sharp = rounded_pair(0, 0);
  const Gear& gear = pair.pinion;
  // The circle that touches the tip circle and the involute from inside: its centre on the involute's normal, a tangent of the base circle.
  const double rho = gear.data.tip_rounding, centre = gear.tip_radius - rho;
  const double roll = rho + std::sqrt((centre - gear.base_radius) * (centre + gear.base_radius));
  const double expected = std::hypot(gear.base_radius, roll);
  const double curvature = rho * rho / gear.base_radius;  // of flank and tip circle over the arc, left out
  CHECK(gear.tip_form_radius == tests::about(expected, curvature));
  CHECK(gear.tip_edge_radius == rho);
  CHECK(pair.path_end < sharp.path_end);
  CHECK(pair.path_start > sharp.path_start);
  CHECK(sharp.pinion.tip_form_radius == sharp.pinion.tip_radius);
}

TEST_CASE("A chamfer ends the flank where the arc of its edge touches it", "[core][gear][edge]") {
  PairData data = rounded_pair(0, 0).data;
  EdgeChamfer& chamfer = data.pinion.tip_chamfer;
  chamfer = {.amount = 0.1 * data.normal_module, .angle = GENERATE(20.0, 45.0) * units::deg};
  const GearPair sharp = make_gear_pair(data);
  chamfer.radius = 0.1 * data.normal_module;
  const Gear gear = make_gear_pair(data).pinion;
  CHECK(sharp.pinion.tip_form_radius == sharp.pinion.tip_radius - chamfer.amount);
  CHECK(sharp.pinion.tip_edge_radius == 0.0);
  // The spur tooth's involute P = r_b (cos t, sin t) + q n with n = (sin t, -cos t), q = r_b t, and the flat through the point where it has the
  // corner's radius. The arc's centre is rho inside of P along n; q is sought where it is rho inside of the flat as well.
  const double rb = gear.base_radius, rho = chamfer.radius;
  const auto inside = [&](double q, double by) {
    const double t = q / rb;
    return Eigen::Vector2d(rb * std::cos(t) + (q - by) * std::sin(t), rb * std::sin(t) - (q - by) * std::cos(t));
  };
  const double corner_roll = gear.roll_length_at(sharp.pinion.tip_form_radius);
  const Eigen::Vector2d corner = inside(corner_roll, 0.0), outwards = corner.normalized(), off_flank(outwards.y(), -outwards.x());
  const Eigen::Vector2d normal = std::cos(chamfer.angle) * outwards + std::sin(chamfer.angle) * off_flank;
  double low = 0.0, high = corner_roll;
  for (int i = 0; i < 60; ++i) {
    const double q = 0.5 * (low + high);
    (normal.dot(inside(q, rho) - corner) < -rho ? low : high) = q;
  }
  CHECK(gear.tip_form_radius == tests::about(std::hypot(rb, low), rho * rho / rb));  // the flank's bend over the arc, left out
  CHECK(gear.tip_form_radius < sharp.pinion.tip_form_radius);
}

TEST_CASE("A chamfered tip touches as a shorter tooth does", "[core][gear][edge]") {
  PairData data = rounded_pair(GENERATE(0.0, 15.0), 0).data, shorter = data;
  data.pinion.tip_chamfer.amount = 0.2;
  shorter.pinion.tip_diameter = 2.0 * make_gear_pair(shorter).pinion.tip_radius - 0.4;
  const GearPair a = make_gear_pair(data), b = make_gear_pair(shorter);
  CHECK(a.path_end == Approx(b.path_end).epsilon(1e-14));
  CHECK(a.path_start == Approx(b.path_start).epsilon(1e-14));
}

TEST_CASE("A chamfer that cannot be is named with what it may be", "[core][gear][edge]") {
  const auto field_of = [](const EdgeChamfer& chamfer, double rounding = 0.0) {
    PairData data = rounded_pair(0, 0).data;
    data.wheel.tip_chamfer = chamfer;
    data.wheel.tip_rounding = rounding;
    const auto problems = find_problems(data);
    return problems.empty() ? std::string() : problems.front().field();
  };
  CHECK(field_of({.amount = 0.2}).empty());
  CHECK(field_of({.amount = 0.2, .angle = 85 * units::deg}) == "wheel.edges.tip_chamfer.angle");
  CHECK(field_of({.amount = 0.2, .angle = 5 * units::deg}) == "wheel.edges.tip_chamfer.amount");
  CHECK(field_of({.amount = 20.0}) == "wheel.edges.tip_chamfer.amount");
  CHECK(field_of({.amount = 0.2}, 0.1) == "wheel.edges.tip_chamfer.amount");
  CHECK(field_of({.radius = -1.0}) == "wheel.edges.tip_chamfer.radius");
}

TEST_CASE("Between flank and rounding clearance and edge distance run on", "[core][contact][edge]") {
  const GearPair pair = rounded_pair(GENERATE(0.0, 15.0), 0.1);
  const PathOfContact path(pair);
  constexpr double step = 1e-5;  // base pitches
  for (const double end : {path.before, path.path_end()}) {
    const double line_phase = end + std::abs(path.slope) * path.half_face;
    const auto at = [&](double by) { return *contact_point(pair, path, line_phase + by, 0, 0.0, true); };
    const ContactPoint before = at(-step), after = at(step);
    const double travel = 2.0 * step * pair.transverse_base_pitch;
    CHECK(std::abs(before.tip_edge.distance - after.tip_edge.distance) < 2.0 * travel);
    CHECK(before.tip_edge.gear == after.tip_edge.gear);
    CHECK(before.tip_edge.distance * after.tip_edge.distance < 0.0);
    CHECK(std::max(before.clearance, after.clearance) < travel * travel);
  }
}

TEST_CASE("Loads, transmission error and stresses on edges have the slopes of differences", "[core][load][edge][gradient]") {
  const double helix_angle = GENERATE(0.0, 15.0);
  const GearPair gears = rounded_pair(helix_angle, 0.1);
  // Before A, at both ends of the path and in between.
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 6}, equally_spaced_phases(16)});
  const std::vector<GearParameter> parameters{{Member::Pinion, parameter_of("tip_relief.amount")},
                                              {Member::Wheel, parameter_of("tip_relief.height")},
                                              {Member::Pinion, parameter_of("profile_crowning")},
                                              {Member::Wheel, parameter_of("profile_slope")},
                                              {Member::Pinion, parameter_of("lead_crowning")}};
  FlankCondition condition = relieved(4 * units::um);
  condition.modification.pinion.lead_crowning = 3 * units::um;
  set(condition.modification.pinion, parameter_of("profile_crowning"), 2 * units::um);
  const LoadedCycle cycle = analyse_cycle(model, condition, torque, {parameters.begin(), parameters.end()});
  REQUIRE(summarise(model, cycle).edge_stress > 0.0);
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const double step = parameters[p].parameter == parameter_of("tip_relief.height") ? 5e-6 : 5e-8;  // mm
    const LoadedCycle up = analyse_cycle(model, mesh_cases::moved(condition, parameters[p], step), torque);
    const LoadedCycle down = analyse_cycle(model, mesh_cases::moved(condition, parameters[p], -step), torque);
    for (std::size_t k = 0; k < cycle.positions.size(); ++k) {
      const LoadedPosition& at = cycle.positions[k];
      const auto column = static_cast<Eigen::Index>(p);
      // Points that gain or lose contact within a step have no two-sided slope.
      const auto loaded = [](const LoadedPosition& position) { return (position.load.line_load.array() > 0.0).eval(); };
      if ((loaded(up.positions[k]) != loaded(down.positions[k])).any()) continue;
      const auto check = [&](const Eigen::VectorXd& exact, const Eigen::VectorXd& above, const Eigen::VectorXd& below) {
        const Eigen::VectorXd difference = (above - below) / (2 * step);
        // Discretisation of the central difference, and round-off of the values over its step.
        constexpr double epsilon = 2.2e-16;
        const double tolerance = 2e-6 * difference.cwiseAbs().maxCoeff() + 64 * epsilon * above.cwiseAbs().maxCoeff() / step;
        CHECK((exact - difference).cwiseAbs().maxCoeff() <= tolerance);
      };
      CAPTURE(p, k);
      check(at.line_load_derivative.col(column), up.positions[k].load.line_load, down.positions[k].load.line_load);
      check(at.contact_stress_derivative.col(column), up.positions[k].contact_stress, down.positions[k].contact_stress);
      check(at.edge_stress_derivative.col(column), up.positions[k].edge_stress, down.positions[k].edge_stress);
      CHECK(at.tip_edge_share_derivative[column] ==
            Approx((up.positions[k].tip_edge_share - down.positions[k].tip_edge_share) / (2 * step)).epsilon(1e-6).margin(64 * 2.2e-16 / step));
      CHECK(at.transmission_error_derivative[column] ==
            Approx((up.positions[k].load.transmission_error - down.positions[k].load.transmission_error) / (2 * step)).epsilon(1e-6).margin(1e-8));
    }
  }
}

TEST_CASE("The part of the force on tip edges follows torque and axial offset as differences do", "[core][load][edge][gradient]") {
  const GearPair gears = rounded_pair(15, 0.1);
  const MeshResolution resolution{{QuadratureRule::Graded, 4}, equally_spaced_phases(8)};
  const MeshPlaced placed = [&](const MeshPlacement& placement) {
    return make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, resolution, {}, placement);
  };
  FlankCondition condition = relieved(4 * units::um);
  condition.modification.pinion.lead_slope = 6 * units::um;
  const std::vector<MeshParameter> parameters{PinionTorque{}, &Misalignment::axial_offset};
  const auto solved = [&](double further_torque, double offset, const std::vector<MeshParameter>& by) {
    condition.misalignment.axial_offset = offset;
    const MeshPlacement placement = MeshPlacement::of(GapModel::PlaneOfAction, condition.misalignment);
    const MeshModel model = with_perturbed_meshes(placed(placement), placed, by);
    return analyse_cycle(model, condition, torque + further_torque, by);
  };
  constexpr double offset = 0.7;
  const LoadedCycle cycle = solved(0.0, offset, parameters);
  int compared = 0;
  for (const Eigen::Index p : {Eigen::Index{0}, Eigen::Index{1}}) {
    const double step = p == 0 ? 1e-5 * torque : 1e-4;
    const auto moved = [&](double by) { return p == 0 ? solved(by, offset, {}) : solved(0.0, offset + by, {}); };
    const LoadedCycle up = moved(step), down = moved(-step);
    for (std::size_t k = 0; k < cycle.positions.size(); ++k) {
      const double exact = cycle.positions[k].tip_edge_share_derivative[p], share = cycle.positions[k].tip_edge_share;
      if (share == 0.0) continue;
      ++compared;
      CAPTURE(p, k, share);
      // By torque the step of the difference; by the offset that of the perturbed meshes, in parts of the share over a change that matters, 10 mm.
      CHECK(exact == Approx((up.positions[k].tip_edge_share - down.positions[k].tip_edge_share) / (2 * step))
                         .epsilon(1e-6)
                         .margin(p == 0 ? 1e-6 * share / torque : 1e-5 * share / 10));
    }
  }
  CHECK(compared >= 8);
}

TEST_CASE("The crest of pressure on a tip edge is found between the points of a wide face", "[core][load][edge]") {
  PairData data = mesh_cases::pair_data(23, 94, 12, 8, 230);
  data.pinion.tip_rounding = data.wheel.tip_rounding = 0.05 * data.normal_module;
  const GearPair gears = make_gear_pair(data);
  FlankCondition condition;
  condition.modification.pinion.tip_relief = condition.modification.wheel.tip_relief = {GENERATE(30.0, 55.0) * units::um, 4.0, ReliefShape::Linear};
  condition.misalignment.mesh_misalignment = 20 * units::um;
  const auto stress = [&](int intervals) {
    const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, intervals}, equally_spaced_phases(16)});
    return summarise(model, analyse_cycle(model, condition, 18e6)).edge_stress;
  };
  const double fine = stress(48);
  REQUIRE(fine > 0.0);
  CHECK(stress(12) == Approx(fine).epsilon(0.02));  // discretisation
}

TEST_CASE("With enough relief edges carry nothing and change nothing", "[core][load][edge]") {
  const GearPair gears = rounded_pair(0, 0.1);
  const MeshResolution resolution{{QuadratureRule::Graded, 4}, equally_spaced_phases(24)};
  const FlankCondition condition = relieved(60 * units::um);
  const MeshModel with = mesh_cases::model(gears, resolution), without = mesh_cases::model(gears, resolution, MeshEffects::all_but({"edge_contact"}));
  const LoadedCycle on = analyse_cycle(with, condition, torque), off = analyse_cycle(without, condition, torque);
  CHECK(summarise(with, on).edge_stress == 0.0);
  CHECK(summarise(with, on).tip_edge_share == 0.0);
  CHECK(std::isnan(summarise(without, off).edge_stress));
  CHECK(std::isnan(summarise(without, off).tip_edge_share));
  for (std::size_t k = 0; k < on.positions.size(); ++k) CHECK(on.positions[k].load.line_load == off.positions[k].load.line_load);
}

TEST_CASE("Without relief edges carry the highest stress of a spur pair, and some relief lowers it", "[core][load][edge]") {
  const GearPair gears = rounded_pair(0, 0.05);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 4}, equally_spaced_phases(64)});
  const auto summary = [&](double relief) { return summarise(model, analyse_cycle(model, relieved(relief), torque)); };
  const CycleSummary none = summary(0.0), some = summary(20 * units::um);
  CHECK(none.edge_stress == none.peak_contact_stress);
  CHECK(some.peak_contact_stress < none.peak_contact_stress);
  CHECK(some.edge_stress < none.edge_stress);
}

TEST_CASE("Where a tip edge carries most at the end of the face, its stress there is the contact stress", "[core][load][edge][face-end]") {
  const GearPair gears = rounded_pair(0, 0.05);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 6}, equally_spaced_phases(32)});
  FlankCondition condition;
  condition.modification.pinion.lead_slope = 10 * units::um;
  const LoadedCycle cycle = analyse_cycle(model, condition, torque);
  int at_ends = 0;
  for (std::size_t k = 0; k < cycle.positions.size(); ++k) {
    const LoadedPosition& loaded = cycle.positions[k];
    Eigen::Index highest = 0;
    const double stress = loaded.contact_stress.maxCoeff(&highest);
    if (loaded.edge_stress[highest] == 0.0) continue;
    const bool is_end = std::ranges::any_of(model.positions[k].face_ends, [&](const FaceEndOfLine& end) { return end.point == highest; });
    at_ends += is_end ? 1 : 0;
    CHECK(loaded.edge_stress[highest] == stress);
  }
  CHECK(at_ends > 0);
}

namespace {

/// Of both gears.
std::optional<EdgeContactStart> earliest_start(const MeshModel& model, const FlankCondition& condition) {
  std::optional<EdgeContactStart> earliest;
  for (const Member gear : {Member::Pinion, Member::Wheel}) {
    const auto start = edge_contact_start(model, condition, torque, gear);
    if (start && (!earliest || start->torque < earliest->torque)) earliest = start;
  }
  return earliest;
}

}  // namespace

TEST_CASE("The torque at which edge contact begins parts torques with and without", "[core][rating][edge]") {
  const GearPair gears = rounded_pair(0, 0.1);
  MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 4}, equally_spaced_phases(32)});
  // Other meshes of a unit may tilt the shafts, by a fixed amount and in proportion to the torque.
  const double fixed = GENERATE(0.0, 4.0) * units::um, by_torque = GENERATE(0.0, 8.0) * units::um;
  CAPTURE(fixed, by_torque);
  for (MeshPosition& position : model.positions) {
    const auto along_face = [&](Eigen::Index i) { return position.points[static_cast<std::size_t>(i)].z / model.face_width + 0.5; };
    const Eigen::VectorXd tilt = Eigen::VectorXd::NullaryExpr(std::ssize(position.points), along_face);
    position.outside = {.fixed = fixed * tilt, .by_force = by_torque / model.normal_force(torque) * tilt};
  }
  const FlankCondition condition = relieved(8 * units::um);
  const auto start = earliest_start(model, condition);
  REQUIRE(start);
  CHECK(start->torque > 0.0);
  CHECK(start->torque < torque);
  const auto edge_stress = [&](double at) { return summarise(model, analyse_cycle(model, condition, at)).edge_stress; };
  CHECK(edge_stress(start->torque) > 0.0);
  CHECK(edge_stress(start->torque - 1.1e-3 * torque) == 0.0);  // sought to a thousandth of the torque
  CHECK_FALSE(earliest_start(model, relieved(60 * units::um)));
  // Without relief the next pair touches on an edge at any load, at the phase of its entry; the nearest position is a little off.
  CHECK(earliest_start(model, relieved(0.0))->torque < 0.01 * torque);
}

TEST_CASE("Between few mesh positions the torque at which edge contact begins is that of many", "[core][rating][edge]") {
  const GearPair gears = rounded_pair(0, 0.1);
  const FlankCondition condition = relieved(8 * units::um);
  const MeshAt at = [&](const std::vector<double>& phases) { return mesh_cases::model(gears, {{QuadratureRule::Graded, 4}, phases}); };
  const auto start = [&](int positions) { return earliest_start(at(equally_spaced_phases(positions)), condition).value(); };
  constexpr double sought = 2e-3 * torque;
  for (const int positions : {16, 32}) {
    CAPTURE(positions);
    const EdgeContactStart coarse = start(positions), found = edge_contact_start_near(at, condition, torque, coarse, 1.0 / positions);
    CHECK(found.torque <= coarse.torque);
    // Discretisation: phases beside the start lie as close as those of 256 positions.
    CHECK(found.torque == tests::about(start(256).torque, 2 * sought));
    CHECK(found.gear == coarse.gear);
  }
}

TEST_CASE("The torque at which contact reaches an edge goes to that of the sharp edge as its rounding vanishes", "[core][rating][edge]") {
  const FlankCondition condition = relieved(8 * units::um);
  const auto start = [&](double rounding) {
    const MeshModel model = mesh_cases::model(rounded_pair(0, rounding), {{QuadratureRule::Graded, 4}, equally_spaced_phases(32)});
    const LoadedCycle cycle = analyse_cycle(model, condition, torque);
    CHECK(reaches_tip_edge(model, cycle));
    CHECK((summarise(model, cycle).edge_stress > 0.0) == (rounding > 0.0));  // no stress is known on a sharp edge
    return earliest_start(model, condition).value().torque;
  };
  constexpr double sought = 2e-3 * torque;  // to so much of the torque
  CHECK(std::abs(start(1e-4) - start(0.0)) <= sought);
  const MeshModel relieved_more = mesh_cases::model(rounded_pair(0, 0), {{QuadratureRule::Graded, 4}, equally_spaced_phases(32)});
  CHECK_FALSE(reaches_tip_edge(relieved_more, analyse_cycle(relieved_more, relieved(60 * units::um), torque)));
}

TEST_CASE("Transmission error runs on as contact wanders over an edge", "[core][load][edge]") {
  const GearPair gears = rounded_pair(0, 0.1);
  const PathOfContact path(gears);
  const auto error = [&](double phase) {
    const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 4}, {phase}});
    return analyse_cycle(model, relieved(3 * units::um), torque).positions[0].load.transmission_error;
  };
  const double end = path.path_end() - std::floor(path.path_end());
  // A jump would not shrink with the step.
  const auto change = [&](double step) { return std::abs(error(end + step) - error(end - step)); };
  CHECK(change(1e-4) < 0.2 * change(1e-3));
  CHECK(change(1e-5) < 0.2 * change(1e-4));
}

TEST_CASE("As a tip rounding vanishes the load of the pair on the edge goes to that of the sharp edge, monotonically", "[core][load][edge]") {
  const PathOfContact path(rounded_pair(0, 0));
  const double beyond = path.path_end() - std::floor(path.path_end()) + 0.01;  // one pair has just gone beyond E
  const auto share = [&](double rounding) {
    const MeshModel model = mesh_cases::model(rounded_pair(0, rounding), {{QuadratureRule::Graded, 4}, {beyond}});
    const LoadedPosition position = analyse_cycle(model, {}, torque).positions[0];
    double least = 1.0;
    for (const ToothShare& tooth : load_sharing(model.positions[0], position)) {
      if (tooth.share > 0.0) least = std::min(least, tooth.share);
    }
    return least;
  };
  double last = share(0.064), last_step = INFINITY;
  for (const double rounding : {0.016, 0.004, 0.001, 0.0}) {
    const double now = share(rounding);
    CAPTURE(rounding, last, now);
    CHECK(now > last);  // more and more of the tooth stands in the way
    CHECK(now - last < last_step);
    last_step = now - last;
    last = now;
  }
}

TEST_CASE("A pair pushed apart has the edge contact of the pair that is made for this centre distance", "[core][load][edge][independent]") {
  const double helix = GENERATE(20.0, 30.0);  // a spur pair's edge is loaded between positions
  PairData data = rounded_pair(helix, 0.05).data;
  const GearPair pair = make_gear_pair(data);
  constexpr double apart = 0.15;
  data.centre_distance = pair.centre_distance + apart;
  const MeshResolution resolution{{QuadratureRule::Graded, 16}, equally_spaced_phases(32)};
  const auto summary_of = [&](const GearPair& gears, double by) {
    FlankCondition condition = relieved(12 * units::um);
    condition.misalignment.centre_distance = by;
    const MeshModel model = make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, resolution, {},
                                            MeshPlacement::of(GapModel::PlaneOfAction, condition.misalignment));
    return summarise(model, analyse_cycle(model, condition, torque));
  };
  const CycleSummary made = summary_of(make_gear_pair(data), 0.0);
  const CycleSummary pushed = summary_of(pair, apart), nominal = summary_of(pair, 0.0);
  CAPTURE(helix, made.edge_stress, pushed.edge_stress, nominal.edge_stress, made.te_peak_to_peak, pushed.te_peak_to_peak);
  REQUIRE(made.edge_stress > 300.0);
  CHECK(std::abs(nominal.edge_stress - made.edge_stress) > 0.04 * made.edge_stress);  // there is something to see
  // model: second order, radii of curvature and compliance are kept where the edge moves by a tenth of the one near the root
  CHECK(pushed.edge_stress == Approx(made.edge_stress).epsilon(0.03));
  CHECK(pushed.te_peak_to_peak == Approx(made.te_peak_to_peak).epsilon(0.03));
}
