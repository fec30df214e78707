#include "core/compliance/finite_element/section_sweep.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "core/compliance/finite_element/influence.hpp"
#include "tests/core/compliance/finite_element/block_mesh.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"
#include "tests/core/compliance/finite_element/patch_test.hpp"

using namespace flankwright;
using namespace flankwright::test;

namespace {

/// Short layers beside long elements: joined ones of 2, 4 and more.
GearMeshOptions short_layers(double layer_share) {
  GearMeshOptions options = coarse();
  options.end_element = 0.15;
  options.axial_growth = 1.4;
  options.largest_element = 0.25;
  options.layer_share = layer_share;
  return options;
}

}  // namespace

TEST_CASE("Where short layers meet joined ones an even stress stays even (patch test)", "[core][compliance][fe]") {
  GearToMesh gear = gear_of(30, 25, 5);
  gear.body.shaft_diameter = 12;
  const SolidMesh mesh = gear_mesh(gear, short_layers(0.75)).solid;
  REQUIRE(mesh.tied.size() > 400);
  const ToothForm form(gear.gear, gear.normal_module, gear.pressure_angle, gear.helix_angle);
  REQUIRE(section_mesh(form, 30, 1, 5, gear.body, short_layers(0.75)).ties.size() > 10);  // elements side by side are joined, too
  CHECK(even_strain_error(mesh, 15) < 1e-9);                                              // round-off times condition
}

TEST_CASE("Joined layers leave the loaded tooth alone and cost next to nothing of the influence values", "[core][compliance][fe]") {
  const GearToMesh gear = gear_of(30, 25, 5);
  const InfluenceModel whole(gear, kUnit, short_layers(0)), joined(gear, kUnit, short_layers(0.75));
  CHECK(whole.mesh().solid.tied.empty());
  CHECK(3 * joined.solid().unknowns() < 2 * whole.solid().unknowns());

  std::set<int> tied;
  for (const TiedNode& tie : joined.mesh().solid.tied) tied.insert(tie.node);
  const ToothSurfaces &of_whole = whole.mesh().surfaces(0), &of_joined = joined.mesh().surfaces(0);
  CHECK(of_joined.flank.size() == of_whole.flank.size());
  CHECK(of_joined.fillet.size() == of_whole.fillet.size());
  for (const MeshFace& face : of_joined.flank) {
    for (const int node : face) REQUIRE(!tied.contains(node));
  }

  std::vector<FlankPoint> points;
  const ToothForm& form = whole.mesh().form;
  for (const int tooth : {-1, 0, 1}) {
    for (const double height : {0.1, 0.6}) {
      for (const double z : {-2.4, 0.3, 2.0}) points.push_back({tooth, form.form_radius() + height * (form.tip_radius() - form.form_radius()), z});
    }
  }
  const Eigen::MatrixXd K = whole.influence(points).compliance, J = joined.influence(points).compliance;
  // Discretisation error. Of the own tooth what the joined layers of body and adjacent teeth add; the adjacent ones' own values are not used.
  CHECK((J - K).block<6, 6>(6, 6).cwiseAbs().maxCoeff() < 2e-3 * K.block<6, 6>(6, 6).maxCoeff());
  CHECK((J - K).middleRows<6>(6).cwiseAbs().maxCoeff() < 2e-3 * K.block<6, 6>(6, 6).maxCoeff());
  // Joined elements can bend less.
  CHECK((K - J).diagonal().minCoeff() > 0);
}
