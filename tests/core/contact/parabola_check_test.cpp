#include "core/contact/unloaded/parabola_check.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "tests/core/contact/contact_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::contact_cases;
using units::pi;

namespace {

constexpr int kTeeth = 20;
constexpr double kPitch = 2 * pi / kTeeth, kHeight = 1e-3 * kPitch * kPitch / 4;  // of a = 1e-3 1/rad

FlankAssembly any_scene() { return scene_of(make_gear_pair(pair_data(kTeeth, 40, 0.0))); }

/// A mesh whose error is one parabola a pitch with its vertex shifted: what a perfect analysis would return.
UnloadedMesh parabolic_mesh(double a, double shift, double offset, ContactKind kind = ContactKind::Surface) {
  UnloadedMesh mesh;
  const int positions = 32;
  const double transfer_point = shift > 0.0 ? shift - 0.5 * kPitch : shift + 0.5 * kPitch;  // inside the pitch analysed
  const auto error = [&](double angle) { return offset - a * (angle - shift) * (angle - shift); };
  // Tooth k leads while phi1 + k pitch lies within half a pitch of the vertex; the earlier one is the one that runs
  // ahead.
  const int first = shift > 0.0 ? 1 : 0, second = first - 1;
  PairCurve early{first, {}}, late{second, {}};
  for (int i = 0; i < positions; ++i) {
    const double phi1 = kPitch * (static_cast<double>(i) / positions - 0.5);
    const int tooth = phi1 < transfer_point ? first : second;
    ToothContact contact;
    contact.kind = kind;
    contact.tooth = tooth;
    contact.phi1 = phi1;
    contact.transmission_error = error(phi1 + tooth * kPitch);
    (tooth == first ? early : late).positions.push_back(contact);
    mesh.phi1.push_back(phi1);
    mesh.transmission_error.push_back(contact.transmission_error);
  }
  mesh.pairs = {late, early};
  Transfer transfer;
  transfer.phi1 = transfer_point;
  transfer.from_tooth = first;
  transfer.to_tooth = second;
  transfer.transmission_error = error(transfer_point + first * kPitch);
  transfer.slope_before = -2 * a * (transfer_point + first * kPitch - shift);
  transfer.slope_after = -2 * a * (transfer_point + second * kPitch - shift);
  mesh.transfers = {transfer};
  return mesh;
}

}  // namespace

TEST_CASE("A shifted parabola is found again, to round-off", "[core][contact][closed-form]") {
  const double shift = GENERATE(-0.3, -0.05, 0.08, 0.4) * kPitch, a = GENERATE(1e-3, 1.05e-3), offset = GENERATE(0.0, 2e-5);
  const ParabolaCheck check = check_parabola(any_scene(), parabolic_mesh(a, shift, offset), 1e-3);
  CAPTURE(shift / kPitch, check.why);
  CHECK(check.wanted == 1e-3);
  CHECK(std::abs(check.found / a - 1) <= 1e-10);
  CHECK(std::abs(check.shift - shift) <= 1e-10 * kPitch);
  CHECK(check.residual <= 1e-10 * kHeight);
  CHECK(check.right_sign);
  CHECK(check.holds);
  CHECK(check.why.empty());
}

TEST_CASE("The residual is the largest distance from the best parabola, transfer points included", "[core][contact][closed-form]") {
  UnloadedMesh mesh = parabolic_mesh(1e-3, 0.1 * kPitch, 0.0);
  mesh.transfers[0].transmission_error -= 0.03 * kHeight;
  ParabolaCheck check = check_parabola(any_scene(), mesh, 1e-3);
  CHECK(std::abs(check.residual / kHeight - 0.03) <= 1e-9);
  CHECK(check.holds);
  mesh.transfers[0].transmission_error -= 0.03 * kHeight;
  check = check_parabola(any_scene(), mesh, 1e-3);
  CHECK(std::abs(check.residual / kHeight - 0.06) <= 1e-9);
  CHECK_FALSE(check.holds);
  CHECK(check.right_sign);
  CHECK(check.why == "the arc departs from its parabola by 6 % of its height");
}

TEST_CASE("A parabola other than the designed one is not achieved, and its deviation is reported", "[core][contact]") {
  const ParabolaCheck check = check_parabola(any_scene(), parabolic_mesh(0.85e-3, 0.05 * kPitch, 0.0), 1e-3);
  CHECK(check.right_sign);
  CHECK_FALSE(check.holds);
  CHECK(check.why == "the parabola's coefficient differs by -15 % from the one asked for");
}

TEST_CASE("Slopes of the wrong sign at a transfer point are an impact", "[core][contact]") {
  UnloadedMesh mesh = parabolic_mesh(1e-3, 0.05 * kPitch, 0.0, ContactKind::PinionTip);
  mesh.transfers[0].slope_before = 1e-5;
  ParabolaCheck check = check_parabola(any_scene(), mesh, 1e-3);
  CHECK_FALSE(check.right_sign);
  CHECK_FALSE(check.holds);
  CHECK(check.why ==
        "the pair that leaves still gains at the transfer point at -8.100 deg; contact runs on a tip or root edge over "
        "100 % of the pitch: a larger parabola shifts less");
  mesh.transfers[0].slope_before = -1e-5;
  mesh.transfers[0].slope_after = -1e-6;
  check = check_parabola(any_scene(), mesh, 1e-3);
  CHECK_FALSE(check.right_sign);
  CHECK(check.why.rfind("the pair that enters still falls behind at the transfer point at -8.100 deg", 0) == 0);
  mesh.transfers[0].slope_after = NAN;  // an unknown slope is not a right one
  CHECK_FALSE(check_parabola(any_scene(), mesh, 1e-3).right_sign);
}

TEST_CASE("An aligned pair has one transfer point, at the very end of its pitch", "[core][contact][symmetry]") {
  Modification parabola;
  parabola.parabolic_te = 1e-3;
  parabola.lead_crowning = 0.01;
  const GearPair pair = make_gear_pair(pair_data(kTeeth, 40, 0.0));
  const FlankAssembly scene = scene_of(pair, {}, parabola);
  const UnloadedMesh mesh = analyse_unloaded_mesh(pair, scene, 32);
  REQUIRE(mesh.transfers.size() == 1);
  CHECK(std::abs(mesh.transfers[0].phi1 - 0.5 * kPitch) <= 1e-6 * kPitch);
  CHECK(mesh.transfers[0].from_tooth == 0);
  CHECK(mesh.transfers[0].to_tooth == -1);
  const ParabolaCheck check = check_parabola(scene, mesh, 1e-3);
  CAPTURE(check.why);
  CHECK(check.right_sign);
  CHECK(check.holds);
  CHECK(std::abs(check.shift) <= 1e-6 * kPitch);
}

TEST_CASE("Pairs that share the lead have no parabola", "[core][contact]") {
  UnloadedMesh mesh = parabolic_mesh(1e-3, 0.0, 0.0);
  mesh.transfers.clear();
  const ParabolaCheck check = check_parabola(any_scene(), mesh, 1e-3);
  CHECK_FALSE(check.holds);
  CHECK(std::isnan(check.found));
  CHECK(check.why.rfind("no transfer point", 0) == 0);
}

TEST_CASE("A parabola traced by the face end does not hold: the line of contact has no crown to lean on", "[core][contact]") {
  const ParabolaCheck check = check_parabola(any_scene(), parabolic_mesh(1e-3, 0.05 * kPitch, 0.0, ContactKind::FaceEnd), 1e-3);
  CHECK(check.right_sign);
  CHECK(check.residual <= 1e-10 * kHeight);
  CHECK_FALSE(check.holds);
  CHECK(check.why ==
        "the parabola is there, but not on the flanks; contact runs on a face end over 100 % of the pitch: more lead "
        "crowning or less misalignment");
}

TEST_CASE("A mesh that loses contact, a zero coefficient and too few positions have different reasons", "[core][contact]") {
  UnloadedMesh mesh = parabolic_mesh(1e-3, 0.05 * kPitch, 0.0);
  CHECK_THROWS_AS(check_parabola(any_scene(), mesh, 0.0), InvalidInput);
  CHECK_THROWS_AS(check_parabola(any_scene(), mesh, NAN), InvalidInput);
  CHECK_THROWS_AS(check_parabola(any_scene(), UnloadedMesh{}, 1e-3), InvalidInput);
  mesh.missing = 3;
  const ParabolaCheck check = check_parabola(any_scene(), mesh, 1e-3);
  CHECK_FALSE(check.holds);
  CHECK(std::isnan(check.found));
  CHECK(check.why == "no tooth pair touches at 3 positions: the contact ratio is below 1");
}
