#include "core/contact/unloaded/bearing_pattern.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/contact/unloaded/contact_ellipse.hpp"
#include "tests/core/contact/contact_cases.hpp"
#include "tests/reference/nasa_tm_107451.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::arcmin;
using units::deg;
using units::pi;

namespace {

BearingPattern pattern_of(const GearPair& pair, const FlankAssembly& scene, Member member, int rows = 21, int columns = 21) {
  return bearing_pattern(scene, analyse_unloaded_mesh(pair, scene, 64), member, rows, columns);
}

}  // namespace

TEST_CASE("Aligned flanks touch over the whole of their active flanks", "[core][contact][closed-form]") {
  const double beta = GENERATE(0.0, 25.0) * deg;
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GearPair pair = make_gear_pair(pair_data(20, 43, beta, 0.3, 0.0));
  const BearingPattern pattern = pattern_of(pair, scene_of(pair), member);
  const double active_root = pair[member].active_root_radius;
  REQUIRE(pattern.separation.rows() == 21);
  REQUIRE(pattern.separation.cols() == 21);
  int active = 0, below = 0;
  for (int i = 0; i < 21; ++i) {
    for (int j = 0; j < 21; ++j) {
      CAPTURE(pattern.radius[i], active_root, pattern.z[j]);
      if (pattern.radius[i] >= active_root) {
        ++active;
        CHECK(pattern.separation(i, j) <= 1e-9);  // round-off of two wheel angles times the radius, mm
      } else if (pattern.radius[i] < active_root - 0.05) {
        ++below;
        CHECK(pattern.separation(i, j) > 1e-6);  // the mate's tip passes above
      }
    }
  }
  CHECK(active >= 18 * 21);
  CHECK(below >= 21);
}

TEST_CASE(
    "The pattern of a spur pair is its lead crowning, and that of a crossed one opens in proportion to the distance "
    "from the end",
    "[core][contact][closed-form]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const GearPair pair = make_gear_pair(pair_data(20, 40, 0.0));
  const double active_root = pair[member].active_root_radius, crown = 0.020, crossing = 2 * arcmin;
  Modification crowned;
  crowned.lead_crowning = crown;
  Misalignment crossed;
  crossed.crossing = crossing;
  const BearingPattern by_crown = pattern_of(pair, scene_of(pair, {}, crowned), member);
  const BearingPattern by_crossing = pattern_of(pair, scene_of(pair, crossed), member);
  for (int i = 0; i < 21; ++i) {
    if (by_crown.radius[i] < active_root + 0.1) continue;
    for (int j = 0; j < 21; ++j) {
      const double removed = crown * std::pow(by_crown.z[j] / 15.0, 2);
      CHECK(std::abs(by_crown.separation(i, j) - removed) <= 1e-3 * removed + 1e-9);  // model: D against the radii
      // Crossing closes at +z: first order by g cos(a) per mm of face.
      const double open = crossing * std::cos(pair.working_transverse_pressure_angle) * (15.0 - by_crossing.z[j]);
      CHECK(std::abs(by_crossing.separation(i, j) - open) <= 2e-3 * open + 2e-6);  // model: second order of g times a tooth height, mm
    }
  }
}

TEST_CASE("Around the path of contact the pattern is as wide as the ellipses along it", "[core][contact][independent]") {
  // A crowned pair's path runs at mid face: along z the band of the ellipses reaches where d(separation) = t, in both.
  const double beta = GENERATE(0.0, 12.0, 30.0) * deg;
  const GearPair pair = make_gear_pair(pair_data(26, 57, beta));
  Modification m;
  m.lead_crowning = 0.015;
  const FlankAssembly scene = scene_of(pair, {}, m);
  const BearingPattern pattern = pattern_of(pair, scene, Member::Pinion, 11, 41);
  const ToothContact contact = find_tooth_contact(scene, 0, 0.01);
  REQUIRE(contact.kind == ContactKind::Surface);
  const double thickness = 1e-4;
  const ContactEllipse e = contact_ellipse(scene, contact, thickness);
  const double reach = std::hypot(e.semi_major * e.major_d_z, e.semi_minor * e.minor_d_z);
  const int row = 6;  // well inside the path of contact
  REQUIRE(pattern.radius[row] > pair.pinion.active_root_radius + 1.0);
  REQUIRE(pattern.radius[row] < pair.pinion.tip_radius - 1.0);
  CHECK(pattern.separation(row, 20) <= 1e-9);
  for (const int step : {1, 2, 3}) {
    for (const int column : {20 - step, 20 + step}) {
      const double expected = thickness * std::pow(pattern.z[column] / reach, 2);
      // model: the ellipse is of second order, its curvature varies along the path by the crown's D over the radii
      CHECK(std::abs(pattern.separation(row, column) / expected - 1) <= 2e-3);
    }
  }
}

TEST_CASE("The separation is the smallest that a sweep through the mesh finds", "[core][contact][independent]") {
  const bool misaligned = GENERATE(false, true);
  const GearPair pair = make_gear_pair(pair_data(23, 50, 18 * deg, 0.1, 0.1, 28.0, 31.0));
  Modification pinion, wheel;
  pinion.lead_crowning = 0.010;
  pinion.tip_relief = {0.012, 1.2, ReliefShape::Parabolic};
  wheel.lead_slope = 0.006;
  wheel.addendum_crowning = 0.004;
  Misalignment misalignment;
  if (misaligned) {
    misalignment.crossing = 2 * arcmin;
    misalignment.intersecting = -1 * arcmin;
  }
  const FlankAssembly scene = scene_of(pair, misalignment, pinion, wheel);
  const ToothContactSolver solver(scene);
  const double pitch = 2 * pi / 23;
  // The envelope of all pairs on a fine grid of pinion angles, without linear interpolation.
  const int steps = 400;
  std::vector<double> angle, envelope;
  for (int i = 0; i <= steps; ++i) {
    angle.push_back(pitch * (static_cast<double>(i) / steps - 0.5));
    double lead = -INFINITY;
    for (int tooth = -2; tooth <= 2; ++tooth) {
      const ToothContact contact = solver.find(tooth, angle.back());
      if (contact.exists()) lead = std::max(lead, contact.phi2);
    }
    envelope.push_back(lead);
  }
  const BearingPattern pattern = pattern_of(pair, scene, Member::Pinion, 9, 7);
  const double scale = pair.wheel.base_radius * std::cos(pair.base_helix_angle);
  int finite = 0;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 7; ++j) {
      const double rho = scene.pinion.roll_at(pattern.radius[i]);
      double smallest = INFINITY;
      for (int tooth = -3; tooth <= 3; ++tooth) {
        for (int k = 0; k <= steps; ++k) {
          smallest = std::min(smallest, (envelope[k] - wheel_angle(scene, tooth, angle[k], rho, pattern.z[j])) * scale);
        }
      }
      CAPTURE(misaligned, pattern.radius[i], pattern.z[j], smallest, pattern.separation(i, j));
      // A sweep of 400 steps stops at most half a step short of the closest position; at the end of the mate's flank,
      // where the separation still falls, it misses up to a step times the slope.
      if (std::isinf(smallest)) {
        CHECK(std::isinf(pattern.separation(i, j)));
        continue;
      }
      ++finite;
      CHECK(pattern.separation(i, j) <= smallest + 5e-6);
      const bool near_contact = smallest < 0.025;
      if (near_contact) CHECK(pattern.separation(i, j) >= smallest - 5e-5 - 0.1 * smallest);
    }
  }
  CHECK(finite >= 50);
}

TEST_CASE("Both flanks show the same pattern in conjugate points", "[core][contact][independent]") {
  // The pinion's map turns the wheel until it touches, the wheel's map the pinion: two evaluations of one gap.
  const GearPair pair = make_gear_pair(pair_data(24, 48, 15 * deg));
  Modification m;
  m.lead_crowning = 0.020;
  m.parabolic_te = 2e-4;
  Misalignment misalignment;
  misalignment.crossing = 1 * arcmin;
  const FlankAssembly scene = scene_of(pair, misalignment, m);
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene, 64);
  const int n = 101;
  const BearingPattern on_pinion = bearing_pattern(scene, mesh, Member::Pinion, n, 9);
  const BearingPattern on_wheel = bearing_pattern(scene, mesh, Member::Wheel, n, 9);
  int compared = 0;
  for (int i = 30; i < 90; i += 7) {
    const double rho2 = pair.path_length - scene.pinion.roll_at(on_pinion.radius[i]);
    const double radius = std::hypot(pair.wheel.base_radius, rho2);
    if (radius > pair.wheel.tip_radius - 0.3 || radius < pair.wheel.active_root_radius + 0.3) continue;
    const double at = (radius - on_wheel.radius.front()) / (on_wheel.radius[1] - on_wheel.radius[0]);
    const int k = static_cast<int>(at);
    for (int j = 1; j < 8; ++j) {
      const double other = on_wheel.separation(k, j) + (at - k) * (on_wheel.separation(k + 1, j) - on_wheel.separation(k, j));
      ++compared;
      CAPTURE(on_pinion.radius[i], on_pinion.z[j]);
      // model: the points are conjugate only as far as the flanks are nominal
      CHECK(std::abs(on_pinion.separation(i, j) - other) <= 2e-4 + 0.02 * other);
    }
  }
  CHECK(compared >= 30);
}

TEST_CASE("Eight positions give the pattern of a parabola to a 64th of its height", "[core][contact][convergence]") {
  // Linear between positions and transfer points: without the latter the valley between two arcs would be cut off.
  const GearPair pair = make_gear_pair(reference::nasa_tm_107451::pair_data());
  Modification m;
  m.lead_crowning = 0.040;
  m.parabolic_te = 1e-3;
  Misalignment misalignment;
  misalignment.crossing = 1 * arcmin;  // moves the transfer point off the positions
  const FlankAssembly scene = scene_of(pair, misalignment, m);
  const UnloadedMesh fine = analyse_unloaded_mesh(pair, scene, 512), coarse = analyse_unloaded_mesh(pair, scene, 8);
  const Eigen::MatrixXd wanted = bearing_pattern(scene, fine, Member::Pinion, 61, 5).separation;
  const Eigen::MatrixXd found = bearing_pattern(scene, coarse, Member::Pinion, 61, 5).separation;
  const double height = fine.peak_to_peak * pair.wheel.base_radius;
  for (Eigen::Index i = 0; i < wanted.size(); ++i) {
    if (std::isfinite(wanted(i))) CHECK(std::abs(found(i) - wanted(i)) <= 1.05 * height / 64);
  }
}

TEST_CASE("A pair that enters after the last position closes the pitch in the pattern too", "[core][contact]") {
  // Undercut pinion, and the wheel relieved below: the next pair takes over after the only position, which it has not reached yet.
  PairData data = pair_data(12, 56, 0.0, 0.05, 0.0, 5.0, 5.0);
  data.pressure_angle = 15.5 * deg;
  const GearPair pair = make_gear_pair(data);
  Modification wheel;
  wheel.root_relief = {0.08, 3.0, ReliefShape::Linear};
  const FlankAssembly scene = scene_of(pair, {}, {}, wheel);
  const UnloadedMesh one = analyse_unloaded_mesh(pair, scene, 1), many = analyse_unloaded_mesh(pair, scene, 64);
  REQUIRE(one.transfers.size() == 1);
  for (const PairCurve& curve : one.pairs) REQUIRE(curve.tooth != one.transfers.front().to_tooth);
  // Between its nodes the mesh's error is taken for linear: off by at most its peak to peak, which does not reach what the pair that has
  // been overtaken lags behind at the end of the pitch.
  const double scale = pair.wheel.base_radius, linear = many.peak_to_peak * scale;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const BearingPattern coarse = bearing_pattern(scene, one, member, 11, 3), fine = bearing_pattern(scene, many, member, 11, 3);
    for (int i = 0; i < 11; ++i) {
      if (!std::isfinite(fine.separation(i, 1))) continue;
      CAPTURE(i, fine.separation(i, 1), coarse.separation(i, 1), linear);
      CHECK(std::abs(coarse.separation(i, 1) - fine.separation(i, 1)) <= linear);
    }
  }
}

TEST_CASE("The part of a face that overhangs the mate is not marked", "[core][contact]") {
  const GearPair pair = make_gear_pair(pair_data(20, 40, 10 * deg, 0.0, 0.0, 36.0, 30.0));
  Misalignment misalignment;
  misalignment.axial_offset = 1.5;  // the wheel covers -13.5 .. 16.5 of the pinion
  const FlankAssembly scene = scene_of(pair, misalignment);
  const BearingPattern pinion = pattern_of(pair, scene, Member::Pinion, 5, 37), wheel = pattern_of(pair, scene, Member::Wheel, 5, 31);
  for (int j = 0; j < 37; ++j) {
    const bool covered = pinion.z[j] >= -13.5 && pinion.z[j] <= 16.5;
    CAPTURE(pinion.z[j]);
    CHECK((pinion.separation(3, j) <= 1e-9) == covered);
    CHECK(std::isfinite(pinion.separation(3, j)) == covered);
  }
  for (int j = 0; j < 31; ++j) CHECK(wheel.separation(3, j) <= 1e-9);
}

TEST_CASE("A symmetric pair has a symmetric pattern, and a crossed one bears at the closing ends", "[core][contact][symmetry]") {
  const GearPair spur = make_gear_pair(pair_data(21, 44, 0.0));
  Modification m;
  m.lead_crowning = 0.012;
  m.addendum_crowning = 0.004;
  m.parabolic_te = 3e-4;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const BearingPattern pattern = pattern_of(spur, scene_of(spur, {}, m), member);
    for (int i = 0; i < 21; ++i) {
      for (int j = 0; j < 10; ++j) {
        const double here = pattern.separation(i, j), there = pattern.separation(i, 20 - j);
        CHECK((here == there || std::abs(here - there) <= 1e-9));  // round-off, mm
      }
    }
    CHECK(pattern.separation.rowwise().minCoeff().minCoeff() <= 1e-9);
  }

  const GearPair helical = make_gear_pair(reference::nasa_tm_107451::pair_data());
  const double end = GENERATE(1.0, -1.0);
  Misalignment misalignment;
  misalignment.crossing = end * 3 * arcmin;  // + closes at +z
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const BearingPattern pattern = pattern_of(helical, scene_of(helical, misalignment), member, 41, 41);
    int marked = 0;
    for (int i = 0; i < 41; ++i) {
      for (int j = 0; j < 41; ++j) {
        if (pattern.separation(i, j) > 1e-3) continue;
        ++marked;
        CAPTURE(pattern.radius[i], pattern.z[j]);
        // At the closing face end, or at a tip: its own or where the mate's runs.
        const bool at_end = end * pattern.z[j] > 0.9 * 0.5 * helical.face_width;
        const bool at_tip = pattern.radius[i] > helical[member].tip_radius - 0.3 || pattern.radius[i] < helical[member].active_root_radius + 0.6;
        CHECK((at_end || at_tip));
        CHECK(end * pattern.z[j] > 0.0);
      }
    }
    CHECK(marked >= 20);
  }
}

TEST_CASE("The pattern of any pair has no gaps and contains the leading point", "[core][contact][slow]") {
  Random random(20260311);
  int scenes = 0;
  while (scenes < 12) {
    const PairData data = random_pair_data(random);
    if (!find_problems(data).empty()) continue;
    ++scenes;
    const GearPair pair = make_gear_pair(data);
    const Misalignment misalignment = random_misalignment(random);
    const Modification pinion = random_modification(random, pair.pinion), wheel = random_modification(random, pair.wheel);
    const FlankAssembly scene = scene_of(pair, misalignment, pinion, wheel);
    const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene, 32);
    if (mesh.missing > 0) continue;
    for (const Member member : {Member::Pinion, Member::Wheel}) {
      const BearingPattern pattern = bearing_pattern(scene, mesh, member, 60, 60);
      CAPTURE(scenes, data.pinion.teeth, data.wheel.teeth, data.helix_angle);
      CHECK_FALSE(pattern.separation.hasNaN());
      // discretisation: within a cell of the point of contact, on slopes of a few hundredths at most along an edge
      CHECK(pattern.separation.minCoeff() <= 0.003);
      // Most of what the mate covers comes within a tenth of a millimetre.
      CHECK(pattern.covered(0.1) > 0.5 * pair.face_width / pair[member].data.face_width);
    }
  }
}

TEST_CASE("Coverage grows with the compound's thickness, from the path of contact to all that ever faces the mate", "[core][contact]") {
  const GearPair pair = make_gear_pair(pair_data(20, 40, 0.0));
  Modification m;
  m.lead_crowning = 0.020;
  const BearingPattern pattern = pattern_of(pair, scene_of(pair, {}, m), Member::Pinion, 41, 201);
  double last = 0.0;
  for (const double thickness : {0.0002, 0.001, 0.003, 0.008, 0.015, 0.025}) {
    const double covered = pattern.covered(thickness);
    CHECK(covered > last);
    last = covered;
    // Of the active flank the share of the face width on which the crown is below t; discretisation: a cell of the
    // grid.
    const double face = std::min(1.0, std::sqrt(thickness / 0.020));
    CHECK(std::abs(covered - face) <= 0.06 * face + 0.02);
  }
  CHECK(pattern.covered(-1.0) == 0.0);
  CHECK(pattern.covered(INFINITY) == 1.0);
}

TEST_CASE("The coverage of a flank counts area, not points", "[core][contact][closed-form]") {
  BearingPattern pattern;
  pattern.radius = {10.0, 20.0, 30.0};
  pattern.z = {0.0, 1.0, 4.0};
  pattern.separation = Eigen::MatrixXd::Constant(3, 3, 1.0);
  pattern.separation.row(0).setZero();
  // The lower cells have two of four corners within: (400 - 100)/(900 - 100)/2 of the area.
  CHECK(std::abs(pattern.covered(0.5) - 0.5 * 300.0 / 800.0) <= 1e-15);
}

TEST_CASE("A pattern needs a grid", "[core][contact]") {
  const GearPair pair = make_gear_pair(pair_data(20, 40, 0.0));
  const FlankAssembly scene = scene_of(pair);
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene, 8);
  CHECK_THROWS_AS(bearing_pattern(scene, mesh, Member::Pinion, 1, 5), InvalidInput);
  CHECK_THROWS_AS(bearing_pattern(scene, mesh, Member::Wheel, 5, 1), InvalidInput);
}
