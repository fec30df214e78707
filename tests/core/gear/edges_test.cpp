#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <string>

#include "core/contact/assembly/flank_assembly.hpp"
#include "core/contact/unloaded/tooth_contact.hpp"
#include "core/gear/gear_pair.hpp"
#include "core/load/cycle/mesh_cycle.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

namespace {

PairData rounded_ends(double helix_angle, double rounding) {
  PairData data = mesh_cases::pair_data(25, 50, helix_angle, 3, 20);
  data.pinion.end_rounding = data.wheel.end_rounding = rounding;
  return data;
}

/// What a ball of radius r that touches the flank's tangent plane and a plane of normal m, `by` inside of the end face, leaves untouched of the
/// flank, along the axis: the planes themselves in space, without any angle between them.
double taken_off(const GearPair& pair, bool acute, double r, const Eigen::Vector3d& m, double by) {
  const double beta = acute ? -pair.base_helix_angle : pair.base_helix_angle;  // the flank's outward normal leans to the end face or away from it
  const Eigen::Vector3d n(std::cos(beta), 0.0, std::sin(beta)), axis = Eigen::Vector3d::UnitZ(), edge = n.cross(axis).normalized();
  // The corner of flank and flat: in the flank's plane through the origin, `by` below the end face z = 0.
  const Eigen::Vector3d along = n.cross(edge) * (n.cross(edge).z() > 0.0 ? 1.0 : -1.0), corner = along * (-by / along.z());
  Eigen::Matrix3d planes;
  planes << n.transpose(), m.transpose(), edge.transpose();
  const Eigen::Vector3d centre = corner + planes.partialPivLu().solve(Eigen::Vector3d(-r, -r, 0.0));
  return -(centre + r * n).z();
}

}  // namespace

TEST_CASE("An end rounding ends the flank where a ball in the corner touches it", "[core][gear][edge]") {
  const double helix = GENERATE(0.0, 15.0, 30.0), r = 0.3;
  const GearPair pair = make_gear_pair(rounded_ends(helix, r));
  const double half = 0.5 * pair.data.pinion.face_width;
  const auto at = [&](bool acute) { return taken_off(pair, acute, r, Eigen::Vector3d::UnitZ(), 0.0); };
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    const FaceRange& face = pair[m].face;
    const bool acute_above = pair.acute_end(m) > 0;
    CHECK(half - face.end == Approx(at(acute_above)).epsilon(1e-13));
    CHECK(half + face.begin == Approx(at(!acute_above)).epsilon(1e-13));
  }
  CHECK(at(true) >= at(false));  // the acute end loses more
  const GearPair sharp = make_gear_pair(rounded_ends(helix, 0.0));
  CHECK(sharp.pinion.face.begin == -half);
  CHECK(sharp.pinion.face.end == half);
}

TEST_CASE("An end chamfer ends the flank where a ball at its edge touches it", "[core][gear][edge]") {
  const double helix = GENERATE(0.0, 20.0), amount = 0.8, r = 0.1, angle = 40 * units::deg;
  PairData data = rounded_ends(helix, 0.0);
  data.pinion.end_chamfer = {amount, angle, r};
  const GearPair pair = make_gear_pair(data);
  // The flat's normal, the end face's turned by the angle towards the flank's about the edge, y.
  const Eigen::Vector3d flat(std::sin(angle), 0.0, std::cos(angle));
  const double half = 0.5 * data.pinion.face_width;
  CHECK(half - pair.pinion.face.end == Approx(taken_off(pair, pair.acute_end(Member::Pinion) > 0, r, flat, amount)).epsilon(1e-13));
  data.pinion.end_chamfer.radius = 0.0;
  CHECK(make_gear_pair(data).pinion.face.width() == Approx(data.pinion.face_width - 2.0 * amount).epsilon(1e-14));
}

TEST_CASE("Usable faces are mirrored by the hand of the helix and the working flank", "[core][gear][edge]") {
  PairData data = rounded_ends(20.0, 0.4);
  const FaceRange right = make_gear_pair(data).pinion.face;
  data.pinion_hand = Hand::Left;
  const FaceRange left = make_gear_pair(data).pinion.face;
  data.working_flank = WorkingFlank::Left;
  const FaceRange coast = make_gear_pair(data).pinion.face;
  CHECK(left.begin == -right.end);
  CHECK(left.end == -right.begin);
  CHECK(coast.begin == right.begin);
  CHECK(coast.end == right.end);
  data.working_flank = WorkingFlank::Right;
  const GearPair behind = make_gear_pair(data).on_other_flanks();
  CHECK(behind.pinion.face.begin == coast.begin);
  CHECK(behind.pinion.face.end == coast.end);
}

TEST_CASE("Loaded and unloaded contact end where the end rounding begins", "[core][load][contact][edge]") {
  const GearPair pair = make_gear_pair(rounded_ends(GENERATE(0.0, 15.0), 0.4));
  const double begin = std::max(pair.pinion.face.begin, pair.wheel.face.begin), end = std::min(pair.pinion.face.end, pair.wheel.face.end);
  const MeshModel model = mesh_cases::model(pair, {{QuadratureRule::Graded, 6}, equally_spaced_phases(8)});
  CHECK(model.face_width == Approx(end - begin).epsilon(1e-14));
  const LoadedCycle cycle = analyse_cycle(model, {}, 150e3);
  for (std::size_t k = 0; k < model.positions.size(); ++k) {
    for (const ContactPoint& point : model.positions[k].points) CHECK((point.z > begin && point.z < end));
    const double carried = cycle.positions[k].load.line_load.dot(model.positions[k].weight);
    CHECK(carried == Approx(model.normal_force(150e3)).epsilon(1e-9));  // round-off of the balance
  }
  // Misaligned, unmodified flanks touch at the end of one of both.
  const FlankAssembly assembly = assemble_flanks(pair, {.misalignment = {.mesh_misalignment = 20 * units::um}});
  const ToothContact contact = find_tooth_contact(assembly, 0, 0.0);
  CAPTURE(contact.pinion_z, contact.kind, begin, end, pair.data.helix_angle);
  REQUIRE((contact.kind == ContactKind::FaceEnd || contact.kind == ContactKind::Corner));  // a corner where a face end and a tip edge meet
  CHECK(contact.pinion_z == Approx(begin).epsilon(1e-9));
}

TEST_CASE("End edges that cannot be are named with what they may be", "[core][gear][edge]") {
  const auto field_of = [](double rounding, const EdgeChamfer& chamfer) {
    PairData data = rounded_ends(20.0, 0.0);
    data.wheel.end_rounding = rounding;
    data.wheel.end_chamfer = chamfer;
    const auto problems = find_problems(data);
    return problems.empty() ? std::string() : problems.front().field();
  };
  CHECK(field_of(0.5, {}).empty());
  CHECK(field_of(-0.5, {}) == "wheel.edges.end_rounding");
  CHECK(field_of(20.0, {}) == "wheel.edges.end_rounding");
  CHECK(field_of(0.0, {.amount = 2.0}).empty());
  CHECK(field_of(0.2, {.amount = 2.0}) == "wheel.edges.end_chamfer.amount");
  CHECK(field_of(0.0, {.amount = 10.0}) == "wheel.edges.end_chamfer.amount");
  CHECK(field_of(0.0, {.amount = 2.0, .angle = 80 * units::deg}) == "wheel.edges.end_chamfer.angle");
}

TEST_CASE("An edge that is too large is told the largest one, which is allowed", "[core][gear][edge]") {
  using Kind = std::function<double&(GearData&)>;
  const auto [field, length] = GENERATE(table<std::string, Kind>({
      {"tip_rounding", [](GearData& gear) -> double& { return gear.tip_rounding; }},
      {"tip_chamfer.amount", [](GearData& gear) -> double& { return gear.tip_chamfer.amount; }},
      {"end_rounding", [](GearData& gear) -> double& { return gear.end_rounding; }},
      {"end_chamfer.amount", [](GearData& gear) -> double& { return gear.end_chamfer.amount; }},
  }));
  const double helix = GENERATE(0.0, 20.0), edge = GENERATE(0.0, 0.1), shift = GENERATE(0.0, 0.4);
  const double too_large = GENERATE(5.0, 50.0);
  CAPTURE(field, helix, edge, shift, too_large);
  PairData data = mesh_cases::pair_data(25, 50, helix, 3, 9);
  data.pinion.profile_shift = shift;
  data.pinion.tip_chamfer.radius = data.pinion.end_chamfer.radius = edge;
  length(data.pinion) = too_large;
  const auto problems = find_problems(data);
  REQUIRE(problems.size() == 1);
  CHECK(problems.front().field() == "pinion.edges." + field);
  const std::string allowed = problems.front().allowed();
  CAPTURE(allowed);
  REQUIRE(allowed.rfind("0 .. ", 0) == 0);
  const double largest = std::stod(allowed.substr(5));
  REQUIRE(largest > 0.1);
  length(data.pinion) = largest;
  CHECK(find_problems(data).empty());
  length(data.pinion) = largest + 2 * units::um;
  CHECK_FALSE(find_problems(data).empty());
}

TEST_CASE("A chamfer beside a rounding is refused in plain words", "[core][gear][edge]") {
  PairData data = rounded_ends(20.0, 0.2);
  data.wheel.end_chamfer.amount = 1.0;
  REQUIRE(find_problems(data).size() == 1);
  CHECK(find_problems(data).front().allowed() == "0 beside an end_rounding: the chamfer's edge has a radius of its own");
}

TEST_CASE("An edge of which nothing is known has a twentieth of the module, less where the tooth is pointed", "[core][gear][edge]") {
  PairData data = mesh_cases::pair_data(25, 50, 15.0, 4, 20);
  CHECK(usual_edge_radius(Member::Pinion, data) == 0.2);
  data.pinion.teeth = 14;
  data.pinion.profile_shift = 0.85;
  const GearPair pointed = make_gear_pair(data);
  REQUIRE(pointed.pinion.tip_thickness < 0.8);
  CHECK(usual_edge_radius(Member::Pinion, data) == Approx(0.25 * pointed.pinion.tip_thickness).epsilon(1e-14));
  CHECK(usual_edge_radius(Member::Pinion, PairData{}) == 0.0);  // data that are not whole yet
}
