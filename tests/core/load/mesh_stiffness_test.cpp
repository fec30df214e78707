#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;
using mesh_cases::torque_for;

namespace {

CycleSummary summary_at(const GearPair& gears, double line_load, int positions = 64, const MeshEffects& effects = {}) {
  const MeshModel model = mesh_cases::model(gears, {{}, equally_spaced_phases(positions)}, effects);
  return summarise(model, analyse_cycle(model, {}, torque_for(gears, line_load)));
}

}  // namespace

TEST_CASE("The mean stiffness of an unmodified spur pair is near ISO's c_gamma", "[core][load][iso]") {
  // Model: c_gamma takes every pair as stiff as at the pitch point and 0.75 of it for the second.
  constexpr double kModel = 0.10;
  const int z1 = GENERATE(18, 20, 30, 60);
  const int ratio = GENERATE(1, 2, 4);
  const GearPair gears = mesh_cases::pair(z1, z1 * ratio, 0, 4, 40);
  const MeshModel model = mesh_cases::model(gears, {{}, {0.5}});
  const double stiffness = summary_at(gears, 300.0).mean_stiffness;
  CAPTURE(z1, ratio, stiffness, model.iso.c_gamma, stiffness / model.iso.c_gamma);
  CHECK(stiffness == Approx(model.iso.c_gamma).epsilon(kModel));
}

TEST_CASE("A single pair at the pitch point is as stiff as ISO's c'", "[core][load][iso]") {
  constexpr double kModel = 1e-3;  // the load there is 300 N/mm, that of the calibration, and all of it on one pair
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const double phase = (gears.pitch_point - gears.path_start) / gears.transverse_base_pitch + PathOfContact::extension;
  const MeshModel model = mesh_cases::model(gears, {{}, {phase}}, MeshEffects::all_but({"tip_corner", "free_ends"}));
  const LoadedCycle cycle = analyse_cycle(model, {}, torque_for(gears, 300.0));
  CHECK(cycle.positions[0].stiffness == Approx(model.iso.c_prime).epsilon(kModel));
}

TEST_CASE("Tenfold load stiffens an unmodified mesh by no more than Hertz allows", "[core][load]") {
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const auto rise = [&](const MeshEffects& effects) {
    return summary_at(gears, 1000.0, 64, effects).mean_stiffness / summary_at(gears, 100.0, 64, effects).mean_stiffness;
  };
  // Hertzian deflection per load falls by A ln(10) over both gears; structure and length of the contact lines stay.
  const MeshEffects on_path = MeshEffects::all_but({"extended_contact_region"});
  const double mean = summary_at(gears, 1000.0, 64, on_path).mean_stiffness;
  const double relief = 2 * 2 * (1 - 0.09) / (units::pi * 206000.0) * 0.5 * std::log(10.0) * 1e3;  // mm um / N
  CAPTURE(rise(on_path), rise({}));
  CHECK(rise(on_path) > 1.0);
  CHECK(rise(on_path) < 1.0 + relief * mean);  // all the load on one pair; where two share it, less
  // Tips that come into contact early lengthen the path, and make the mesh stiffer still.
  CHECK(rise({}) > rise(on_path));
  CHECK(rise({}) < 1.25);
}

TEST_CASE("Twice the face under twice the torque is the same spur mesh", "[core][load]") {
  constexpr double kRoundOff = 1e-9;
  const MeshEffects endless = MeshEffects::all_but({"free_ends"});
  const CycleSummary narrow = summary_at(mesh_cases::pair(20, 40, 0, 4, 30), 200.0, 16, endless);
  const CycleSummary wide = summary_at(mesh_cases::pair(20, 40, 0, 4, 60), 200.0, 16, endless);
  CHECK(wide.mean_stiffness == Approx(narrow.mean_stiffness).epsilon(kRoundOff));
  CHECK(wide.te_peak_to_peak == Approx(narrow.te_peak_to_peak).epsilon(kRoundOff));
  CHECK(wide.peak_contact_stress == Approx(narrow.peak_contact_stress).epsilon(kRoundOff));
}

TEST_CASE("Contacts of twice the size under twice the line load deflect twice as much at the same stress", "[core][load]") {
  // Similarity: the contact law has no length in it but the ratio of depth to half width, which stays. Not so with
  // bending, whose calibration to ISO happens at one line load for all modules.
  constexpr double kRoundOff = 1e-9;
  const MeshEffects contact_only = MeshEffects::all_but({"bending"});
  const GearPair small = mesh_cases::pair(20, 40, 0, 4, 30), large = mesh_cases::pair(20, 40, 0, 8, 60);
  const CycleSummary a = summary_at(small, 150.0, 16, contact_only), b = summary_at(large, 300.0, 16, contact_only);
  CHECK(b.te_peak_to_peak == Approx(2.0 * a.te_peak_to_peak).epsilon(kRoundOff));
  CHECK(b.te_mean == Approx(2.0 * a.te_mean).epsilon(kRoundOff));
  CHECK(b.peak_contact_stress == Approx(a.peak_contact_stress).epsilon(kRoundOff));
  CHECK(b.mean_stiffness == Approx(a.mean_stiffness).epsilon(kRoundOff));
}
