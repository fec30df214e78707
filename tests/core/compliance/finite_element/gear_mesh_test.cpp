#include "core/compliance/finite_element/gear_mesh.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "tests/core/compliance/finite_element/block_mesh.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"

using namespace flankwright;
using namespace flankwright::test;
using units::pi;

TEST_CASE("Every node of flank and fillet lies on the exact profile", "[core][compliance][fe]") {
  const GearMesh mesh = gear_mesh(gear_of(18, 30, 6, 0.2));
  const ToothForm& form = mesh.form;
  const double turn = std::tan(form.helix_angle()) / form.reference_radius();
  for (int m = -2; m <= 2; ++m) {
    const ToothSurfaces& surfaces = mesh.surfaces(m);
    const auto angle_of = [&](const Eigen::Vector3d& p) {  // clockwise from the tooth's centre line
      const double angle = std::atan2(p.x(), p.y()) + turn * p.z() + m * 2 * pi / mesh.teeth;
      return std::remainder(angle, 2 * pi);
    };
    double worst = 0;
    for (const auto* faces : {&surfaces.flank, &surfaces.fillet}) {
      for (const MeshFace& face : *faces) {
        const FaceNodes nodes = mesh.face_nodes(face);
        for (int i = 0; i < 8; ++i) {
          const double r = nodes.col(i).head<2>().norm();
          if (r < form.root_radius() + 1e-9) continue;  // the fillet's lowest point or a land joined to it
          worst = std::max(worst, std::abs(angle_of(nodes.col(i)) - form.half_angle(std::max(r, form.root_radius()))));
        }
      }
    }
    // Round-off, magnified where the fillet is all but a circle around the axis; of adjacent teeth nodes that are tied to longer elements
    // lie on these, quadratic along a helix.
    const bool loaded = m == 0;
    CHECK(worst < (loaded ? 1e-9 : 1e-5));
    for (const MeshFace& face : surfaces.centre) {
      const FaceNodes nodes = mesh.face_nodes(face);
      for (int i = 0; i < 8; ++i) REQUIRE(std::abs(angle_of(nodes.col(i))) < 1e-5);
    }
  }
}

TEST_CASE("The mesh fills the gear: its volume is that of teeth, ring and shaft", "[core][compliance][fe]") {
  const GearMesh mesh = gear_mesh(gear_of(18, 30));
  double volume = 0;
  integrate(mesh.solid, [&](Eigen::Index, const BrickShape&, const Eigen::Vector3d&, const auto&, double weight) { volume += weight; });
  const ToothForm& form = mesh.form;
  // Section of a tooth above the root circle: polar area of its profile, by the midpoint rule in angle over radius.
  double tooth = 0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double r = form.root_radius() + (form.tip_radius() - form.root_radius()) * (i + 0.5) / kSteps;
    tooth += 2 * form.half_angle(r) * r * (form.tip_radius() - form.root_radius()) / kSteps;
  }
  const double shaft = default_shaft_diameter(form, 1) / 2, bore = 0.05 * shaft;
  const double area = 5 * tooth + pi * (form.root_radius() * form.root_radius() - bore * bore);
  const double expected = 6 * area + 2 * shaft * pi * (shaft * shaft - bore * bore);
  CHECK(volume == Approx(expected).epsilon(1e-4));  // discretisation: quadratic elements around circles
}

TEST_CASE("Gears of all shapes can be meshed without a folded element", "[core][compliance][fe]") {
  const int teeth = GENERATE(10, 17, 31, 60, 150);
  const double helix = GENERATE(0.0, 20.0, 40.0);
  const double shift = GENERATE(-0.3, 0.0, 0.6);
  CAPTURE(teeth, helix, shift);
  GearToMesh gear = gear_of(teeth, helix, 3, shift);
  if (teeth == 10 && shift > 0) gear.gear.tip_diameter = 2 * ToothForm(gear.gear, 1, gear.pressure_angle, gear.helix_angle).tip_radius() - 0.5;
  CHECK(gear_mesh(gear, coarse()).solid.quality() > 0.02);
}

TEST_CASE("Racks, faces and bodies of all kinds can be meshed", "[core][compliance][fe]") {
  GearToMesh gear = gear_of(25, 15, GENERATE(2, 30));
  SECTION("full tip rounding") { gear.gear.rack.root_radius = full_tip_rounding(gear.gear.rack.dedendum, gear.pressure_angle); }
  SECTION("sharp tool") { gear.gear.rack.root_radius = 0; }
  SECTION("high teeth") { gear.gear.rack = {1.3, 1.55, 0.2}; }
  SECTION("wide bore") { gear.body.bore_diameter = 0.8 * 20; }
  SECTION("thin shaft") { gear.body.shaft_diameter = 5; }
  SECTION("15 deg") { gear.pressure_angle = 15 * units::deg; }
  SECTION("25 deg") {
    gear.pressure_angle = 25 * units::deg;
    gear.gear.rack.root_radius = 0.3;
  }
  CHECK(gear_mesh(gear, coarse()).solid.quality() > 0.02);
}

TEST_CASE("A wide face has longer layers in the middle and no more of them", "[core][compliance][fe]") {
  GearMeshOptions options = coarse();
  options.end_element = 0.2;
  options.largest_element = 0.5;
  options.most_layers = 20;
  const GearMesh narrow = gear_mesh(gear_of(18, 30, 6), options), wide = gear_mesh(gear_of(18, 30, 30), options);
  CHECK(narrow.planes.size() < 21);
  CHECK(wide.planes.size() == 21);
  for (const GearMesh* mesh : {&narrow, &wide}) {
    const std::vector<double>& z = mesh->planes;
    CHECK(z.front() == -mesh->face_width / 2);
    CHECK(z.back() == mesh->face_width / 2);
    CHECK(z[1] - z[0] == Approx(0.2).epsilon(0.25));  // sizes are scaled to fill the face
    for (std::size_t i = 1; i + 1 < z.size() / 2; ++i) CHECK(z[i + 1] - z[i] > z[i] - z[i - 1] - 1e-12);
  }
}

TEST_CASE("A gear that cannot be meshed is refused by the name of the wrong quantity", "[core][compliance][fe]") {
  const auto field = [](const GearToMesh& gear, const GearMeshOptions& options = coarse()) {
    try {
      gear_mesh(gear, options);
    } catch (const InvalidInput& error) {
      return error.field();
    }
    return std::string();
  };
  CHECK(field(gear_of(20, 10)).empty());
  CHECK(field(gear_of(10, 0, 6, 0.9)) == "tip_diameter");  // pointed
  GearToMesh gear = gear_of(20, 10);
  gear.gear.face_width = 0;
  CHECK(field(gear) == "face_width");
  gear = gear_of(20, 10);
  gear.body.shaft_diameter = 18;
  CHECK(field(gear) == "body.shaft_diameter");
  gear.body.shaft_diameter = 10;
  gear.body.bore_diameter = 10;
  CHECK(field(gear) == "body.bore_diameter");
  gear.body.bore_diameter = not_given;
  gear.body.shaft_overhang = -1;
  CHECK(field(gear) == "body.shaft_overhang");
  GearMeshOptions options = coarse();
  options.axial_growth = 1;
  CHECK(field(gear_of(20, 10), options) == "options.axial_growth");
  options = coarse();
  options.most_layers = 3;
  CHECK(field(gear_of(20, 10), options) == "options.most_layers");
  options = coarse();
  options.teeth_each_side = 10;
  CHECK(field(gear_of(20, 10), options) == "options.teeth_each_side");
}
