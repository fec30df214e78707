#include "core/compliance/finite_element/fillet_stress.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "core/compliance/finite_element/influence.hpp"
#include "tests/core/compliance/finite_element/brick_stress.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using namespace flankwright::test;

namespace {

const Material kSteel{206000, 0.3};

std::vector<FilletPoint> stations(const GearMesh& mesh) {
  std::vector<FilletPoint> result;
  for (const double along : {0.0, 0.13, 0.5, 0.71, 1.0}) {
    for (const double v : {-1.0, -0.83, 0.05, 0.6, 1.0}) result.push_back({along, v * mesh.face_width / 2});
  }
  return result;
}

/// Nodal values of a linear displacement field.
Eigen::VectorXd field(const GearMesh& mesh, const Eigen::Matrix3d& gradient, const Eigen::Vector3d& shift = {0, 0, 0}) {
  Eigen::VectorXd u(mesh.solid.nodes.size());
  for (Eigen::Index i = 0; i < mesh.solid.nodes.cols(); ++i) {
    u.segment<3>(3 * i) = gradient * mesh.solid.nodes.col(i) + shift;
  }
  return u;
}

/// Stress of the solid elements at the middle of the fillet's faces, half way along the face, over the largest there.
struct SurfaceCheck {
  double difference{0};  ///< of s_tt from the fillet's
  double traction{0};    ///< across the surface
};

SurfaceCheck check_surface(int half_thickness_elements) {
  GearMeshOptions options = coarse();
  options.fillet_elements = 8;
  options.half_thickness_elements = half_thickness_elements;
  const GearMesh mesh = gear_mesh(gear_of(18, 0, 2.5), options);
  const SolidModel solid(mesh.solid, kSteel, mesh.supports);
  const Eigen::SparseMatrix<double> force =
      net_functionals(mesh, {{0, mesh.form.tip_radius(), 0}}, RemovedRigidMotion::TranslationTorsionAndTilt).whole();
  const Eigen::VectorXd u = solid.solve(force);
  const FilletStress fillet(mesh, kSteel);

  const std::vector<MeshFace>& faces = mesh.surfaces(0).fillet;
  const std::size_t layer = (mesh.planes.size() - 1) / 2;
  double largest = 0;
  SurfaceCheck result;
  for (std::size_t i = 1; i + 1 < 8; ++i) {  // without the ends, which corners of other surfaces share
    const MeshFace& face = faces[layer * 8 + i];
    for (Eigen::Index e = 0; e < mesh.solid.bricks.cols(); ++e) {
      std::array<Eigen::Vector3d, 4> corners;
      int found = 0;
      for (int k = 0; k < 4; ++k) {
        for (int c = 0; c < 8; ++c) {
          if (mesh.solid.bricks(c, e) != face[k]) continue;
          const int x[] = {-1, 1, 1, -1};
          corners[k] = {static_cast<double>(x[c % 4]), c % 4 < 2 ? -1.0 : 1.0, c < 4 ? -1.0 : 1.0};
          ++found;
        }
      }
      if (found < 4) continue;
      // Middle of the face, where both kinds of derivatives are taken.
      const Eigen::Vector3d local = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
      const BrickNodes nodes = mesh.solid.brick_nodes(e);
      BrickNodes moved;
      for (int c = 0; c < 20; ++c) moved.col(c) = u.segment<3>(3 * mesh.solid.bricks(c, e));
      const Eigen::Matrix3d stress = brick_stress(nodes, moved, local, kSteel);
      const FaceNodes on_face = mesh.face_nodes(face);
      const Eigen::Matrix<double, 3, 2> tangents = on_face * face_shape(0, 0).derivatives;
      const Eigen::Vector3d t = tangents.col(0).normalized();
      const Eigen::Vector3d n = tangents.col(0).cross(tangents.col(1)).normalized();
      const Eigen::Vector3d at = on_face * face_shape(0, 0).values;
      const double along = fillet.along({at.x(), at.y(), 0});
      const Eigen::VectorXd surface = fillet.functionals({{along, at.z()}}).transpose() * u;
      largest = std::max(largest, std::abs(surface[0]));
      result.difference = std::max(result.difference, std::abs(surface[0] - t.dot(stress * t)));
      result.traction = std::max(result.traction, (stress * n).norm());
    }
  }
  result.difference /= largest;
  result.traction /= largest;
  return result;
}

}  // namespace

TEST_CASE("A rigid motion leaves no stress in a fillet", "[core][compliance][fe][root-stress]") {
  const GearMesh mesh = gear_mesh(gear_of(18, GENERATE(0, 30), 4), coarse());
  const auto functionals = FilletStress(mesh, kSteel).functionals(stations(mesh));
  Eigen::Matrix3d turn;
  turn << 0, 0.7, 0.5, -0.7, 0, -0.3, -0.5, 0.3, 0;
  const Eigen::VectorXd stress = functionals.transpose() * field(mesh, turn, {0.2, -0.4, 1});
  CHECK(stress.cwiseAbs().maxCoeff() < 1e-11 * kSteel.youngs_modulus);  // round-off x module over element size
}

TEST_CASE("Even stretch gives the same tension in all directions of a fillet's surface", "[core][compliance][fe][root-stress]") {
  const GearMesh mesh = gear_mesh(gear_of(18, GENERATE(0, 30), 4, 0, GENERATE(1, 5)), coarse());
  const auto where = stations(mesh);
  const double strain = 1e-3, tension = kSteel.youngs_modulus / (1 - kSteel.poissons_ratio) * strain;
  const Eigen::VectorXd stress = FilletStress(mesh, kSteel).functionals(where).transpose() * field(mesh, strain * Eigen::Matrix3d::Identity());
  for (std::size_t i = 0; i < where.size(); ++i) {
    const Eigen::Vector3d s = stress.segment<3>(3 * static_cast<Eigen::Index>(i));
    CHECK((s - Eigen::Vector3d(tension, tension, 0)).norm() < 1e-10 * tension);  // round-off: the patch test
    CHECK(largest_principal(s).value == Approx(tension).epsilon(1e-10));
  }
}

TEST_CASE("A linear field is stressed along a fillet as its tangent says", "[core][compliance][fe][root-stress]") {
  // Spur: across the tooth, t = (sin, -cos) of the tangent's angle; along the face, a = z.
  GearMeshOptions options = coarse();
  options.fillet_elements = 8;
  const GearMesh mesh = gear_mesh(gear_of(18, 0, 4), options);
  const FilletStress fillet(mesh, kSteel);
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  gradient(0, 0) = 1e-3;
  gradient(2, 2) = 4e-4;
  gradient(2, 0) = 3e-4;  // u_z rises with x
  const double nu = kSteel.poissons_ratio, plane = kSteel.youngs_modulus / (1 - nu * nu);
  for (const double angle_deg : {25.0, 30.0, 45.0, 60.0}) {
    CAPTURE(angle_deg);
    const double angle = angle_deg * units::deg;
    const double along = fillet.along(mesh.form.root_tangent_point(angle));
    const Eigen::VectorXd s = fillet.functionals({{along, 0.3}}).transpose() * field(mesh, gradient);
    const double tt = gradient(0, 0) * std::pow(std::sin(angle), 2), aa = gradient(2, 2);
    // Discretisation: the mesh's tangent and the spline between Gauss points.
    CHECK(s[0] == Approx(plane * (tt + nu * aa)).epsilon(0.01));
    CHECK(s[1] == Approx(plane * (aa + nu * tt)).epsilon(0.01));
    CHECK(std::abs(s[2]) == Approx(plane * (1 - nu) / 2 * gradient(2, 0) * std::sin(angle)).epsilon(0.01));
  }
}

TEST_CASE("Places along a fillet: arc length of the exact profile", "[core][compliance][fe][root-stress]") {
  const GearMesh mesh = gear_mesh(gear_of(40, GENERATE(0, 25), 3), coarse());
  const FilletStress fillet(mesh, kSteel);
  const ToothForm& form = mesh.form;
  constexpr int kChords = 2000;
  double arc = 0;
  ProfilePoint last = form.fillet_point(form.fillet_start());
  CHECK(fillet.along(last) == tests::about(0, 1e-6));
  for (int i = 1; i <= kChords; ++i) {
    const ProfilePoint p = form.fillet_point(form.fillet_start() + (units::pi / 2 - form.fillet_start()) * i / kChords);
    arc += std::hypot(p.x - last.x, p.y - last.y);
    last = p;
    // Discretisation: three quadratic edges for the whole fillet.
    if (i % 400 == 0) CHECK(fillet.along(p) * fillet.length() == tests::about(arc, 2e-3 * fillet.length()));
  }
}

TEST_CASE("The surface is free of traction: stress of the solid elements there is the fillet's", "[core][compliance][fe][root-stress]") {
  const SurfaceCheck coarse = check_surface(2), fine = check_surface(4);
  CAPTURE(coarse.difference, coarse.traction, fine.difference, fine.traction);
  // Discretisation: the solid's stress, which changes fast below the surface, is not best at the middle of a face.
  CHECK(fine.difference < 0.05);
  CHECK(fine.traction < 0.12);
  CHECK(fine.traction < 0.7 * coarse.traction);
}

TEST_CASE("The largest principal stress and how it follows its components", "[core][compliance][root-stress]") {
  for (const Eigen::Vector3d& s : {Eigen::Vector3d(3, 1, 0), Eigen::Vector3d(1, 3, 0), Eigen::Vector3d(-2, 0.5, 1.7), Eigen::Vector3d(0.1, 0.2, -4),
                                   Eigen::Vector3d(-5, -1, 0.3)}) {
    const PrincipalStress p = largest_principal(s);
    Eigen::Matrix2d tensor;
    tensor << s[0], s[2], s[2], s[1];
    CHECK((tensor * p.direction - p.value * p.direction).norm() < 1e-14 * s.norm());  // round-off
    CHECK(p.value >= tensor.trace() / 2);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d h = 1e-5 * Eigen::Vector3d::Unit(i);
      const double difference = (largest_principal(s + h).value - largest_principal(s - h).value) / 2e-5;
      CHECK(principal_slope(p)[i] == tests::about(difference, 1e-8));  // discretisation, 1e-10 x third derivative
    }
  }
  CHECK(largest_principal({2, 2, 0}).value == 2);
  CHECK(largest_principal({0, 0, 0}).value == 0);
}

TEST_CASE("Places off the fillet and impossible materials are refused", "[core][compliance][fe][root-stress]") {
  const GearMesh mesh = gear_mesh(gear_of(18, 0, 4), coarse());
  const FilletStress fillet(mesh, kSteel);
  CHECK_THROWS_AS(fillet.functionals({{-0.1, 0}}), InvalidInput);
  CHECK_THROWS_AS(fillet.functionals({{1.1, 0}}), InvalidInput);
  CHECK_THROWS_AS(fillet.functionals({{0.5, 2.1}}), InvalidInput);
  CHECK_THROWS_AS(fillet.functionals({{not_given, 0}}), InvalidInput);
  CHECK_THROWS_AS(FilletStress(mesh, {0, 0.3}), InvalidInput);
  CHECK_THROWS_AS(FilletStress(mesh, {206000, 0.5}), InvalidInput);
}
