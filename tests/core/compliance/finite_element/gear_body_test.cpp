#include "core/compliance/finite_element/gear_body.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/compliance/finite_element/influence.hpp"
#include "core/compliance/finite_element/solve_influence_table.hpp"
#include "tests/core/compliance/finite_element/block_mesh.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"
#include "tests/core/compliance/finite_element/patch_test.hpp"
#include "tests/reference/eigenvalues.hpp"

using namespace flankwright;
using namespace flankwright::test;
using units::pi;

namespace {

/// 40 teeth, b = 8, on a rim of 3 modules and a web of a quarter of the face, the bore held.
GearToMesh webbed(double helix_deg, double offset, double thickness = 2) {
  GearToMesh gear = gear_of(40, helix_deg, 8);
  gear.body.hold = BodyHold::RigidBore;
  gear.body.bore_diameter = 12;
  gear.body.web = WebbedBody{.rim_thickness = 3, .web_thickness = thickness, .web_offset = offset, .hub_diameter = 17};
  return gear;
}

GearMeshOptions body_options() {
  GearMeshOptions options = coarse();
  options.layer_share = 0.75;
  return options;
}

std::vector<FlankPoint> body_points(const GearMesh& mesh, int teeth = 1) {
  std::vector<FlankPoint> result;
  for (int tooth = -teeth; tooth <= teeth; ++tooth) {
    for (const double u : {0.1, 0.9}) {
      for (const double v : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
        result.push_back({tooth, mesh.form.form_radius() + u * (mesh.form.tip_radius() - mesh.form.form_radius()), v * mesh.face_width / 2});
      }
    }
  }
  return result;
}

Eigen::MatrixXd compliance(const GearToMesh& gear, const GearMeshOptions& options = body_options(),
                           RemovedRigidMotion removed = RemovedRigidMotion::None) {
  const InfluenceModel model(gear, kUnit, options);
  const InfluenceMatrix result = model.influence(body_points(model.mesh()), removed);
  REQUIRE(result.status == FactorStatus::Factorised);
  return result.compliance;
}

/// Motion of the rim under unit loads, 12 x points.
Eigen::MatrixXd rim_motions(const InfluenceModel& model, const std::vector<FlankPoint>& points,
                            RemovedRigidMotion removed = RemovedRigidMotion::None) {
  return solve_flank_influence(model.mesh(), model.solid(), model.material(), points, removed, rim_functionals(model.mesh())).readings;
}

std::string refused(const GearToMesh& gear) {
  try {
    gear_mesh(gear, coarse());
  } catch (const InvalidInput& error) {
    return error.field();
  }
  return "";
}

}  // namespace

TEST_CASE("A mesh on a web fills rim, web, hub and shaft and nothing between them", "[core][compliance][fe][body]") {
  GearToMesh gear = webbed(20, 1.5);
  gear.body.web->hub_width = GENERATE(6.0, 8.0, 11.0);
  const bool has_shaft = GENERATE(false, true);
  if (has_shaft) {
    gear.body = {.shaft_diameter = 12, .bore_diameter = 4, .shaft_overhang = 5, .web = gear.body.web};
  }
  const GearMesh mesh = gear_mesh(gear, body_options());
  CHECK(mesh.solid.quality() > 0.02);
  double volume = 0, web = 0;
  const double root = mesh.form.root_radius();
  integrate(mesh.solid, [&](Eigen::Index, const BrickShape&, const Eigen::Vector3d& x, const auto&, double weight) {
    const double r = x.head<2>().norm();
    if (r < root) volume += weight;
    if (r > 8.5 && r < root - 3) {
      web += weight;
      REQUIRE(std::abs(x.z() - 1.5) < 1);
    }
  });
  const auto ring = [](double outer, double inner, double width) { return pi * (outer * outer - inner * inner) * width; };
  const double below_web = std::max(8.0, gear.body.web->hub_width);
  const double hub_and_shaft = ring(8.5, 6, gear.body.web->hub_width) + (has_shaft ? ring(6, 2, below_web + 2 * 5) : 0);
  // Discretisation: quadratic elements of up to 24 deg around circles, and the last fillet elements reach a little above the root circle.
  CHECK(web == Approx(ring(root - 3, 8.5, 2)).epsilon(2e-3));
  CHECK(volume == Approx(ring(root, root - 3, 8) + ring(root - 3, 8.5, 2) + hub_and_shaft).epsilon(3e-3));
}

TEST_CASE("Where parts of a body of different widths meet an even stress stays even (patch test)", "[core][compliance][fe][body][slow]") {
  GearToMesh gear = webbed(25, GENERATE(0.0, 1.5));
  gear.body.web->rim_thickness = GENERATE(1.2, 3.0);  // teeth right above the web, or rings between
  gear.body.web->hub_width = 9;
  gear.body.hold = BodyHold::Shaft;
  gear.body.shaft_diameter = 12;
  gear.body.bore_diameter = 3;
  GearMeshOptions options = coarse();
  options.end_element = 0.15;
  options.largest_element = 0.3;
  const SolidMesh mesh = gear_mesh(gear, options).solid;
  REQUIRE(mesh.tied.size() > 400);
  CHECK(even_strain_error(mesh, 18) < 1e-8);  // round-off times condition
}

TEST_CASE("A web as thick as the face, between a rim and a hub as wide, is a solid disc", "[core][compliance][fe][body]") {
  GearToMesh solid = webbed(15, 0, 8);
  solid.body.web.reset();
  const Eigen::MatrixXd K = compliance(solid), same = compliance(webbed(15, 0, 8));
  // Discretisation: other rings of elements below the teeth.
  CHECK((same - K).cwiseAbs().maxCoeff() < 2e-3 * K.maxCoeff());
}

TEST_CASE("A bore that is held neither yields nor turns", "[core][compliance][fe][body]") {
  GearToMesh gear = gear_of(18, 30);
  gear.body.hold = BodyHold::RigidBore;
  gear.body.bore_diameter = 10;
  const GearMesh mesh = gear_mesh(gear, coarse());
  CHECK(mesh.solid.nodes.row(2).maxCoeff() == Approx(3).epsilon(1e-12));  // no shaft beyond the faces; round-off
  CHECK(axial_hold_compliance(mesh, kUnit, RemovedRigidMotion::None) == 0);
  for (const NodeSupport& support : mesh.supports) {
    REQUIRE(mesh.solid.nodes.col(support.node).head<2>().norm() == Approx(5).epsilon(1e-12));  // round-off
    REQUIRE(support.fixed == std::array{true, true, true});
  }
  // Less of the gear is left to yield the wider the bore is; the elements' rings move with it by a discretisation error far below that.
  GearToMesh wider = gear;
  wider.body.bore_diameter = 12;
  const Eigen::VectorXd narrow_bore = compliance(gear).diagonal(), wide_bore = compliance(wider).diagonal();
  CHECK((narrow_bore - wide_bore).minCoeff() > 0);
}

TEST_CASE("Influence values of a gear on an offset web are symmetric and positive semi-definite", "[core][compliance][fe][body]") {
  GearToMesh gear = webbed(20, 2.5);
  auto removed = RemovedRigidMotion::None;
  if (GENERATE(false, true)) {
    gear.body = {.shaft_diameter = 12, .web = gear.body.web};
    removed = RemovedRigidMotion::TranslationTorsionAndTilt;
  }
  const Eigen::MatrixXd K = compliance(gear, body_options(), removed);
  CHECK(K == K.transpose());
  const Eigen::VectorXd values = symmetric_eigenvalues(K);
  CHECK(values.minCoeff() > -1e-12 * values.maxCoeff());  // round-off
}

TEST_CASE("The less web there is the more the gear yields, under any loads", "[core][compliance][fe][body]") {
  const Eigen::MatrixXd whole = compliance(webbed(15, 0, 8)), thick = compliance(webbed(15, 0, 3)), thin = compliance(webbed(15, 0, 1));
  const auto more = [&](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    const Eigen::VectorXd values = symmetric_eigenvalues(Eigen::MatrixXd(a - b));
    // Discretisation: the meshes are not nested. Exactly, no load yields less where material is taken away.
    CHECK(values.minCoeff() > -5e-3 * values.maxCoeff());
    CHECK((a - b).trace() > 0.1 * b.trace());
  };
  more(thick, whole);
  more(thin, thick);
}

TEST_CASE("Holes make a web softer, by nothing where there are none and as a cut all but through it where they touch",
          "[core][compliance][fe][body]") {
  WebHoles holes{.count = 6, .diameter = 0.001, .circle_diameter = 20};
  CHECK(hole_stiffness({}) == 1);
  const double f = 6 * pi * 0.0005 * 0.0005 / (pi * 20 * 0.001);    // their area over that of their band
  CHECK(1 - hole_stiffness(holes) == Approx(3 * f).epsilon(1e-3));  // the exact limit of few holes, to the next order in f
  holes.diameter = pi * 20 / 6;
  CHECK(hole_stiffness(holes) == Approx(std::pow(1 - pi / 4, 3)).epsilon(1e-13));  // round-off

  const Eigen::MatrixXd plain = compliance(webbed(15, 1));
  const auto with = [&](double diameter) {
    GearToMesh gear = webbed(15, 1);
    gear.body.web->holes = {.count = 8, .diameter = diameter};
    return compliance(gear);
  };
  const Eigen::MatrixXd tiny = with(0.05), wide = with(5);
  CHECK((tiny - plain).cwiseAbs().maxCoeff() < 2e-3 * plain.maxCoeff());  // discretisation: other rings
  CHECK(symmetric_eigenvalues(Eigen::MatrixXd(wide - plain)).minCoeff() > -2e-3 * plain.maxCoeff());
  CHECK(wide.trace() > 1.05 * plain.trace());
}

TEST_CASE("The rim's motion is that of a rigid motion where it moves as one", "[core][compliance][fe][body]") {
  const GearMesh mesh = gear_mesh(webbed(20, 1.5), body_options());
  REQUIRE(std::ranges::count_if(mesh.rim, [](const RimBrick& brick) { return brick.tooth == 0; }) > 10);
  const Eigen::Vector3d t(0.3, -0.2, 0.5), omega(0.01, 0.03, -0.02);
  Eigen::VectorXd u(mesh.solid.nodes.size());
  for (Eigen::Index i = 0; i < mesh.solid.nodes.cols(); ++i) u.segment<3>(3 * i) = t + omega.cross(Eigen::Vector3d(mesh.solid.nodes.col(i)));
  const Eigen::VectorXd found = rim_functionals(mesh).transpose() * u;
  // Round-off times the condition of the fit: a pitch far from the axis tells translation and turn about it apart by their small difference.
  for (const int first : {0, 6}) {
    CHECK((found.segment<3>(first) - t).norm() < 1e-8);
    CHECK((found.segment<3>(first + 3) - omega).norm() < 1e-9);
  }
}

TEST_CASE("A web at mid face does not tilt the rim, an offset one does, and its mirror image the other way", "[core][compliance][fe][body]") {
  const auto motions = [](double offset) {
    const InfluenceModel model(webbed(0, offset), kUnit, body_options());
    const ToothForm& form = model.mesh().form;
    const double radius = form.reference_radius();
    // A load at mid face, and a pair mirrored at it.
    const Eigen::MatrixXd moved = rim_motions(model, {{0, radius, 0.0}, {0, radius, 2.5}, {0, radius, -2.5}});
    return Eigen::MatrixXd(moved);
  };
  const Eigen::MatrixXd centred = motions(0), offset = motions(2), mirrored = motions(-2);
  const auto tilt = [](const Eigen::MatrixXd& moved, int part, int load) { return Eigen::Vector2d(moved.block<2, 1>(part + 3, load)); };
  for (const int part : {0, 6}) {
    const double scale = tilt(offset, part, 0).norm();
    CHECK(tilt(centred, part, 0).norm() < 1e-9 * scale);  // round-off times condition: the mesh of a spur gear is symmetric
    CHECK(tilt(centred, part, 1).norm() > 0.2 * scale);
    // Round-off: planes that the web moves are mirrored as well.
    CHECK((tilt(mirrored, part, 0) + tilt(offset, part, 0)).norm() < 1e-8 * scale);
    CHECK((tilt(mirrored, part, 1) + tilt(offset, part, 2)).norm() < 1e-8 * scale);
    CHECK(std::abs(mirrored(part + 2, 0) + offset(part + 2, 0)) < 1e-8 * std::abs(offset(part, 0)));  // axial motion
  }
  // Right below a load the rim tilts more than as a whole.
  CHECK(tilt(offset, 0, 0).norm() > tilt(offset, 6, 0).norm());
}

TEST_CASE("A thin web yields to a moment on the rim as an annular plate between rigid edges does", "[core][compliance][fe][body]") {
  // A stiff rim and a held bore at a thin plate: 60 teeth, the web 0.4 modules thick between radii of 7 and 21.
  GearToMesh gear = gear_of(60, 0, 10);
  gear.body.hold = BodyHold::RigidBore;
  gear.body.bore_diameter = 13;
  gear.body.web = WebbedBody{.rim_thickness = 28.75 - 21, .web_thickness = 0.4, .hub_diameter = 14};
  const InfluenceModel model(gear, kUnit, body_options());
  REQUIRE(model.mesh().form.root_radius() == Approx(28.75).epsilon(1e-12));  // round-off
  const double radius = model.mesh().form.reference_radius(), z = 4;
  const Eigen::MatrixXd moved = rim_motions(model, {{0, radius, z}, {0, radius, -z}});
  // The couple of a unit load inwards at z and one outwards at -z; for a spur gear it lies across the axis.
  const Eigen::Vector3d normal = load_frame(model.mesh(), {0, radius, z}).normal;
  const Eigen::Vector3d couple = Eigen::Vector3d(0, 0, 2 * z).cross(-normal);
  const double tilt = couple.normalized().dot(moved.block<3, 1>(9, 0) - moved.block<3, 1>(9, 1)) / couple.norm();

  // Kirchhoff's plate, w = (A r + B/r + C r^3 + G r ln r) cos(theta): clamped at b, at a as a rigid ring that turns by 1; the couple is 4 pi D G
  // [Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, art. 63; derived from shear force and moments of the last term].
  const double a = 21, b = 7, D = std::pow(0.4, 3) / (12 * (1 - 0.3 * 0.3));
  const auto row = [](double r) { return Eigen::RowVector4d(r, 1 / r, r * r * r, r * std::log(r)); };
  const auto row_slope = [](double r) { return Eigen::RowVector4d(1, -1 / (r * r), 3 * r * r, std::log(r) + 1); };
  Eigen::Matrix4d edges;
  edges << row(b), row_slope(b), row(a), row_slope(a);
  const double G = Eigen::Vector4d(edges.fullPivLu().solve(Eigen::Vector4d(0, 0, a, 1)))[3];
  const double plate = 1 / (4 * pi * D * std::abs(G));
  CAPTURE(tilt, plate, tilt / plate);
  CHECK(tilt == Approx(plate).epsilon(0.03));  // model: rim and hub are elastic, the plate's shear is not counted
}

TEST_CASE("A run of a gear on a web reads the rim's motion, and its influence values hold the tilt", "[core][compliance][fe][body]") {
  const double module = 3;
  GearToMesh gear = webbed(0, 2.5);
  for (double* length : {&gear.gear.face_width, &gear.normal_module}) *length *= module;
  gear.body = in_units(gear.body, 1 / module);
  const InfluenceTableTask task{.gear = gear, .teeth_apart = 2, .mesh = body_options(), .removed = RemovedRigidMotion::None, .grid = station_grid(8)};
  const InfluenceTableRun run = solve_influence_table(task, std::numeric_limits<double>::infinity());
  REQUIRE(run.status == FactorStatus::Factorised);
  REQUIRE(run.rim_motion);
  REQUIRE(run.rim_motion->below.size() == 5);
  // An even line load of 1 at half height of tooth 0. Of a solid spur gear it tilts nothing.
  constexpr int n = 16;
  std::vector<FlankStation> all;
  for (const int tooth : {0, 2}) {
    for (int i = 0; i < n; ++i) all.push_back({tooth, 0.0, 8 * (i + 0.5) / n});
  }
  const Eigen::VectorXd moved = run.table->evaluate(all).leftCols<n>().rowwise().mean();
  const Eigen::VectorXd z = Eigen::VectorXd::LinSpaced(n, -4 + 0.25, 4 - 0.25);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(task.grid.size());
  for (std::size_t i = 0; i < n; ++i) forces += run.rim_motion->grid.weights(all[i]) / n;
  const GearMesh mesh = gear_mesh(in_modules(task).gear, body_options());
  const LoadFrame flank = load_frame(mesh, {0, (mesh.form.form_radius() + mesh.form.tip_radius()) / 2, 0.0});
  // The rim below tooth 0 under loads on tooth 0 and on tooth -2, as below tooth 2 under loads on tooth 0.
  const Eigen::VectorXd own = run.rim_motion->below[2] * forces, beside = run.rim_motion->below[0] * forces;
  const double own_slope = z.dot(moved.head<n>()) / z.squaredNorm();
  const double own_tilt = -flank.normal.dot(Eigen::Vector3d(own.tail<3>()).cross(Eigen::Vector3d::UnitZ()));
  CAPTURE(own_slope, own_tilt);
  CHECK(own_slope == Approx(own_tilt).epsilon(0.05));  // model: the rim's section is bent and twisted as well as turned
  const double beside_moved = -flank.normal.dot(beside.head<3>() + Eigen::Vector3d(beside.tail<3>()).cross(flank.position));
  CHECK(moved.tail<n>().mean() == Approx(beside_moved).epsilon(0.02));  // likewise

  GearToMesh solid = gear;
  solid.body.web.reset();
  CHECK(!reads_rim_motion(solid.body));
}

TEST_CASE("A body that does not fit is refused by its own key", "[core][compliance][fe][body]") {
  const auto with = [](auto change) {
    GearToMesh gear = webbed(10, 0);
    change(gear.body, *gear.body.web);
    return refused(gear);
  };
  CHECK(with([](GearBody&, WebbedBody&) {}).empty());
  CHECK(with([](GearBody&, WebbedBody& web) { web.rim_thickness = 0.4; }) == "body.rim_thickness");
  CHECK(with([](GearBody&, WebbedBody& web) { web.rim_thickness = 15; }) == "body.rim_thickness");
  CHECK(with([](GearBody&, WebbedBody& web) { web.rim_thickness = not_given; }) == "body.rim_thickness");
  CHECK(with([](GearBody&, WebbedBody& web) { web.web_thickness = 8.1; }) == "body.web_thickness");
  CHECK(with([](GearBody&, WebbedBody& web) { web.web_thickness = 0; }) == "body.web_thickness");
  CHECK(with([](GearBody&, WebbedBody& web) { web.web_offset = 3.1; }) == "body.web_offset");
  CHECK(with([](GearBody&, WebbedBody& web) { web.web_offset = -3.1; }) == "body.web_offset");
  CHECK(with([](GearBody&, WebbedBody& web) { web.web_offset = 3; }).empty());  // flush with the face end
  CHECK(with([](GearBody&, WebbedBody& web) {
          web.hub_width = 3;
          web.web_offset = 1;
        }) == "body.web_offset");
  CHECK(with([](GearBody&, WebbedBody& web) { web.hub_diameter = 11; }) == "body.hub_diameter");
  CHECK(with([](GearBody&, WebbedBody& web) { web.hub_diameter = 32; }) == "body.hub_diameter");
  CHECK(with([](GearBody&, WebbedBody& web) { web.hub_width = -1; }) == "body.hub_width");
  CHECK(with([](GearBody&, WebbedBody& web) { web.holes.count = 2; }) == "body.hole_count");
  CHECK(with([](GearBody&, WebbedBody& web) { web.holes = {6, 10}; }) == "body.hole_diameter");
  CHECK(with([](GearBody&, WebbedBody& web) { web.holes = {6, 2, 40}; }) == "body.hole_circle_diameter");
  CHECK(with([](GearBody& body, WebbedBody&) { body.shaft_diameter = 10; }) == "body.shaft_diameter");
  CHECK(with([](GearBody& body, WebbedBody&) { body.shaft_overhang = 10; }) == "body.shaft_overhang");
  CHECK(with([](GearBody& body, WebbedBody&) { body.bore_diameter = 40; }) == "body.bore_diameter");
}
