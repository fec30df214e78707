#include "core/compliance/finite_element/load_functional.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"

using namespace flankwright;
using namespace flankwright::test;
using units::pi;

namespace {

/// Points from root to tip and from end to end, on three teeth.
std::vector<FlankPoint> flank_points(const GearMesh& mesh) {
  std::vector<FlankPoint> result;
  for (const int tooth : {-1, 0, 1}) {
    for (const double u : {0.0, 0.4, 1.0}) {
      for (const double v : {-1.0, -0.9, 0.1, 1.0}) {
        result.push_back({tooth, mesh.form.form_radius() + u * (mesh.form.tip_radius() - mesh.form.form_radius()), v * mesh.face_width / 2});
      }
    }
  }
  return result;
}

/// Force and moment about the origin of a nodal load.
Eigen::Matrix<double, 6, 1> resultant(const GearMesh& mesh, const Eigen::VectorXd& load) {
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (Eigen::Index i = 0; i < mesh.solid.nodes.cols(); ++i) {
    sum.head<3>() += load.segment<3>(3 * i);
    sum.tail<3>() += mesh.solid.nodes.col(i).cross(load.segment<3>(3 * i));
  }
  return sum;
}

}  // namespace

TEST_CASE("The flank's frame: normal to the surface, and deep to the tooth's centre", "[core][compliance][fe]") {
  const GearMesh mesh = gear_mesh(gear_of(23, GENERATE(0, 25), 5, 0.1), coarse());
  for (const FlankPoint& point : flank_points(mesh)) {
    const LoadFrame frame = load_frame(mesh, point);
    const auto at = [&](double dr, double dz) {
      FlankPoint moved = point;
      moved.radius = std::clamp(point.radius, mesh.form.form_radius() + 1e-4, mesh.form.tip_radius() - 1e-4) + dr;
      moved.z = std::clamp(point.z, -2.49, 2.49) + dz;
      return load_frame(mesh, moved).position;
    };
    const double h = 1e-5;  // central differences: 1e-10 times third derivatives
    const Eigen::Vector3d normal = load_frame(mesh, {point.tooth, at(0, 0).head<2>().norm(), at(0, 0).z()}).normal;
    CHECK(std::abs(normal.dot(at(h, 0) - at(-h, 0)) / (2 * h)) < 1e-6);
    CHECK(std::abs(normal.dot(at(0, h) - at(0, -h)) / (2 * h)) < 1e-6);

    const Eigen::Vector3d end = frame.position - frame.depth * frame.normal;
    const double turn = std::tan(mesh.form.helix_angle()) / mesh.form.reference_radius();
    const double angle = std::atan2(end.x(), end.y()) + turn * end.z() + point.tooth * 2 * pi / mesh.teeth;
    CHECK(std::abs(std::remainder(angle, 2 * pi)) < 1e-10);  // round-off

    // Eq. 2.2 of the thesis, arc for chord.
    const double r = point.radius, alpha_yt = std::acos(mesh.form.base_radius() / r);
    const double cos_base = 1 / std::hypot(1, turn * mesh.form.base_radius());
    CHECK(frame.depth == Approx(r * mesh.form.half_angle(r) * cos_base / std::cos(alpha_yt)).epsilon(0.12));  // model
  }
}

TEST_CASE("A load on the flank keeps its force and its moments exactly", "[core][compliance][fe]") {
  const GearMesh mesh = gear_mesh(gear_of(23, GENERATE(0, 25), 5), coarse());
  for (const FlankPoint& point : flank_points(mesh)) {
    CAPTURE(point.tooth, point.radius, point.z);
    const LoadFrame frame = load_frame(mesh, point);
    const Eigen::Matrix<double, 6, 1> sum = resultant(mesh, centre_functional(mesh, point));
    CHECK((sum.head<3>() + frame.normal).norm() < 1e-12);  // round-off
    CHECK((sum.tail<3>() + frame.position.cross(frame.normal)).norm() < 1e-11);
  }
}

TEST_CASE("A load on the flank itself has the force and the moments of the same load over the centre surface", "[core][compliance][fe]") {
  const GearMesh mesh = gear_mesh(gear_of(23, GENERATE(0, 25), 5, 0.1), coarse());
  for (const FlankPoint& point : flank_points(mesh)) {
    const auto on_flank = resultant(mesh, flank_functional(mesh, point)), on_centre = resultant(mesh, centre_functional(mesh, point));
    CHECK((on_flank - on_centre).norm() < 1e-9 * on_centre.norm());  // round-off of the factors at corners, where a quarter of the patch is left
  }
}

TEST_CASE("The functional is continuous where the line of action begins to leave through the end face", "[core][compliance][fe]") {
  const GearMesh mesh = gear_mesh(gear_of(18, 30), coarse());
  for (const double radius : {mesh.form.form_radius(), mesh.form.reference_radius(), mesh.form.tip_radius()}) {
    const LoadFrame frame = load_frame(mesh, {0, radius, 0});
    const double border = -mesh.face_width / 2 + frame.depth * frame.normal.z();
    REQUIRE(border > -mesh.face_width / 2 + 0.1);
    for (const double z : {border, -mesh.face_width / 2 + 0.05}) {
      const Eigen::VectorXd here = centre_functional(mesh, {0, radius, z});
      const double close = (Eigen::VectorXd(centre_functional(mesh, {0, radius, z + 1e-5})) - here).norm();
      const double far = (Eigen::VectorXd(centre_functional(mesh, {0, radius, z + 1e-3})) - here).norm();
      CHECK(far < 1e-2 * here.norm());
      CHECK(close < 0.02 * far);  // proportional to the distance, twice over
    }
  }
}

TEST_CASE("Away from the ends a load acts where its line meets the centre surface", "[core][compliance][fe]") {
  const GearMesh mesh = gear_mesh(gear_of(30, GENERATE(0, 30), 16), coarse());
  const FlankPoint point{0, mesh.form.reference_radius(), 0.3};
  const LoadFrame frame = load_frame(mesh, point);
  const Eigen::VectorXd load = centre_functional(mesh, point);
  double z = 0;
  for (Eigen::Index i = 0; i < mesh.solid.nodes.cols(); ++i) {
    z -= mesh.solid.nodes(2, i) * load.segment<3>(3 * i).dot(frame.normal);
  }
  // Model: the tails of the weights are cut at the tip and at the ends.
  CHECK(std::abs(z - (frame.position - frame.depth * frame.normal).z()) < 0.1 * frame.depth);
}

TEST_CASE("The shaft's motion is exact for a rigid one", "[core][compliance][fe]") {
  const GearMesh mesh = gear_mesh(gear_of(18, 20), coarse());
  const Eigen::Vector3d shift(0.2, -0.4, 1), turn(0.3, 0.5, -0.7);
  for (const double z : {-3.0, -1.234, 0.0, 3.0}) {
    const SectionMotion motion = shaft_motion(mesh, z);
    Eigen::VectorXd moved(3 * static_cast<Eigen::Index>(motion.nodes.size()));
    for (std::size_t k = 0; k < motion.nodes.size(); ++k) {
      moved.segment<3>(3 * static_cast<Eigen::Index>(k)) = shift + turn.cross(mesh.solid.nodes.col(motion.nodes[k]));
    }
    const Eigen::Matrix<double, 6, 1> found = motion.weights * moved;
    CHECK((found.head<3>() - shift - turn.cross(Eigen::Vector3d(0, 0, z))).norm() < 1e-12);  // round-off
    CHECK((found.tail<3>() - turn).norm() < 1e-12);
  }
}

TEST_CASE("The net functional does not feel the motions that are taken out", "[core][compliance][fe]") {
  GearToMesh gear = gear_of(18, 30);
  gear.body.torque_end = GENERATE(FaceEnd::Acute, FaceEnd::Obtuse);
  const GearMesh mesh = gear_mesh(gear, coarse());
  for (const FlankPoint& point : flank_points(mesh)) {
    const double axial = -load_frame(mesh, point).normal.z();
    const auto two = resultant(mesh, net_functionals(mesh, {point}, RemovedRigidMotion::TranslationAndTorsion).whole().col(0));
    CHECK(two.head<2>().norm() < 1e-12);  // round-off
    CHECK(std::abs(two[5]) < 1e-11);
    auto three = resultant(mesh, net_functionals(mesh, {point}, RemovedRigidMotion::TranslationTorsionAndTilt).whole().col(0));
    CHECK(three[2] == Approx(axial).epsilon(1e-12));
    three[2] = 0;
    CHECK(three.norm() < 1e-11);
  }
}

TEST_CASE("Points that are not on a detailed flank are refused", "[core][compliance][fe]") {
  const GearMesh mesh = gear_mesh(gear_of(18, 30), coarse());
  const double r = mesh.form.reference_radius();
  CHECK_THROWS_AS(load_frame(mesh, {2, r, 0}), InvalidInput);
  CHECK_THROWS_AS(load_frame(mesh, {0, mesh.form.form_radius() - 0.1, 0}), InvalidInput);
  CHECK_THROWS_AS(load_frame(mesh, {0, mesh.form.tip_radius() + 0.1, 0}), InvalidInput);
  CHECK_THROWS_AS(load_frame(mesh, {0, r, 3.1}), InvalidInput);
  CHECK_THROWS_AS(load_frame(mesh, {0, not_given, 0}), InvalidInput);
}
