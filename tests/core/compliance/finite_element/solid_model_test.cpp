#include "core/compliance/finite_element/solid_model.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "tests/core/compliance/finite_element/block_mesh.hpp"
#include "tests/core/compliance/finite_element/brick_stress.hpp"
#include "tests/reference/eigenvalues.hpp"

using namespace flankwright;
using namespace flankwright::test;
using units::pi;

namespace {

const Material kSteel{206000, 0.3};

/// Curves everything inside the unit cube, leaves its surface alone.
Eigen::Vector3d bulge(const Eigen::Vector3d& p) {
  const double s = std::sin(pi * p.x()) * std::sin(pi * p.y()) * std::sin(pi * p.z());
  return p + 0.08 * s * Eigen::Vector3d(1, -0.7, 0.4);
}

Eigen::SparseMatrix<double> sparse(const Eigen::MatrixXd& dense) { return dense.sparseView(); }

/// Nodal loads of the traction that the uniform stress S puts on the surface of a body whose bricks fill it: what the
/// stress does to the shape functions.
Eigen::MatrixXd loads_of_uniform_stress(const SolidMesh& mesh, const Eigen::Matrix3d& stress) {
  Eigen::MatrixXd load = Eigen::MatrixXd::Zero(mesh.nodes.size(), 1);
  // The surface of the unit cube: faces of bricks whose four corners lie on it, flat and with mid-sides half way.
  constexpr int kFaces[6][8] = {{0, 3, 2, 1, 11, 10, 9, 8},  {4, 5, 6, 7, 12, 13, 14, 15}, {0, 1, 5, 4, 8, 17, 12, 16},
                                {1, 2, 6, 5, 9, 18, 13, 17}, {2, 3, 7, 6, 10, 19, 14, 18}, {3, 0, 4, 7, 11, 16, 15, 19}};
  for (Eigen::Index e = 0; e < mesh.bricks.cols(); ++e) {
    for (const auto& face : kFaces) {
      FaceNodes nodes;
      for (int i = 0; i < 8; ++i) nodes.col(i) = mesh.nodes.col(mesh.bricks(face[i], e));
      const Eigen::Vector3d low = nodes.rowwise().minCoeff(), high = nodes.rowwise().maxCoeff();
      bool outside = false;
      for (int a = 0; a < 3; ++a) outside = outside || high[a] < 1e-9 || low[a] > 1 - 1e-9;
      if (!outside) continue;
      for (int i = 0; i < 9; ++i) {
        const FaceShape shape = face_shape(gauss3_abscissae[i % 3], gauss3_abscissae[i / 3]);
        const Eigen::Matrix<double, 3, 2> tangents = nodes * shape.derivatives;
        const Eigen::Vector3d area = tangents.col(0).cross(tangents.col(1));
        const Eigen::Vector3d force = gauss3_weights[i % 3] * gauss3_weights[i / 3] * (stress * area);
        for (int k = 0; k < 8; ++k) load.middleRows<3>(3 * mesh.bricks(face[k], e)) += shape.values[k] * force;
      }
    }
  }
  return load;
}

}  // namespace

TEST_CASE("Curved bricks under uniform stress deform linearly (patch test)", "[core][compliance][fe]") {
  Eigen::Matrix3Xd cube;
  const SolidMesh mesh = block_mesh(3, 2, 2, bulge, &cube);
  REQUIRE(mesh.quality() < 0.8);  // they are curved
  const Eigen::Matrix3d stress{{100, 20, -30}, {20, -50, 10}, {-30, 10, 70}};

  // Supports against rigid motion only: three nodes of the cube's corners.
  std::vector<NodeSupport> supports;
  for (int n = 0; n < cube.cols(); ++n) {
    const Eigen::Vector3d p = cube.col(n);
    if (p.norm() == 0) supports.push_back({n});
    if (p == Eigen::Vector3d(1, 0, 0)) supports.push_back({n, {false, true, true}});
    if (p == Eigen::Vector3d(0, 1, 0)) supports.push_back({n, {false, false, true}});
  }
  const SolidModel model(mesh, kSteel, supports);
  REQUIRE(model.status() == FactorStatus::Factorised);
  const Eigen::VectorXd u = model.solve(sparse(loads_of_uniform_stress(mesh, stress)));

  // Hooke's law, and the rotation that the supports ask for: u_y = u_z = 0 along x, u_z = 0 along y.
  const Eigen::Matrix3d strain = (1.3 * stress - 0.3 * stress.trace() * Eigen::Matrix3d::Identity()) / kSteel.youngs_modulus;
  Eigen::Matrix3d gradient = strain;
  gradient(1, 0) = gradient(2, 0) = gradient(2, 1) = 0;
  gradient(0, 1) = 2 * strain(0, 1);
  gradient(0, 2) = 2 * strain(0, 2);
  gradient(1, 2) = 2 * strain(1, 2);
  const Eigen::Matrix3Xd expected = gradient * mesh.nodes;
  const double scale = expected.cwiseAbs().maxCoeff();
  CHECK((u.reshaped(3, mesh.nodes.cols()) - expected).cwiseAbs().maxCoeff() < 1e-11 * scale);  // round-off

  for (Eigen::Index e = 0; e < mesh.bricks.cols(); ++e) {
    BrickNodes moved;
    for (int i = 0; i < 20; ++i) moved.col(i) = u.segment<3>(3 * mesh.bricks(i, e));
    CHECK((brick_stress(mesh.brick_nodes(e), moved, {0.3, -0.6, 0.1}, kSteel) - stress).norm() < 1e-9);  // round-off
  }
}

TEST_CASE("A brick's only motions without energy are the six rigid ones", "[core][compliance][fe]") {
  const SolidMesh mesh = block_mesh(1, 1, 1, [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(p.x() + 0.1 * p.y() * p.z(), p.y() * (1 + 0.2 * p.x() * p.x()), 0.8 * p.z() + 0.1 * p.x());
  });
  const BrickNodes nodes = mesh.brick_nodes(0);
  const auto stiffness = brick_stiffness(nodes, kSteel);
  CHECK(stiffness == stiffness.transpose());
  const Eigen::VectorXd energies = symmetric_eigenvalues(stiffness);
  const double largest = energies[59];
  CHECK(std::abs(energies[5]) < 1e-13 * largest);  // round-off
  CHECK(std::abs(energies[0]) < 1e-13 * largest);
  CHECK(energies[6] > 1e-4 * largest);

  const Eigen::Vector3d shift(0.3, -1, 2), turn(-0.5, 0.2, 0.9);
  BrickNodes rigid;
  for (int i = 0; i < 20; ++i) rigid.col(i) = shift + turn.cross(nodes.col(i));
  CHECK((stiffness * rigid.reshaped()).norm() < 1e-13 * largest);
}

TEST_CASE("A cantilever of bricks converges to the beam with shear", "[core][compliance][fe][closed-form]") {
  const double length = 12, height = 1, width = 0.8, force = 5;
  const Material straight{206000, 0};  // without lateral contraction, which the clamped end would hinder
  const auto tip = [&](int n) {
    Eigen::Matrix3Xd cube;
    const SolidMesh mesh = block_mesh(
        n, 2, 1, [&](const Eigen::Vector3d& p) { return Eigen::Vector3d(length * p.x(), height * p.y(), width * p.z()); }, &cube);
    const SolidModel model(mesh, straight, hold(cube, [](const Eigen::Vector3d& p) { return p.x() == 0; }));
    // Shear spread over the end's area; the same functional is the end's mean deflection.
    Eigen::MatrixXd load = Eigen::MatrixXd::Zero(mesh.nodes.size(), 1);
    for (Eigen::Index e = 0; e < mesh.bricks.cols(); ++e) {
      const int face[8] = {1, 2, 6, 5, 9, 18, 13, 17};
      if (cube(0, mesh.bricks(face[0], e)) < 1) continue;
      for (int i = 0; i < 9; ++i) {
        const FaceShape shape = face_shape(gauss3_abscissae[i % 3], gauss3_abscissae[i / 3]);
        for (int k = 0; k < 8; ++k) {
          load(3 * mesh.bricks(face[k], e) + 1) += shape.values[k] * gauss3_weights[i % 3] * gauss3_weights[i / 3] / 4 / 2;
        }
      }
    }
    REQUIRE(load.sum() == Approx(1).epsilon(1e-12));
    return force * model.influence(sparse(load))(0, 0);
  };
  const double area = height * width, inertia = width * std::pow(height, 3) / 12;
  const double beam =
      force * std::pow(length, 3) / (3 * straight.youngs_modulus * inertia) + force * length / (5.0 / 6 * straight.youngs_modulus / 2 * area);
  const double coarse = std::abs(tip(3) / beam - 1), fine = std::abs(tip(12) / beam - 1);
  CHECK(coarse < 0.05);  // discretisation
  CHECK(fine < 5e-4);    // discretisation, and the corners' singularity at the clamped end
  CHECK(fine < coarse / 30);
}

TEST_CASE("Displacements converge with the third power of the size, stresses with the second", "[core][compliance][fe][convergence]") {
  // u = (1, -2, 0.5) s, s = product of sin(pi x_i), zero on the surface; the body force that belongs to it.
  const Eigen::Vector3d direction(1, -2, 0.5);
  const double lambda = kSteel.youngs_modulus * 0.3 / (1.3 * 0.4), mu = kSteel.youngs_modulus / 2.6;
  const auto derivative = [](const Eigen::Vector3d& p, int a, int b) {  // of s; -1 for none
    double product = 1;
    for (int i = 0; i < 3; ++i) {
      const int order = (a == i) + (b == i);
      product *= order == 0 ? std::sin(pi * p[i]) : order == 1 ? pi * std::cos(pi * p[i]) : -pi * pi * std::sin(pi * p[i]);
    }
    return product;
  };
  const auto errors = [&](int n) {
    Eigen::Matrix3Xd cube;
    const SolidMesh mesh = block_mesh(n, n, n, bulge, &cube);
    const SolidModel model(mesh, kSteel, hold(cube, [](const Eigen::Vector3d& p) { return (p.array() == 0).any() || (p.array() == 1).any(); }));
    Eigen::MatrixXd load = Eigen::MatrixXd::Zero(mesh.nodes.size(), 1);
    integrate(mesh, [&](Eigen::Index e, const BrickShape& shape, const Eigen::Vector3d& p, const auto&, double weight) {
      Eigen::Vector3d force = 3 * pi * pi * mu * derivative(p, -1, -1) * direction;
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) force[a] -= (lambda + mu) * derivative(p, a, b) * direction[b];
      }
      for (int k = 0; k < 20; ++k) load.middleRows<3>(3 * mesh.bricks(k, e)) += weight * shape.values[k] * force;
    });
    const Eigen::VectorXd u = model.solve(sparse(load));
    double displacement = 0, energy = 0;
    integrate(mesh, [&](Eigen::Index e, const BrickShape& shape, const Eigen::Vector3d& p, const auto& gradient, double weight) {
      BrickNodes moved;
      for (int i = 0; i < 20; ++i) moved.col(i) = u.segment<3>(3 * mesh.bricks(i, e));
      displacement += weight * (moved * shape.values - derivative(p, -1, -1) * direction).squaredNorm();
      Eigen::Matrix3d difference = moved * gradient;
      for (int b = 0; b < 3; ++b) difference.col(b) -= derivative(p, b, -1) * direction;
      const Eigen::Matrix3d strain = 0.5 * (difference + difference.transpose());
      energy += weight * (lambda * strain.trace() * strain.trace() + 2 * mu * strain.squaredNorm());
    });
    return Eigen::Vector2d(std::sqrt(displacement), std::sqrt(energy));
  };
  const Eigen::Vector2d coarse = errors(4), fine = errors(8);
  CAPTURE(coarse.transpose(), fine.transpose());
  CHECK(std::log2(coarse[0] / fine[0]) > 2.8);  // order 3 as the size goes to 0
  CHECK(std::log2(coarse[1] / fine[1]) > 1.8);  // order 2
}

TEST_CASE("Half-solved and solved loads agree, and loads are reciprocal", "[core][compliance][fe]") {
  Eigen::Matrix3Xd cube;
  const SolidMesh mesh = block_mesh(3, 3, 2, bulge, &cube);
  const SolidModel model(mesh, kSteel, hold(cube, [](const Eigen::Vector3d& p) { return p.x() == 0; }));
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(mesh.nodes.size(), 60);  // more than one block of right-hand sides
  for (int k = 0; k < 60; ++k) {
    loads((37 * k + 11) % loads.rows(), k) = 1;
    loads((61 * k + 5) % loads.rows(), k) += -0.4;
  }
  const Eigen::MatrixXd influence = model.influence(sparse(loads));
  CHECK(influence == influence.transpose());
  const Eigen::MatrixXd solved = loads.transpose() * model.solve(sparse(loads));
  const double scale = influence.cwiseAbs().maxCoeff();
  CHECK((influence - solved).cwiseAbs().maxCoeff() < 1e-12 * scale);           // round-off
  CHECK((solved - solved.transpose()).cwiseAbs().maxCoeff() < 1e-12 * scale);  // Maxwell
}

TEST_CASE("A turned body on turned supports deforms as the straight one", "[core][compliance][fe]") {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  Eigen::Matrix3Xd cube;
  const SolidMesh straight = block_mesh(2, 2, 2, bulge, &cube);
  SolidMesh turned = straight;
  turned.nodes = turn * straight.nodes;
  std::vector<NodeSupport> rollers, turned_rollers;  // along x, and one node in y and z as well, one in z
  for (int n = 0; n < cube.cols(); ++n) {
    const Eigen::Vector3d p = cube.col(n);
    if (p.x() > 0) continue;
    const bool corner = p.norm() == 0, beside = p == Eigen::Vector3d(0, 1, 0);
    rollers.push_back({n, {true, corner, corner || beside}});
    turned_rollers.push_back({n, {true, corner, corner || beside}, turn});
  }
  Eigen::MatrixXd load = Eigen::MatrixXd::Zero(straight.nodes.size(), 1), turned_load = load;
  for (int n = 0; n < cube.cols(); ++n) {
    const Eigen::Vector3d force(cube(0, n), 0.3, cube(1, n) - 0.2);
    load.middleRows<3>(3 * n) = force;
    turned_load.middleRows<3>(3 * n) = turn * force;
  }
  const Eigen::Matrix3Xd u = SolidModel(straight, kSteel, rollers).solve(sparse(load)).reshaped(3, straight.nodes.cols());
  const Eigen::Matrix3Xd v = SolidModel(turned, kSteel, turned_rollers).solve(sparse(turned_load)).reshaped(3, straight.nodes.cols());
  CHECK((turn * u - v).norm() < 1e-11 * u.norm());  // round-off times condition
}

TEST_CASE("A body free to move is reported, a bad mesh is refused", "[core][compliance][fe]") {
  Eigen::Matrix3Xd cube;
  SolidMesh mesh = block_mesh(2, 1, 1, bulge, &cube);
  CHECK(SolidModel(mesh, kSteel, {}).status() == FactorStatus::NotPositiveDefinite);
  CHECK(SolidModel(mesh, kSteel, {{0}}).status() == FactorStatus::NotPositiveDefinite);

  const auto field = [&] {
    try {
      SolidModel(mesh, kSteel, {{0}});
    } catch (const InvalidInput& error) {
      return error.field();
    }
    return std::string();
  };
  CHECK(field().empty());
  const auto good = mesh;
  mesh.bricks.col(0).head<8>() = good.bricks.col(0).head<8>().reverse();
  CHECK(field() == "mesh.bricks");
  mesh = good;
  mesh.nodes.conservativeResize(3, mesh.nodes.cols() + 1);
  mesh.nodes.rightCols<1>().setZero();
  CHECK(field() == "mesh.nodes");
  mesh = good;
  mesh.tied = {{5, {{1, 0.5}, {static_cast<int>(mesh.nodes.cols()), 0.5}}}};
  CHECK(field() == "mesh.tied");
  mesh.tied = {{5, {{1, 1.0}}}, {1, {{2, 1.0}}}};  // a chain
  CHECK(field() == "mesh.tied");
  mesh.tied = {{0, {{1, 1.0}}}};  // held at the same time
  CHECK(field() == "supports");
}
