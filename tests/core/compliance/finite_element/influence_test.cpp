#include "core/compliance/finite_element/influence.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/compliance/finite_element/gears.hpp"
#include "tests/reference/eigenvalues.hpp"

using namespace flankwright;
using namespace flankwright::test;

namespace {

std::vector<FlankPoint> points(const GearMesh& mesh, int teeth = 1) {
  std::vector<FlankPoint> result;
  for (int tooth = -teeth; tooth <= teeth; ++tooth) {
    for (const double u : {0.0, 0.5, 1.0}) {
      for (const double v : {-1.0, -0.6, 0.0, 0.6, 1.0}) {
        result.push_back({tooth, mesh.form.form_radius() + u * (mesh.form.tip_radius() - mesh.form.form_radius()), v * mesh.face_width / 2});
      }
    }
  }
  return result;
}

}  // namespace

TEST_CASE("Influence values are symmetric and positive semi-definite over all teeth", "[core][compliance][fe]") {
  const InfluenceModel model(gear_of(18, 30), kUnit, coarse());
  const auto removed = GENERATE(RemovedRigidMotion::None, RemovedRigidMotion::TranslationAndTorsion, RemovedRigidMotion::TranslationTorsionAndTilt,
                                RemovedRigidMotion::WholeTranslationTorsionAndTilt);
  const InfluenceMatrix result = model.influence(points(model.mesh()), removed);
  REQUIRE(result.status == FactorStatus::Factorised);
  CHECK(result.compliance == result.compliance.transpose());
  const Eigen::VectorXd values = symmetric_eigenvalues(result.compliance);
  CHECK(values.minCoeff() > -1e-13 * values.maxCoeff());  // round-off

  // The same by full solutions: what one load does to the other's place.
  const auto loads = net_functionals(model.mesh(), result.points, removed).whole();
  Eigen::MatrixXd solved = loads.transpose() * model.solid().solve(loads);
  solved.array() += axial_hold_compliance(model.mesh(), kUnit, removed);
  CHECK((solved - result.compliance).cwiseAbs().maxCoeff() < 1e-10 * values.maxCoeff());  // round-off x condition
}

TEST_CASE("With translation, torsion and tilt taken out the supports carry nothing", "[core][compliance][fe]") {
  const GearMesh mesh = gear_mesh(gear_of(18, 30), coarse());
  const auto loads = net_functionals(mesh, points(mesh), RemovedRigidMotion::WholeTranslationTorsionAndTilt).whole();
  // Held at three nodes, no more than needed: the first in all directions, the second across the line to it, the third
  // across the plane of all three.
  const auto held_at = [&](int first, int second) {
    const Eigen::Matrix3Xd& x = mesh.solid.nodes;
    const Eigen::Vector3d axis = (x.col(second) - x.col(first)).normalized();
    Eigen::Index third;
    const Eigen::Matrix3Xd from = x.colwise() - x.col(first);
    (from - axis * (axis.transpose() * from)).colwise().norm().maxCoeff(&third);
    const Eigen::Vector3d normal = (x.col(third) - x.col(first)).cross(axis).normalized();
    Eigen::Matrix3d frame;
    frame << axis, normal, axis.cross(normal);
    return SolidModel(mesh.solid, kUnit, {{first}, {second, {false, true, true}, frame}, {static_cast<int>(third), {false, true, false}, frame}})
        .influence(loads);
  };
  const auto last = static_cast<int>(mesh.solid.nodes.cols()) - 1;
  const Eigen::MatrixXd a = held_at(0, last), b = held_at(last / 2, 5);
  CHECK((a - b).norm() < 1e-9 * a.norm());  // round-off x condition
  // The mesh's own supports keep the shaft's ends round and flat, which the gear notices a little (Saint-Venant).
  const Eigen::MatrixXd usual = SolidModel(mesh.solid, kUnit, mesh.supports).influence(loads);
  CHECK((a - usual).norm() < 3e-3 * a.norm());
}

TEST_CASE("The axial hold gives what a disc under an even pressure does", "[core][compliance][fe]") {
  const GearMesh mesh = gear_mesh(gear_of(18, 30), coarse());
  const double a = axial_hold_share * mesh.shaft_diameter / 2, pressure = 1 / (units::pi * a * a);
  // Displacement of the half space at radius r, by a complete elliptic integral, and its mean over the disc.
  double mean = 0;
  constexpr int kRings = 20000;
  for (int i = 0; i < kRings; ++i) {
    const double share = (i + 0.5) / kRings;
    const double u = 4 * (1 - 0.3 * 0.3) * pressure * a / units::pi * std::comp_ellint_2(share);
    mean += 2 * share * u / kRings;
  }
  const double along_normal = load_frame(mesh, {0, mesh.form.tip_radius(), 0}).normal.z();
  CHECK(axial_hold_compliance(mesh, kUnit, RemovedRigidMotion::TranslationTorsionAndTilt) ==
        Approx(along_normal * along_normal * mean).epsilon(1e-8));  // the rings' discretisation
  CHECK(axial_hold_compliance(mesh, kUnit, RemovedRigidMotion::WholeTranslationTorsionAndTilt) == 0);
  CHECK(axial_hold_compliance(gear_mesh(gear_of(18, 0), coarse()), kUnit, RemovedRigidMotion::None) == 0);
}

TEST_CASE("Compliance scales with 1 / (E m_n)", "[core][compliance][fe]") {
  const InfluenceModel small(gear_of(18, 20), kUnit, coarse());
  const InfluenceModel large(gear_of(18, 20, 6, 0, 8), {206000, 0.3}, coarse());
  const Eigen::MatrixXd a = small.influence(points(small.mesh(), 0)).compliance;
  const Eigen::MatrixXd b = large.influence(points(large.mesh(), 0)).compliance;
  CHECK((a - 8 * 206000 * b).norm() < 1e-10 * a.norm());  // round-off
}

TEST_CASE("The same gear gives the same bits again", "[core][compliance][fe]") {
  const auto run = [] {
    const InfluenceModel model(gear_of(12, 10, 3), kUnit, coarse());
    return model.influence(points(model.mesh())).compliance;
  };
  CHECK(run() == run());
}

TEST_CASE("A helical tooth yields most at the tip of its acute end, and moves its neighbours", "[core][compliance][fe]") {
  const InfluenceModel model(gear_of(18, 30, 8), kUnit, coarse());
  const std::vector<FlankPoint> where = points(model.mesh());
  const Eigen::MatrixXd k = model.influence(where).compliance;
  const auto at = [](int tooth, int u, int v) { return 15 * (tooth + 1) + 5 * u + v; };
  for (int tooth : {-1, 0, 1}) {
    for (int v = 0; v < 5; ++v) {
      CHECK(k(at(tooth, 1, v), at(tooth, 1, v)) > k(at(tooth, 0, v), at(tooth, 0, v)));
      CHECK(k(at(tooth, 2, v), at(tooth, 2, v)) > k(at(tooth, 1, v), at(tooth, 1, v)));
    }
    for (int u = 0; u < 3; ++u) {
      CHECK(k(at(tooth, u, 0), at(tooth, u, 0)) > k(at(tooth, u, 4), at(tooth, u, 4)));
      CHECK(k(at(tooth, u, 4), at(tooth, u, 4)) > 1.3 * k(at(tooth, u, 2), at(tooth, u, 2)));
    }
  }
  for (int side : {-1, 1}) {
    CHECK(k(at(0, 1, 2), at(side, 1, 2)) > 0);
    CHECK(k(at(0, 1, 2), at(side, 1, 2)) < 0.4 * k(at(0, 1, 2), at(0, 1, 2)));
  }
  // Teeth are alike: the outer ones differ from the middle one by their mesh only.
  for (int u = 0; u < 3; ++u) {
    CHECK(k(at(1, u, 2), at(1, u, 2)) == Approx(k(at(0, u, 2), at(0, u, 2))).epsilon(0.05));  // discretisation
  }
}

TEST_CASE("On a rigid body teeth yield less, the material below them does not matter, and they hardly move each other", "[core][compliance][fe]") {
  const GearToMesh gear = gear_of(40, 15, 4);
  const InfluenceModel elastic(gear, kUnit, coarse());
  const std::vector<FlankPoint> where = points(elastic.mesh());
  const auto on_rigid_body = [&](double shaft_diameter) {
    GearToMesh held = gear;
    held.body.rigid = true;
    held.body.shaft_diameter = shaft_diameter;
    const InfluenceModel model(held, kUnit, coarse());
    CHECK(model.solid().unknowns() < elastic.solid().unknowns());
    const Eigen::MatrixXd K = model.influence(where, RemovedRigidMotion::None).compliance;
    // A body that does not move has no motion to take off, and no axial hold.
    CHECK((model.influence(where).compliance - K).cwiseAbs().maxCoeff() <= 1e-14 * K.maxCoeff());  // round-off
    return K;
  };
  const Eigen::MatrixXd rigid = on_rigid_body(not_given);
  // Discretisation: another shaft moves the elements below, between which a load deep in the tooth is shared out.
  CHECK((on_rigid_body(20) - rigid).cwiseAbs().maxCoeff() < 1e-3 * rigid.maxCoeff());

  // Whatever is held yields less to any load: the difference is positive semi-definite, as long as no motion is taken off.
  const Eigen::MatrixXd free = elastic.influence(where, RemovedRigidMotion::None).compliance;
  const Eigen::VectorXd values = symmetric_eigenvalues(free - rigid);
  CHECK(values.minCoeff() > -1e-12 * values.maxCoeff());  // round-off x condition

  const Eigen::MatrixXd net = elastic.influence(where).compliance;
  const Eigen::Index own = 15 + 7, next = 30 + 7;  // half height at mid face
  CHECK(rigid(own, own) < net(own, own));
  CHECK(rigid(own, own) > 0.5 * net(own, own));
  CHECK(std::abs(rigid(own, next)) < 0.2 * net(own, next));
}

TEST_CASE("The default mesh is converged to two percent", "[core][compliance][fe][.soak]") {
  const GearToMesh gear = gear_of(GENERATE(18, 40), 30, 6);
  GearMeshOptions usual, fine;
  usual.teeth_each_side = fine.teeth_each_side = 1;
  fine.flank_elements = 12;
  fine.fillet_elements = 8;
  fine.half_thickness_elements = 5;
  fine.end_element = 0.08;
  fine.axial_growth = 1.25;
  fine.largest_element = 0.25;
  fine.body_growth = 1.6;
  fine.shaft_elements = 4;
  const auto run = [&](const GearMeshOptions& options) {
    const InfluenceModel model(gear, kUnit, options);
    std::vector<FlankPoint> grid;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 20; ++j) {
        grid.push_back({0, model.mesh().form.form_radius() + i / 5.0 * (model.mesh().form.tip_radius() - model.mesh().form.form_radius()),
                        (j / 19.0 - 0.5) * model.mesh().face_width});
      }
    }
    return model.influence(grid).compliance;
  };
  const Eigen::MatrixXd a = run(usual), b = run(fine);
  const Eigen::VectorXd scale = b.diagonal().cwiseSqrt();
  const Eigen::MatrixXd apart = ((a - b).array() / (scale * scale.transpose()).array()).abs();
  CAPTURE(apart.diagonal().reshaped(20, 6).transpose());
  CHECK(apart.maxCoeff() < 0.02);  // discretisation
}
