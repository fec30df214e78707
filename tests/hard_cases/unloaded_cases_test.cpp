#include <catch2/catch.hpp>
#include <cmath>

#include "core/contact/path/path_of_contact.hpp"
#include "core/contact/unloaded/tooth_contact.hpp"
#include "tests/hard_cases/hard_case.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::hard_cases;
using units::arcmin;
using units::arcsec;
using units::deg;
using units::um;

namespace {

constexpr double kUnloadedRoundOff = 1e-12;  // rad

double peak_to_peak(const std::string& name, const Settings& settings) { return run(name, settings).unloaded.front().mesh.peak_to_peak; }

}  // namespace

TEST_CASE("Hard: aligned flanks touch along a line and transmit without error", "[hard_cases]") {
  const std::string helix = GENERATE("0", "1e-6", "25", "45");
  const std::string hand = GENERATE("right", "left");
  CAPTURE(helix, hand);
  const auto results = run("aligned_line_contact", {{"pair.helix_angle", helix}, {"pinion.hand", hand}});
  const auto& unloaded = results.unloaded.front();
  CHECK(unloaded.mesh.missing == 0);
  CHECK(unloaded.mesh.peak_to_peak <= kUnloadedRoundOff);
  CHECK(std::abs(unloaded.mesh.largest) <= kUnloadedRoundOff);
  // A line shorter than a hundredth of the face counts as a point, see ToothContactSolver: there at most, a line begins or ends.
  const PathOfContact path(results.pair);
  for (std::size_t i = 0; i < unloaded.mesh.pairs.size(); ++i) {
    for (std::size_t j = 0; j < unloaded.marks[i].size(); ++j) {
      const ToothContact& contact = unloaded.mesh.pairs[i].positions[j];
      if (!unloaded.marks[i][j].carries || contact.kind == ContactKind::Line) continue;
      const double phase = path.line_phase_at(contact.phi1, results.pair) + contact.tooth;
      const double entered = phase - PathOfContact::extension;  // of its leading end since A [base pitches]
      const double left = path.last_line_phase() - PathOfContact::extension - phase;
      CAPTURE(contact.tooth, contact.phi1, to_string(contact.kind));
      CHECK(std::min(entered, left) <= 0.01 * std::abs(path.slope) * results.pair.face_width + 1e-12);
    }
  }
}

TEST_CASE("Hard: a crossing that cancels a lead error is approached continuously", "[hard_cases]") {
  const auto crossed_by = [](double minutes) { return peak_to_peak("crossing_cancels_lead_error", {{"misalignment.crossing", in_digits(minutes)}}); };
  const double singular = crossed_by(3.0), far = crossed_by(4.0);
  REQUIRE(far > 1.0 * arcsec);
  for (const double distance : {1e-9, 1e-8, 1e-6, 1e-4, 1e-2}) {
    for (const double side : {-1.0, 1.0}) {
      const double near = crossed_by(3.0 + side * distance);
      CAPTURE(distance, side, near / arcsec);
      // Each point's angle is linear in the crossing, to first order: the envelope of them has the slope of the steepest at most.
      CHECK(std::abs(near - singular) <= 1.1 * far * distance + kUnloadedRoundOff);
    }
  }
  CHECK(crossed_by(3.1) == Approx(0.1 * far).epsilon(0.05));  // second order in 3 arcmin is what is left
  CHECK(crossed_by(2.9) == Approx(0.1 * far).epsilon(0.05));
}

TEST_CASE("Hard: contact that leaves the flank for an edge and a corner takes its transmission error along", "[hard_cases]") {
  const studies::Study base = study("edge_surface_corner");
  const GearPair pair = make_gear_pair(base.pair);
  // The contact of pair 0 over the crossing of the axes.
  const auto contact_at = [&](double minutes, double phi1 = 0.0) {
    Misalignment misalignment = base.misalignment;
    misalignment.crossing = minutes * arcmin;
    const FlankAssembly scene = assemble_flanks(pair, {.modification = base.modification, .misalignment = misalignment});
    return find_tooth_contact(scene, 0, phi1);
  };
  const double phi1 = GENERATE(0.0, 0.12, -0.12);
  int transitions = 0;
  constexpr int steps = 24;
  for (int i = 0; i < steps; ++i) {
    double before = -10.0 + 20.0 * i / steps, after = -10.0 + 20.0 * (i + 1) / steps;
    const ContactKind first = contact_at(before, phi1).kind;
    if (contact_at(after, phi1).kind == first) continue;
    while (after - before > 1e-10) {
      const double middle = 0.5 * (before + after);
      (contact_at(middle, phi1).kind == first ? before : after) = middle;
    }
    ++transitions;
    const ToothContact one = contact_at(before, phi1), other = contact_at(after, phi1);
    CAPTURE(phi1, before, to_string(one.kind), to_string(other.kind));
    CHECK(std::abs(other.transmission_error - one.transmission_error) <= kUnloadedRoundOff);
    // The place may jump along a line of equal height only where it does not show: slopes stay between those of differences.
    constexpr double step = 1e-6;
    for (const double minutes : {before, after}) {
      const ToothContact here = contact_at(minutes, phi1);
      const double ahead = (contact_at(minutes, phi1 + step).transmission_error - here.transmission_error) / step;
      const double behind = (here.transmission_error - contact_at(minutes, phi1 - step).transmission_error) / step;
      constexpr double kRoundOff = 1e-13 / step;
      CHECK(here.slope >= std::min(ahead, behind) - kRoundOff);
      CHECK(here.slope <= std::max(ahead, behind) + kRoundOff);
    }
    // The user's run on both sides.
    const auto mesh_at = [](double minutes) {
      return run("edge_surface_corner", {{"misalignment.crossing", in_digits(minutes)}}).unloaded.front().mesh;
    };
    const UnloadedMesh left = mesh_at(before), right = mesh_at(after);
    for (std::size_t j = 0; j < left.transmission_error.size(); ++j) {
      CHECK(std::abs(left.transmission_error[j] - right.transmission_error[j]) <= kUnloadedRoundOff);
    }
  }
  CHECK(transitions >= 2);
}

TEST_CASE("Hard: a designed parabola fades in proportion to its coefficient", "[hard_cases][slow]") {
  for (double a = 0.1; a > 1e-13; a *= 0.01) {
    const double found = peak_to_peak("parabola_to_zero", {{"pinion.modification.parabolic_te", in_digits(a)}});
    const double expected = a * (180.0 / 22) * (180.0 / 22) * arcsec;
    CAPTURE(a);
    CHECK(std::abs(found - expected) <= 1e-9 * expected + kUnloadedRoundOff);
  }
  CHECK(peak_to_peak("parabola_to_zero", {{"pinion.modification.parabolic_te", "0"}}) <= kUnloadedRoundOff);
}

TEST_CASE("Hard: a tooth that winds around its gear is not taken for another at its far end", "[hard_cases][slow]") {
  const auto results = run("teeth_that_wind_around", {{"cycle.peaks", "sampled"}});
  REQUIRE(results.pair.total_contact_ratio() > results.pair.data.pinion.teeth);
  check_balances(results);
  const UnloadedMesh& mesh = results.unloaded.front().mesh;
  CHECK(mesh.missing == 0);
  // The lead angle turns the flanks over half the face about the base helix, and moves the base circle beside it: twice its reach is plenty,
  // and a tenth of a pitch.
  const double reach = 16.6 * arcmin * results.pair.pinion.data.face_width;  // mm
  for (const PairCurve& curve : mesh.pairs) {
    for (const ToothContact& contact : curve.positions) {
      if (contact.exists()) CHECK(std::abs(contact.transmission_error) * results.pair.wheel.base_radius <= 2.0 * reach);
    }
  }
  const auto aligned = run("teeth_that_wind_around", {{"cycle.peaks", "sampled"}, {"misalignment.pinion_lead_angle", "0"}});
  CHECK(aligned.unloaded.front().mesh.peak_to_peak <= kUnloadedRoundOff);
}

TEST_CASE("Hard: an edge that runs along its mate before the path begins takes the lead without a step", "[hard_cases]") {
  const auto results_at = [](const std::string& positions) { return run("edge_before_the_path", {{"cycle.positions", positions}}); };
  const auto results = results_at("12");
  const studies::Study base = study("edge_before_the_path");
  REQUIRE(results.pair.pinion.fillet_interference);
  const FlankAssembly scene = assemble_flanks(results.pair, {.modification = base.modification});
  const UnloadedMesh& mesh = results.unloaded.front().mesh;
  CHECK(mesh.missing == 0);
  for (std::size_t i = 0; i < mesh.phi1.size(); ++i) {
    double highest = -1.0;  // rad
    for (int tooth = -5; tooth <= 5; ++tooth) {
      const ToothContact contact = find_tooth_contact(scene, tooth, mesh.phi1[i]);
      if (contact.exists()) highest = std::max(highest, contact.transmission_error);
    }
    CHECK(std::abs(mesh.transmission_error[i] - highest) <= kUnloadedRoundOff);
  }
  REQUIRE(mesh.transfers.size() == 1);
  const Transfer& transfer = mesh.transfers.front();
  const ToothContact leaving = find_tooth_contact(scene, transfer.from_tooth, transfer.phi1);
  CHECK(find_tooth_contact(scene, transfer.to_tooth, transfer.phi1).kind == ContactKind::WheelTip);
  constexpr double kLocated = 1e-11;  // rad: the pinion's angle to 1e-13 rad, times the slope of an edge, and the lead itself
  CHECK(std::abs(transfer.transmission_error - leaving.transmission_error) <= kLocated);
  CHECK(transfer.slope_jump() > 0.0);
  // More than half a pitch before A, where the path begins.
  const PathOfContact path(results.pair);
  CHECK(path.line_phase_at(transfer.phi1, results.pair) + transfer.to_tooth < path.before - 0.5);
  // Extremes are located, whatever the positions; so is the transfer point.
  const auto finer = results_at("48");
  CHECK(std::abs(finer.unloaded.front().mesh.peak_to_peak - mesh.peak_to_peak) <= kLocated);
  CHECK(std::abs(results_at("2").unloaded.front().mesh.transfers.at(0).phi1 - transfer.phi1) <= kLocated);
}

TEST_CASE("Hard: a relief that beyond the tip is steeper than the flank overflows nothing", "[hard_cases][slow]") {
  const std::string gap = GENERATE("plane_of_action", "whole_surface");
  for (const double height : {0.2, 0.16, 0.14, 0.12, 0.1, 0.085}) {
    const auto results = run("relief_steeper_than_the_flank",
                             {{"wheel.modification.tip_relief.height", in_digits(height)}, {"fidelity.gap", gap}, {"cycle.peaks", "sampled"}});
    check_balances(results);
    CAPTURE(gap, height);
    const UnloadedMesh& mesh = results.unloaded.front().mesh;
    CHECK(mesh.missing == 0);
    // So short a relief leaves more than a base pitch of the path untouched: some pair always touches without error.
    CHECK(std::abs(mesh.largest) <= kUnloadedRoundOff);
    CHECK(mesh.peak_to_peak <= kUnloadedRoundOff);
  }
}

TEST_CASE("Hard: flanks pass from convex through flat to hollow without a jump", "[hard_cases][slow]") {
  std::vector<double> last;
  for (double amount = 0.0; amount <= 40.0; amount += 2.0) {
    const auto results = run("conformal_flanks", {{"pinion.modification.profile_crowning", in_digits(-amount)}, {"cycle.peaks", "sampled"}});
    check_balances(results);
    const UnloadedMesh& mesh = results.unloaded.front().mesh;
    REQUIRE(mesh.missing == 0);
    CAPTURE(amount);
    // Metal moves the wheel ahead, by no more than what was added since the last amount: 2 um at the ends of the active profile, a
    // little more on the way to the form circle.
    for (std::size_t i = 0; i < last.size(); ++i) {
      const double rise = mesh.transmission_error[i] - last[i];
      CHECK(rise >= -kUnloadedRoundOff);
      CHECK(rise <= 1.1 * 2.0 * um / results.pair.wheel.base_radius + kUnloadedRoundOff);
    }
    last = mesh.transmission_error;
    // Both ways to the first touch: the nearest of all points, and the maximum of the wheel's angle.
    const studies::LoadedResult& loaded = results.loaded.front();
    const FlankAssembly scene = assemble_flanks(results.pair, {.modification = {results.study.modification.pinion, {}}});
    const PathOfContact path(results.pair);
    for (const LoadedPosition& position : loaded.cycle.positions) {
      const double phi1 = path.pinion_angle_at(position.phase, results.pair);
      double te = -1.0;
      for (int tooth = -3; tooth <= 5; ++tooth) {
        const ToothContact contact = find_tooth_contact(scene, tooth, phi1);
        if (contact.exists()) te = std::max(te, contact.transmission_error);
      }
      CHECK(std::abs(position.gap.total.minCoeff() + te * results.pair.wheel.base_radius) <= 1e-11);  // mm: round-off
    }
  }
}
