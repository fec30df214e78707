#include "core/contact/unloaded/transmission_error.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/contact/path/edge_reach.hpp"
#include "tests/core/contact/contact_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::deg;
using units::pi;

TEST_CASE("The mesh follows the leading pair, and every transfer point is located where two pairs are equal", "[core][contact]") {
  Random random(99);
  int transfers = 0;
  for (int i = 0; i < 6; ++i) {
    PairData data = random_pair_data(random);
    data.helix_angle = i % 2 == 0 ? 0.0 : 20 * deg;
    if (!find_problems(data).empty()) continue;
    const GearPair pair = make_gear_pair(data);
    const Misalignment misalignment = random_misalignment(random);
    const Modification pinion = random_modification(random, pair.pinion), wheel = random_modification(random, pair.wheel);
    const FlankAssembly scene = scene_of(pair, misalignment, pinion, wheel);
    const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene, 20);
    CAPTURE(i);
    REQUIRE(mesh.missing == 0);
    REQUIRE(mesh.phi1.size() == 20);
    double highest = -INFINITY, lowest = INFINITY;
    for (std::size_t k = 0; k < mesh.phi1.size(); ++k) {
      double leading = -INFINITY;
      for (int tooth = -4; tooth <= 4; ++tooth) {
        const ToothContact contact = find_tooth_contact(scene, tooth, mesh.phi1[k]);
        if (contact.exists()) leading = std::max(leading, contact.transmission_error);
      }
      CHECK(std::abs(mesh.transmission_error[k] - leading) <= 1e-12);  // round-off
      highest = std::max(highest, leading);
      lowest = std::min(lowest, leading);
      CHECK(std::abs(mesh.phi1[k] - 2 * pi / data.pinion.teeth * (static_cast<double>(k) / 20 - 0.5)) <= 1e-15);
    }
    for (const Transfer& transfer : mesh.transfers) {
      ++transfers;
      const double before = find_tooth_contact(scene, transfer.from_tooth, transfer.phi1).transmission_error;
      const double after = find_tooth_contact(scene, transfer.to_tooth, transfer.phi1).transmission_error;
      CHECK(transfer.from_tooth != transfer.to_tooth);
      CHECK(std::abs(before - after) <= 1e-11);  // round-off: 1e-13 rad of phi1 times the slope of a corner
      CHECK(std::abs(transfer.transmission_error - after) <= 1e-15);
      CHECK(transfer.slope_before == find_tooth_contact(scene, transfer.from_tooth, transfer.phi1).slope);
      CHECK(transfer.slope_after == find_tooth_contact(scene, transfer.to_tooth, transfer.phi1).slope);
      CHECK(transfer.slope_jump() >= 0.0);
      lowest = std::min(lowest, transfer.transmission_error);
    }
    // Crests and troughs between positions are located beyond these.
    CHECK(mesh.largest >= highest - 1e-15);
    CHECK(mesh.smallest <= lowest + 1e-15);
    CHECK(mesh.peak_to_peak == mesh.largest - mesh.smallest);
    // A pitch later the next pair does the same.
    const double te = find_tooth_contact(scene, -1, mesh.phi1[3] + 2 * pi / data.pinion.teeth).transmission_error;
    CHECK(std::abs(te - find_tooth_contact(scene, 0, mesh.phi1[3]).transmission_error) <= 1e-12);
  }
  CHECK(transfers >= 5);
}

TEST_CASE("Harmonic amplitudes of a sum of cosines are its coefficients", "[core][contact][closed-form]") {
  const int n = GENERATE(25, 64);
  std::vector<double> samples;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * pi * i / n;
    samples.push_back(3.0 + 2.0 * std::cos(t + 0.4) - 0.5 * std::sin(3 * t) + 0.01 * std::cos(10 * t - 1.0));
  }
  const std::vector<double> found = harmonic_amplitudes(samples);
  REQUIRE(found.size() == 10);
  const double expected[10] = {2.0, 0, 0.5, 0, 0, 0, 0, 0, 0, 0.01};
  for (std::size_t i = 0; i < 10; ++i) CHECK(std::abs(found[i] - expected[i]) <= 1e-14);  // round-off
}

TEST_CASE("No more harmonics are reported than the samples resolve", "[core][contact]") {
  CHECK(harmonic_amplitudes({}).empty());
  CHECK(harmonic_amplitudes({1.0}).empty());
  CHECK(harmonic_amplitudes({1.0, 2.0}).empty());
  CHECK(harmonic_amplitudes({1.0, 2.0, 1.0}).size() == 1);
  CHECK(harmonic_amplitudes(std::vector<double>(8, 1.0)).size() == 3);
}

TEST_CASE("Each pair's curve lies inside its extended path of contact, in order of the angle", "[core][contact]") {
  const GearPair pair = make_gear_pair(pair_data(22, 51, 17 * deg));
  Modification m;
  m.lead_crowning = 0.01;
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene_of(pair, {}, m), 24);
  const PathOfContact path(pair);
  std::size_t positions = 0;
  for (const PairCurve& curve : mesh.pairs) {
    double last = -INFINITY;
    for (const ToothContact& contact : curve.positions) {
      CHECK(contact.tooth == curve.tooth);
      CHECK(contact.phi1 > last);
      last = contact.phi1;
      const double phase = path.line_phase_at(contact.phi1 + contact.tooth * 2 * pi / 22, pair);
      CHECK(phase >= 0.0);
      CHECK(phase <= path.last_line_phase());
      ++positions;
    }
  }
  // Every pair passes every position of the pitch once: as many positions as the extended path has pitches.
  CHECK(std::abs(static_cast<double>(positions) - 24 * path.last_line_phase()) <= static_cast<double>(mesh.pairs.size()));
}

TEST_CASE("An edge that a fillet leaves reaches from the mate's tip circle to the line of action", "[core][contact][independent]") {
  const double beta = GENERATE(0.0, 20.0) * deg;
  const GearPair pair = make_gear_pair(pair_data(12, 56, beta));
  REQUIRE(pair.pinion.fillet_interference);
  const FlankAssembly scene = scene_of(pair);
  const double form = scene.pinion.form_radius, rho = scene.pinion.roll_at(form);
  const auto outside = [&](double phi1) {  // the wheel's tip circle [mm]
    const Point3<double> p = flank_point(scene.pinion, rho, 0.0, 0, phi1);
    return std::hypot(p.x - pair.centre_distance, p.y) - pair.wheel.tip_radius;
  };
  // On the line of action, and from there back to where the edge entered the circle.
  const double on_line = (pair.path_start - pair.pitch_point) / pair.pinion.base_radius;
  double inside = on_line, before = on_line - 1.0;
  REQUIRE(outside(inside) < 0.0);
  REQUIRE(outside(before) > 0.0);
  while (inside - before > 1e-14) {
    const double middle = 0.5 * (inside + before);
    (outside(middle) < 0.0 ? inside : before) = middle;
  }
  const EdgeReach reach = edge_reach(pair);
  constexpr double kRoundOff = 1e-11;  // of the form circle: tooth_form finds it to 1e-12 of its radius
  CHECK(std::abs(reach.before - (on_line - inside) * 12 / (2 * pi)) <= kRoundOff);
  CHECK(reach.beyond == 0.0);
  // The same pair the other way round.
  const EdgeReach turned = edge_reach(make_gear_pair(pair_data(56, 12, beta)));
  CHECK(std::abs(turned.beyond - reach.before) <= kRoundOff);
  CHECK(turned.before == 0.0);
  // Where the mate's tip crosses the line of action first, no edge does.
  const EdgeReach none = edge_reach(make_gear_pair(pair_data(22, 51, beta)));
  CHECK(none.before == 0.0);
  CHECK(none.beyond == 0.0);
}

TEST_CASE("Undercut teeth: the envelope is the largest of all pairs, those before and beyond the path included", "[core][contact]") {
  Random random(2026);
  int examined = 0, before_the_path = 0;
  for (int i = 0; i < 40; ++i) {
    const int few = random.integer(9, 13), many = random.integer(30, 120);
    const double beta = random.coin() ? random(0.0, 20 * deg) : 0.0;
    const bool pinion_is_small = random.coin();
    PairData data = pair_data(pinion_is_small ? few : many, pinion_is_small ? many : few, beta, 0.0, 0.0, 12.0, 12.0);
    data.pressure_angle = random(16 * deg, 20 * deg);
    if (!find_problems(data).empty()) continue;
    const GearPair pair = make_gear_pair(data);
    if (!pair.pinion.fillet_interference && !pair.wheel.fillet_interference) continue;
    Misalignment misalignment;
    misalignment.centre_distance = random(0.0, 0.1);
    Modification pinion, wheel;
    pinion.addendum_crowning = random(0.0, 0.02);
    wheel.addendum_crowning = random(0.0, 0.02);
    (pinion_is_small ? wheel : pinion).root_relief = {random(0.0, 0.08), 3.0, ReliefShape::Linear};
    (pinion_is_small ? pinion : wheel).tip_relief = {random(0.0, 0.08), 2.0, ReliefShape::Parabolic};
    const FlankAssembly scene = scene_of(pair, misalignment, pinion, wheel);
    const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene, 24);
    CAPTURE(i, few, many, beta, pinion_is_small);
    REQUIRE(mesh.missing == 0);
    ++examined;
    const PathOfContact path(pair);
    const ToothContactSolver solver(scene);
    for (std::size_t k = 0; k < mesh.phi1.size(); ++k) {
      ToothContact leading;
      for (int tooth = -8; tooth <= 8; ++tooth) {
        const ToothContact contact = solver.find(tooth, mesh.phi1[k]);
        if (contact.exists() && !(contact.transmission_error <= leading.transmission_error)) leading = contact;
      }
      CHECK(std::abs(mesh.transmission_error[k] - leading.transmission_error) <= 1e-12);  // round-off
      const double phase = path.line_phase_at(mesh.phi1[k], pair) + leading.tooth;
      const double reach_before = path.before - PathOfContact::extension, reach_beyond = path.beyond - PathOfContact::extension;
      if (phase < reach_before || phase > path.last_line_phase() - reach_beyond) ++before_the_path;
    }
    for (const Transfer& transfer : mesh.transfers) {
      const double leaving = solver.find(transfer.from_tooth, transfer.phi1).transmission_error;
      CHECK(std::abs(transfer.transmission_error - leaving) <= 1e-11);  // as above
    }
    CHECK(mesh.peak_to_peak >= 0.0);
    CHECK(std::isfinite(mesh.peak_to_peak));
  }
  CHECK(examined >= 20);
  CHECK(before_the_path >= 10);  // positions
}

namespace {

struct ModifiedMesh {
  GearPair pair;
  FlankAssembly scene;
};

/// Crowned and misaligned, with linear reliefs.
ModifiedMesh modified_mesh(double beta, double crossing) {
  const GearPair pair = make_gear_pair(pair_data(22, 51, beta, 0.1, 0.0));
  Modification pinion, wheel;
  pinion.lead_crowning = 0.008;
  pinion.addendum_crowning = 0.006;
  pinion.twist = 0.003;
  wheel.dedendum_crowning = 0.004;
  wheel.tip_relief = {0.015, 1.2, ReliefShape::Linear};
  Misalignment misalignment;
  misalignment.crossing = crossing;
  return {pair, scene_of(pair, misalignment, pinion, wheel)};
}

}  // namespace

TEST_CASE("The slope of the transmission error is that of differences, whatever touches", "[core][contact][independent]") {
  const double beta = GENERATE(0.0, 17.0) * deg, crossing = GENERATE(0.0, 3.0, -20.0) * units::arcmin;
  const ModifiedMesh mesh = modified_mesh(beta, crossing);
  const double h = 1e-6;
  int compared = 0;
  for (double phi1 = -0.35; phi1 < 0.35; phi1 += 0.0071) {
    const ToothContact here = find_tooth_contact(mesh.scene, 0, phi1), before = find_tooth_contact(mesh.scene, 0, phi1 - h),
                       after = find_tooth_contact(mesh.scene, 0, phi1 + h);
    if (before.kind != after.kind || !here.exists()) continue;
    CAPTURE(beta / deg, crossing / units::arcmin, phi1, to_string(here.kind));
    // discretisation: h times the second derivative where a kink lies between, round-off 1e-15/h
    CHECK(std::abs((after.transmission_error - before.transmission_error) / (2 * h) - here.slope) <= 2e-8);
    ++compared;
  }
  CHECK(compared >= 60);
}

TEST_CASE("Located crests and troughs do not depend on the number of positions", "[core][contact]") {
  const double beta = GENERATE(0.0, 17.0) * deg, crossing = GENERATE(0.0, 1.0, 4.0) * units::arcmin;
  const ModifiedMesh mesh = modified_mesh(beta, crossing);
  const UnloadedMesh fine = analyse_unloaded_mesh(mesh.pair, mesh.scene, 97);
  REQUIRE(fine.missing == 0);
  for (const int positions : {16, 33, 64}) {
    const UnloadedMesh coarse = analyse_unloaded_mesh(mesh.pair, mesh.scene, positions);
    CAPTURE(beta / deg, crossing / units::arcmin, positions);
    CHECK(std::abs(coarse.largest - fine.largest) <= 1e-12);    // round-off of the angles
    CHECK(std::abs(coarse.smallest - fine.smallest) <= 1e-12);  // transfer points lag by the tolerance of the lead over other pairs
    CHECK(coarse.transfers.size() == fine.transfers.size());
  }
}

TEST_CASE("With cumulative pitch errors the transfer point moves to the angle at which the pairs are equal", "[core][contact]") {
  const ModifiedMesh nominal = modified_mesh(0.0, 0.0);
  FlankAssembly scene = nominal.scene;
  scene.pinion.error.cumulative_pitch = {0.0, 0.002, -0.001, 0.0, 0.001};
  const UnloadedMesh mesh = analyse_unloaded_mesh(nominal.pair, scene, 32);
  REQUIRE(mesh.missing == 0);
  REQUIRE_FALSE(mesh.transfers.empty());
  for (const Transfer& t : mesh.transfers) {
    const double before = find_tooth_contact(scene, t.from_tooth, t.phi1).transmission_error;
    const double after = find_tooth_contact(scene, t.to_tooth, t.phi1).transmission_error;
    CHECK(std::abs(before - after) <= 1e-11);
    CHECK(t.slope_jump() >= 0.0);
  }
  // Not periodic: the next pitch starts where other teeth are.
  const double pitch = 2 * pi / 22;
  double first = -INFINITY, next = -INFINITY;
  for (int tooth = -3; tooth <= 3; ++tooth) {
    const ToothContact a = find_tooth_contact(scene, tooth, -0.5 * pitch), b = find_tooth_contact(scene, tooth, 0.5 * pitch);
    if (a.exists()) first = std::max(first, a.transmission_error);
    if (b.exists()) next = std::max(next, b.transmission_error);
  }
  CHECK(std::abs(first - next) > 1e-7);
  CHECK(mesh.largest >= std::max(first, next) - 1e-15);
}
