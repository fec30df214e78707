#include "core/compliance/finite_element/root_stress_correction.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/compliance/finite_element/load_functional.hpp"
#include "core/compliance/finite_element/solid_model.hpp"
#include "core/compliance/tooth/flank_stations.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/core/compliance/finite_element/flank_traction.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"

using namespace flankwright;
using namespace flankwright::test;

namespace {

GearPair pair_of(double helix_deg, double face) {
  PairData data;
  data.normal_module = 1;
  data.helix_angle = helix_deg * units::deg;
  data.pinion.teeth = 18;
  data.wheel.teeth = 54;
  data.pinion.face_width = data.wheel.face_width = face;
  return make_gear_pair(data);
}

/// One gear of a pair, m_n = 1, meshed in three dimensions.
struct Tooth {
  GearPair pair;
  Member member;
  GearMeshOptions options;
  GearMesh mesh;
  FilletStress stress;
  FilletGrid fillet;

  Tooth(const GearPair& of, Member m, const GearMeshOptions& elements)
      : pair(of),
        member(m),
        options(elements),
        mesh(gear_mesh(gear_of(of[m].data.teeth, of.data.helix_angle / units::deg, of.face_width), elements)),
        stress(mesh, kUnit),
        fillet(fillet_grid(mesh, stress)) {}

  RootStressCorrection correction() const {
    const auto section = [&](const GearMeshOptions& elements) { return LoadedSection(pair[member], pair, kUnit.poissons_ratio, elements); };
    return {section(fine_section()), section(options), pair[member], pair, fillet};
  }

  /// (s_tt, s_aa, s_ta) at the fillet's places under unit forces, once on the flank, each spread over a little of it, and once over the centre surface.
  Eigen::MatrixXd stresses(const SolidModel& solid, const std::vector<FlankStation>& forces, double spread) const {
    std::vector<FlankPoint> points;
    for (const FlankStation& f : forces) points.push_back({0, flank_radius(mesh.form, f.u), f.zeta - mesh.face_width / 2});
    Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(mesh.solid.nodes.size(), 2);
    for (const FlankPoint& p : points) loads.col(0) += flank_traction(mesh, p, spread);
    loads.col(1) = net_functionals(mesh, points, RemovedRigidMotion::None).centre * Eigen::VectorXd::Ones(std::ssize(points));
    std::vector<FilletPoint> places;
    for (const double along : fillet.along) {
      for (const double zeta : fillet.zetas) places.push_back({along, zeta - mesh.face_width / 2});
    }
    return stress.functionals(places).transpose() * solid.solve(loads.sparseView());
  }
};

/// Unit forces evenly along the flank at a height, a piece of the face each.
std::vector<FlankStation> line(double height, double begin, double end, double piece) {
  const int n = static_cast<int>(std::lround((end - begin) / piece));
  std::vector<FlankStation> line;
  for (int i = 0; i < n; ++i) line.push_back({0, 2 * height - 1, begin + (end - begin) * (i + 0.5) / n});
  return line;
}

/// What unit forces add, one for each piece of a line along the face.
Eigen::VectorXd added(const RootStressCorrection& correction, const FilletGrid& fillet, const std::vector<FlankStation>& forces, double piece) {
  return correction.added(fillet, forces, std::vector<double>(forces.size(), piece), 1).rowwise().sum();
}

}  // namespace

TEST_CASE("Table, factor and correction are the stress of a load on the flank in three dimensions", "[core][compliance][fe][root-stress][slow]") {
  const double face = 4, piece = 0.1, spread = 0.25;
  GearMeshOptions options;
  options.teeth_each_side = 1;
  options.flank_elements = 12;
  options.fillet_elements = 12;
  options.half_thickness_elements = 5;
  options.end_element = 0.25;
  options.largest_element = 0.3;
  const Tooth tooth(pair_of(0, face), Member::Wheel, options);
  const RootStressCorrection correction = tooth.correction();
  const SolidModel solid(tooth.mesh.solid, kUnit, tooth.mesh.supports);
  const auto across = std::ssize(tooth.fillet.zetas);
  struct Line {
    double begin, end;
    double rms, most;  ///< error of s_tt over the largest s_tt
  };
  // Model: how the load's own field spreads along the face.
  for (const Line& loaded :
       {Line{0, face, 0.02, 0.07}, Line{0, face / 2, 0.02, 0.07}, Line{face / 2 - 0.2, face / 2 + 0.2, 0.025, 0.15}, Line{0, 0.4, 0.03, 0.17}}) {
    double squares = 0, most = 0, most_by_table = 0;
    const std::array heights{0.25, 0.5, 0.8};
    for (const double height : heights) {
      const std::vector<FlankStation> forces = line(height, loaded.begin, loaded.end, piece);
      const Eigen::MatrixXd stress = tooth.stresses(solid, forces, spread);
      const Eigen::VectorXd more = added(correction, tooth.fillet, forces, piece);
      double largest = 0;
      for (Eigen::Index row = 0; row < more.size(); ++row) largest = std::max(largest, stress(3 * row, 0));
      for (Eigen::Index row = 0; row < more.size(); ++row) {
        const double by_table = correction.places()[static_cast<std::size_t>(row / across)].factor * stress(3 * row, 1);
        const double error = (by_table + more[row] - stress(3 * row, 0)) / largest;
        squares += error * error / static_cast<double>(more.size() * std::ssize(heights));
        most = std::max(most, std::abs(error));
        most_by_table = std::max(most_by_table, std::abs(by_table - stress(3 * row, 0)) / largest);
      }
    }
    CAPTURE(loaded.begin, loaded.end, squares, most, most_by_table);
    CHECK(std::sqrt(squares) < loaded.rms);
    CHECK(most < loaded.most);
    CHECK(most < 0.7 * most_by_table);
  }
}

TEST_CASE("Factors take out what few elements along the fillet are wrong by", "[core][compliance][fe][root-stress]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const auto stress_at_mid_face = [&](int fillet_elements, int half_thickness_elements) {
    GearMeshOptions options;
    options.teeth_each_side = 1;
    options.fillet_elements = fillet_elements;
    options.half_thickness_elements = half_thickness_elements;
    options.end_element = options.largest_element = 1;
    const Tooth tooth(pair_of(0, 4), member, options);
    const SolidModel solid(tooth.mesh.solid, kUnit, tooth.mesh.supports);
    const Eigen::MatrixXd stress = tooth.stresses(solid, line(0.6, 0, 4, 0.2), 0.4);
    const RootStressCorrection correction = tooth.correction();
    std::vector<double> at_places;
    for (std::size_t i = 0; i < tooth.fillet.along.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i * tooth.fillet.zetas.size() + tooth.fillet.zetas.size() / 2);
      at_places.push_back(correction.places()[i].factor * stress(3 * row, 1));
    }
    return at_places;
  };
  const std::vector<double> coarse = stress_at_mid_face(6, 3), fine = stress_at_mid_face(12, 5);
  const double largest = *std::ranges::max_element(fine);
  // Model: the plane section for the tooth. Without the factors 1 to 5 %.
  for (std::size_t i = 0; i < fine.size(); ++i) CHECK(coarse[i] == Approx(fine[i]).margin(0.012 * largest));
}

TEST_CASE("A line adds the same however many pieces it is of, and an even one the plane value", "[core][compliance][fe][root-stress]") {
  const double face = 40;
  GearMeshOptions options = coarse();
  options.largest_element = 8;
  const Tooth tooth(pair_of(0, face), Member::Pinion, options);
  const RootStressCorrection correction = tooth.correction();
  const Eigen::VectorXd few = added(correction, tooth.fillet, line(0.3, 0, face, 2), 2),
                        many = 0.25 * added(correction, tooth.fillet, line(0.3, 0, face, 0.5), 0.5);
  CHECK((few - many).cwiseAbs().maxCoeff() < 1e-12 * few.maxCoeff());  // round-off
  const auto across = std::ssize(tooth.fillet.zetas);
  for (Eigen::Index row = 0; row < few.size(); ++row) {
    // Closed form: beyond both images of a face of 40 modules F has (d/40)^2/4 left.
    const RootStressCorrection::Place& place = correction.places()[static_cast<std::size_t>(row / across)];
    CHECK(few[row] == Approx(0.5 * place.added(0.3)).epsilon(0.0015));
  }
}

TEST_CASE("Root stress of a helical gear lies across the tooth", "[core][compliance][fe][root-stress]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  GearMeshOptions options;
  options.teeth_each_side = 1;
  options.end_element = 0.5;
  options.largest_element = 1;
  const Tooth tooth(pair_of(30, 6), member, options);
  const SolidModel solid(tooth.mesh.solid, kUnit, tooth.mesh.supports);
  const Eigen::MatrixXd stress = tooth.stresses(solid, line(0.7, 0, 6, 0.3), 0.4);
  const RootStressCorrection correction = tooth.correction();
  for (std::size_t i = 0; i < tooth.fillet.along.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i * tooth.fillet.zetas.size() + tooth.fillet.zetas.size() / 2);
    const PrincipalStress solved = largest_principal(stress.col(1).segment<3>(3 * row)), plane = largest_principal(correction.places()[i].components);
    CAPTURE(name_of(member), i, solved.direction.transpose(), plane.direction.transpose());
    CHECK(plane.value == Approx(1));
    // Model: the torsion of a narrow face turns it by up to 10 deg more, the same way.
    const double turned = std::asin(plane.direction[0] * solved.direction[1] - plane.direction[1] * solved.direction[0]);
    CHECK(turned > -2 * units::deg);
    CHECK(turned < 12 * units::deg);
  }
}
