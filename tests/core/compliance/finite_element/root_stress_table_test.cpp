#include "core/compliance/finite_element/root_stress_table.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "core/compliance/finite_element/influence.hpp"
#include "core/compliance/fitted/correction_fit.hpp"
#include "core/compliance/tooth/flank_stations.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"
#include "tests/reference/iso_6336_root_stress.hpp"

using namespace flankwright;
using namespace flankwright::test;

namespace {

/// Of the fillet on one tooth, under unit forces at n places: 3 P x n [m_n^2 MPa/N].
Eigen::MatrixXd stress_under(const RootStressTable& table, int tooth, std::span<const FlankStation> forces) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3 * table.fillet.size(), std::ssize(forces));
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const Eigen::MatrixXd* response = table.response(tooth, forces[i].tooth);
    if (response) result.col(static_cast<Eigen::Index>(i)) = *response * table.grid.weights(forces[i]);
  }
  return result;
}

/// The table of a meshed gear, as solve_influence_table() makes it.
RootStressTable solved_table(const GearMesh& mesh, const SolidModel& solid, const StationGrid& grid) {
  std::vector<FlankPoint> points;
  for (int tooth = -mesh.teeth_each_side; tooth <= mesh.teeth_each_side; ++tooth) {
    for (const FlankStation& station : grid.stations(tooth)) {
      points.push_back({tooth, flank_radius(mesh.form, station.u), station.zeta * mesh.normal_module - mesh.face_width / 2});
    }
  }
  const RootStressReadings readings = root_stress_readings(mesh, kUnit, grid);
  const FlankInfluence influence = solve_flank_influence(mesh, solid, kUnit, points, RemovedRigidMotion::TranslationTorsionAndTilt, readings.stress);
  return root_stress_table(mesh, grid, readings.fillet, influence.readings, readings.stress.transpose() * solid.solve(readings.on_the_flank));
}

struct SolvedGear {
  GearMesh mesh;
  SolidModel solid;
  RootStressTable table;

  SolvedGear(const GearToMesh& gear, const GearMeshOptions& options)
      : mesh(gear_mesh(gear, options)),
        solid(mesh.solid, kUnit, mesh.supports),
        table(solved_table(mesh, solid, station_grid(gear.gear.face_width / gear.normal_module, 5))) {}

  FlankPoint point(const FlankStation& station) const {
    const double root = mesh.form.form_radius(), tip = mesh.form.tip_radius();
    return {station.tooth, root + (station.u + 1) / 2 * (tip - root), station.zeta * mesh.normal_module - mesh.face_width / 2};
  }
  /// Stress of the fillet's places under forces, by a solution per force.
  Eigen::MatrixXd solved(const std::vector<FlankStation>& forces, RemovedRigidMotion removed) const {
    std::vector<FlankPoint> points;
    for (const FlankStation& force : forces) points.push_back(point(force));
    std::vector<FilletPoint> stations;
    for (const double along : table.fillet.along) {
      for (const double zeta : table.fillet.zetas) stations.push_back({along, zeta * mesh.normal_module - mesh.face_width / 2});
    }
    Eigen::SparseMatrix<double> loads = net_functionals(mesh, points, removed).whole();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].tooth != 0) continue;
      const Eigen::SparseVector<double> moved = flank_functional(mesh, points[i]) - centre_functional(mesh, points[i]);
      Eigen::SparseMatrix<double> one(loads.rows(), loads.cols());
      one.reserve(moved.nonZeros());
      for (Eigen::SparseVector<double>::InnerIterator entry(moved); entry; ++entry)
        one.insert(entry.index(), static_cast<Eigen::Index>(i)) = entry.value();
      loads += one;
    }
    return std::pow(mesh.normal_module, 2) * FilletStress(mesh, kUnit).functionals(stations).transpose() * solid.solve(loads);
  }
};

constexpr auto kNet = RemovedRigidMotion::TranslationTorsionAndTilt;

/// Largest principal stress m_n b / F of a line load spread evenly along a spur tooth at u, at mid face: the 30 deg
/// tangent's, and the largest along the fillet.
std::pair<double, double> under_line_load(const RootStressTable& table, double u) {
  constexpr int kForces = 60;
  const double width = table.grid.face_width();
  std::vector<FlankStation> forces;
  for (int i = 0; i < kForces; ++i) forces.push_back({0, u, width * (i + 0.5) / kForces});
  const Eigen::VectorXd stress = width * stress_under(table, 0, forces).rowwise().mean();
  const std::size_t n = table.fillet.zetas.size();
  const auto at = [&](std::size_t along) { return largest_principal(stress.segment<3>(3 * static_cast<Eigen::Index>(along * n + n / 2))).value; };
  double largest = 0;
  for (std::size_t i = 0; i < table.fillet.along.size(); ++i) largest = std::max(largest, at(i));
  return {at(table.fillet.tangent), largest};
}

/// Largest principal stress m_n b / F of the fillet under an even line load that crosses the flank as contact lines of a
/// helical gear do, through u at mid face.
double under_oblique_line(const RootStressTable& table, double u) {
  constexpr int kForces = 120;
  constexpr double kSlope = 0.2;  // of u over zeta, helix 30 deg
  const double width = table.grid.face_width();
  std::vector<FlankStation> forces;
  for (int i = 0; i < kForces; ++i) {
    const double zeta = width * (i + 0.5) / kForces, here = u + kSlope * (zeta - width / 2);
    if (std::abs(here) <= 1) forces.push_back({0, here, zeta});
  }
  const Eigen::VectorXd stress = width / kForces * stress_under(table, 0, forces).rowwise().sum();
  double largest = 0;
  for (Eigen::Index i = 0; i < table.fillet.size(); ++i) largest = std::max(largest, largest_principal(stress.segment<3>(3 * i)).value);
  return largest;
}

}  // namespace

TEST_CASE("A root stress table holds what a solution per force gives", "[core][compliance][fe][root-stress]") {
  const SolvedGear gear(gear_of(18, 20, 3, 0, 4), coarse());
  for (const int tooth : {-1, 0, 1}) {
    CAPTURE(tooth);
    std::vector<FlankStation> on_grid{gear.table.grid.stations(tooth)[3], gear.table.grid.stations(tooth)[21]};
    const Eigen::MatrixXd solved = gear.solved(on_grid, kNet);
    const Eigen::MatrixXd table = stress_under(gear.table, 0, on_grid);
    CHECK((table - solved).cwiseAbs().maxCoeff() < 1e-9 * solved.cwiseAbs().maxCoeff());  // round-off x condition
  }
  const std::vector<FlankStation> unseen{{0, 0.7, 1.3}, {0, 0.1, 0.4}, {0, -0.4, 2.2}};
  const Eigen::MatrixXd solved = gear.solved(unseen, kNet), table = stress_under(gear.table, 0, unseen);
  for (int i = 0; i < 3; ++i) {
    const double largest = solved.col(i).cwiseAbs().maxCoeff();
    CHECK((table - solved).col(i).cwiseAbs().maxCoeff() < 0.03 * largest);  // discretisation of the grid
  }
  // How the shaft is held, and with it the motion taken out, hardly reaches the root (model).
  const Eigen::MatrixXd held = gear.solved(unseen, RemovedRigidMotion::None);
  CHECK((held - solved).cwiseAbs().maxCoeff() < 0.02 * solved.cwiseAbs().maxCoeff());
}

TEST_CASE("Teeth are alike to a root stress table, and far ones do not matter to it", "[core][compliance][fe][root-stress]") {
  const SolvedGear gear(gear_of(18, 0, 3), coarse());
  const std::vector<FlankStation> near{{0, 0.5, 1}, {1, 0.2, 2}}, turned{{7, 0.5, 1}, {8, 0.2, 2}};
  CHECK(stress_under(gear.table, 0, near) == stress_under(gear.table, 7, turned));
  CHECK(stress_under(gear.table, -2, near).isZero(0));
  CHECK_FALSE(stress_under(gear.table, 2, near).col(1).isZero(0));
  CHECK_THROWS_AS(stress_under(gear.table, 0, std::vector<FlankStation>{{0, 1.2, 1}}), InvalidInput);
}

TEST_CASE("A spur gear's root stress mirrors with its load", "[core][compliance][fe][root-stress]") {
  const double width = 4;
  const SolvedGear gear(gear_of(24, 0, width), coarse());
  const std::size_t n = gear.table.fillet.zetas.size();
  for (const double zeta : {0.2, 1.0, 1.7}) {
    const Eigen::VectorXd a = stress_under(gear.table, 0, std::vector<FlankStation>{{0, 0.6, zeta}});
    const Eigen::VectorXd b = stress_under(gear.table, 0, std::vector<FlankStation>{{0, 0.6, width - zeta}});
    Eigen::VectorXd mirrored(b.size());
    for (std::size_t i = 0; i < gear.table.fillet.along.size(); ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        mirrored.segment<3>(3 * static_cast<Eigen::Index>(i * n + j)) =
            b.segment<3>(3 * static_cast<Eigen::Index>(i * n + n - 1 - j)).cwiseProduct(Eigen::Vector3d(1, 1, -1));
      }
    }
    // Model: the torque leaves at one end of the face only.
    CHECK((a - mirrored).cwiseAbs().maxCoeff() < 0.03 * a.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("A root is stressed most below the force, more by a higher one, and little by one on the next tooth",
          "[core][compliance][fe][root-stress]") {
  const SolvedGear gear(gear_of(20, 0, 6), coarse());
  const auto peak = [&](const FlankStation& force) {
    const Eigen::VectorXd stress = stress_under(gear.table, 0, std::vector{force});
    std::pair<double, double> found{0, -1};
    for (Eigen::Index i = 0; i < gear.table.fillet.size(); ++i) {
      const double value = largest_principal(stress.segment<3>(3 * i)).value;
      if (value > found.first) found = {value, gear.table.fillet.zetas[i % gear.table.fillet.zetas.size()]};
    }
    return found;
  };
  for (const double zeta : {1.0, 3.0, 4.5}) CHECK(std::abs(peak({0, 0.8, zeta}).second - zeta) < 1);
  CHECK(peak({0, 1, 3}).first > 1.2 * peak({0, 0, 3}).first);
  CHECK(peak({0, 1, 0.3}).first > 1.2 * peak({0, 1, 3}).first);  // less tooth beside it
  CHECK(peak({1, 0, 3}).first < 0.3 * peak({0, 0, 3}).first);
  CHECK(peak({-1, 0, 3}).first < 0.3 * peak({0, 0, 3}).first);
}

TEST_CASE("Method B of ISO 6336-3 as written here: its critical section is the profile's", "[core][compliance][root-stress]") {
  for (const int teeth : {18, 40, 100}) {
    const GearToMesh gear = gear_of(teeth, 0);
    const ToothForm form(gear.gear, 1, gear.pressure_angle, 0);
    const Iso6336Root root = iso_6336_root(gear.gear, gear.pressure_angle);
    CHECK(root.chord == Approx(2 * form.root_tangent_point(30 * units::deg).x).epsilon(1e-6));  // round-off of iterations
  }
}

TEST_CASE("Root stress of spur gears under a load line at the tip is near ISO 6336-3, method B", "[core][compliance][fe][root-stress][.soak]") {
  GearMeshOptions options;
  options.teeth_each_side = 1;
  options.fillet_elements = 9;
  for (const int teeth : {18, 40, 100}) {
    const GearToMesh gear = gear_of(teeth, 0, 8);
    const auto [tangent, largest] = under_line_load(SolvedGear(gear, options).table, 1);
    const double iso = iso_6336_root(gear.gear, gear.pressure_angle).stress;
    CAPTURE(teeth, iso, tangent, largest);
    // Model: Y_S is a formula through scattered results for the maximum, whose place it does not tell. Found 1 to 4 % below.
    CHECK(std::abs(tangent / iso - 1) < 0.06);
    CHECK(tangent < iso);
    CHECK(largest >= tangent);
    CHECK(largest < 1.04 * tangent);
  }
}

TEST_CASE("Root stress converges with the elements along the fillet", "[core][compliance][fe][root-stress][.soak]") {
  const auto largest = [](int elements) {
    GearMeshOptions options;
    options.teeth_each_side = 1;
    options.fillet_elements = elements;
    return under_line_load(SolvedGear(gear_of(18, 0, 4), options).table, 1).second;
  };
  const double finest = largest(16);
  CHECK(std::abs(largest(3) / finest - 1) < 0.04);
  CHECK(std::abs(largest(6) / finest - 1) < 0.02);
  CHECK(std::abs(largest(9) / finest - 1) < 0.01);
  CHECK(std::abs(largest(12) / finest - 1) < 0.005);
}

TEST_CASE("Root stress converges with the elements below the fillet and along it, by the meshes of fe and fitted gears",
          "[core][compliance][fe][root-stress][.soak]") {
  const int teeth = GENERATE(18, 54);
  GearMeshOptions finer, usual, fitted = coarse_mesh();
  finer.fillet_elements = 12;
  finer.half_thickness_elements = 6;
  finer.teeth_each_side = usual.teeth_each_side = fitted.teeth_each_side = 1;
  const auto table = [&](const GearMeshOptions& options) { return SolvedGear(gear_of(teeth, 30, 4), options).table; };
  const RootStressTable by_finer = table(finer), by_usual = table(usual), by_fitted = table(fitted);
  for (const double u : {0.0, 0.5, 0.9, 1.0}) {
    const double truth = under_oblique_line(by_finer, u), fe = under_oblique_line(by_usual, u) / truth,
                 coarse = under_oblique_line(by_fitted, u) / truth;
    WARN("Z " << teeth << ", u " << u << ": " << truth << ", fe " << 100 * (fe - 1) << " %, fitted " << 100 * (coarse - 1) << " %");
    // Discretisation; before elements thinned out towards the fillet 5 to 8 % with 54 teeth.
    CHECK(std::abs(fe - 1) < 0.03);
    CHECK(std::abs(coarse - fe) < 0.015);
  }
}
