#include "core/compliance/pair/pair_rim_motion.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>

#include "core/compliance/model/compliance_task.hpp"
#include "core/compliance/pair/pair_compliance.hpp"
#include "core/contact/path/path_of_contact.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/core/gear/pair_cases.hpp"

using namespace flankwright;

namespace {

constexpr double kRimModule = 2, kRimWidth = 16, kRimModulus = 206000;

/// Just fine enough for a body.
GearMeshOptions rim_mesh() {
  GearMeshOptions options;
  options.flank_elements = 2;
  options.fillet_elements = 2;
  options.half_thickness_elements = 1;
  options.adjacent_flank_elements = 1;
  options.adjacent_fillet_elements = 2;
  options.end_element = 0.8;
  options.largest_element = 1.2;
  return options;
}

InfluenceTableRun solved(const ComplianceTask& task, Member member) {
  InfluenceTableTask run = influence_table_task(task, member);
  run.mesh = rim_mesh();
  const double width = run.grid.face_width();
  run.grid = StationGrid({-1, -0.3, 0.3, 1}, {0, 0.2 * width, 0.5 * width, 0.8 * width, width});
  return solve_influence_table(run, std::numeric_limits<double>::infinity());
}

std::shared_ptr<const InfluenceTable> shared(InfluenceTableRun&& run) { return std::make_shared<const InfluenceTable>(std::move(*run.table)); }

GearPair pair_with(double helix_deg, Hand hand, WorkingFlank flank) {
  PairData data = pair_cases::pair_data(33, 33, helix_deg, kRimModule, kRimWidth);
  data.pinion_hand = hand;
  data.working_flank = flank;
  return make_gear_pair(data);
}

}  // namespace

TEST_CASE("The rims' misalignment is what the influence matrix tilts the flanks by, in the frame of the pair", "[core][compliance][body]") {
  const auto [helix, hand, flank] = GENERATE(std::tuple{0.0, Hand::Right, WorkingFlank::Left}, std::tuple{12.0, Hand::Right, WorkingFlank::Right},
                                             std::tuple{12.0, Hand::Left, WorkingFlank::Right}, std::tuple{12.0, Hand::Right, WorkingFlank::Left});
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  CAPTURE(helix, hand == Hand::Right, flank == WorkingFlank::Right, name_of(member));
  const GearPair pair = pair_with(helix, hand, flank);
  ComplianceTask solid{.pair = pair, .model = ComplianceModel::Fe}, webbed = solid;
  for (ComplianceTask* task : {&solid, &webbed}) task->body[member] = {.bore_diameter = 20, .hold = BodyHold::RigidBore};
  webbed.body[member].web = WebbedBody{.rim_thickness = 6, .web_thickness = 4, .web_offset = 5, .hub_diameter = 26};

  InfluenceTableRun on_web = solved(webbed, member);
  REQUIRE(on_web.rim_motion);
  const PairRimMotion::Rim rim{std::make_shared<const RimMotionTable>(std::move(*on_web.rim_motion)), kRimModulus};
  PerGear<PairRimMotion::Rim> rims;
  rims[member] = rim;
  const PairRimMotion motions(pair, rims);
  const Member other = member == Member::Pinion ? Member::Wheel : Member::Pinion;
  CHECK(!motions.has_rim(other));
  // The mate's part falls out of the difference; gears of equal teeth have equal tables.
  const std::shared_ptr<const InfluenceTable> solid_table = shared(solved(solid, member));
  const auto influence = [&](std::shared_ptr<const InfluenceTable> table, const std::vector<ContactPoint>& points) {
    const GearStructure own{std::move(table), kRimModulus}, mate{solid_table, kRimModulus};
    return member == Member::Pinion ? StructuralPair(pair, own, mate).influence(points, 0) : StructuralPair(pair, mate, own).influence(points, 0);
  };
  const std::vector<ContactPoint> points =
      contact_points(pair, PathOfContact(pair), {QuadratureRule::Gauss2, 4}, 1.0, false, -kRimWidth / 2, kRimWidth / 2);
  // An even load. What the web adds to the flanks' deflection, along z.
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::VectorXd forces(count), z(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    forces[i] = 100 * points[static_cast<std::size_t>(i)].weight;
    z[i] = points[static_cast<std::size_t>(i)].z;
  }
  const Eigen::VectorXd added = (influence(shared(std::move(on_web)), points) - influence(solid_table, points)) * forces;
  const Eigen::VectorXd from_middle = z.array() - z.mean();
  const double slope = from_middle.dot(added) / from_middle.squaredNorm() / std::cos(pair.base_helix_angle);

  const RimMotion motion = motions.motion(member, points, forces, 0);
  CAPTURE(slope * kRimWidth, motion.misalignment, motion.misalignment_at_teeth, motion.tilt, motion.radial, motion.axial);
  // Model: of a helical pair the line crosses the flank, and the rim below the teeth is bent as well as turned.
  CHECK(motion.misalignment_at_teeth == Approx(slope * kRimWidth).epsilon(0.25));
  // The web is at +z: the teeth are pushed away from the mate more at -z, and the mesh is closed at +z.
  CHECK(motion.misalignment_at_teeth < 0);
  if (helix == 0) CHECK(motion.radial > 0);  // away from the mate; the axial force of a helical gear tilts its rim about the web
  CHECK(motion.tilt * kRimWidth > std::abs(motion.misalignment));
  if (helix > 0) CHECK(motion.axial * pair.acute_end(member) > 0);  // the flank's outward normal points away from the acute end
  // Linear in the forces, and nothing without.
  constexpr double round_off = 1e-12;
  const RimMotion twice = motions.motion(member, points, 2 * forces, 0), none = motions.motion(member, points, 0 * forces, 0);
  CHECK(twice.misalignment == Approx(2 * motion.misalignment).epsilon(round_off));
  CHECK(twice.tilt == Approx(2 * motion.tilt).epsilon(round_off));
  CHECK(none.tilt == 0);
  CHECK(std::isnan(motions.motion(other, points, forces, 0).tilt));
}
