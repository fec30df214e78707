#include "core/compliance/finite_element/root_stress_correction.hpp"

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

/// One gear of a pair, m_n = 1, meshed in three dimensions.
struct Tooth {
  GearPair pair;
  Member member;
  GearMeshOptions options;
  GearMesh mesh;
  FilletStress stress;
  FilletGrid fillet;

  Tooth(const GearPair& of, Member m, double helix_deg, const GearMeshOptions& elements)
      : pair(of),
        member(m),
        options(elements),
        mesh(gear_mesh(gear_of(of[m].data.teeth, helix_deg, of[m].data.face_width), elements)),
        stress(mesh, kUnit),
        fillet(fillet_grid(mesh, stress)) {}

  RootStressCorrection correction() const {
    return {LoadedSection(pair[member], pair, kUnit.poissons_ratio, fine_section()), LoadedSection(pair[member], pair, kUnit.poissons_ratio, options),
            pair[member], pair, fillet};
  }
  double radius(double height) const { return flank_radius(mesh.form, 2 * height - 1); }
};

GearPair pair_of(double helix_deg, double face) {
  PairData data;
  data.normal_module = 1;
  data.helix_angle = helix_deg * units::deg;
  data.pinion.teeth = 18;
  data.wheel.teeth = 54;
  data.pinion.face_width = data.wheel.face_width = face;
  return make_gear_pair(data);
}

/// Even line load of 1 along the flank at a height from one axial place to another, as point forces a `step` apart.
std::vector<FlankStation> line(double height, double begin, double end, double step) {
  const int n = static_cast<int>(std::lround((end - begin) / step));
  std::vector<FlankStation> line;
  for (int i = 0; i < n; ++i) line.push_back({0, 2 * height - 1, begin + (end - begin) * (i + 0.5) / n});
  return line;
}

}  // namespace

TEST_CASE("Table, factor and correction are the stress of a load on the flank in three dimensions", "[core][compliance][fe][root-stress]") {
  const Member member = GENERATE(Member::Pinion, Member::Wheel);
  const double face = 5, step = 0.1, spread = 0.25;
  GearMeshOptions options;
  options.teeth_each_side = 1;
  options.flank_elements = 12;
  options.fillet_elements = 12;
  options.half_thickness_elements = 5;
  options.end_element = 0.25;
  options.largest_element = 0.25;
  const Tooth tooth(pair_of(0, face), member, 0, options);
  const RootStressCorrection correction = tooth.correction();
  const SolidModel solid(tooth.mesh.solid, kUnit, tooth.mesh.supports);
  std::vector<FilletPoint> places;
  for (const double along : tooth.fillet.along) {
    for (const double zeta : tooth.fillet.zetas) places.push_back({along, zeta - face / 2});
  }
  const Eigen::SparseMatrix<double> functionals = tooth.stress.functionals(places);
  const auto across = std::ssize(tooth.fillet.zetas);
  for (const double height : {0.25, 0.5, 0.8}) {
    for (const auto& [begin, end] : {std::pair{0.0, face}, std::pair{0.0, face / 2}, std::pair{face / 2 - 0.2, face / 2 + 0.2}, std::pair{0.0, 0.4}}) {
      const std::vector<FlankStation> forces = line(height, begin, end, step);
      Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(tooth.mesh.solid.nodes.size(), 2);
      std::vector<FlankPoint> points;
      for (const FlankStation& f : forces) points.push_back({0, tooth.radius(height), f.zeta - face / 2});
      for (const FlankPoint& p : points) loads.col(0) += flank_traction(tooth.mesh, p, spread);
      loads.col(1) = net_functionals(tooth.mesh, points, RemovedRigidMotion::None).centre * Eigen::VectorXd::Ones(std::ssize(points));
      const Eigen::MatrixXd stress = functionals.transpose() * solid.solve(loads.sparseView());
      const Eigen::VectorXd added = correction.added(tooth.fillet, forces, std::vector<double>(forces.size(), step), 1).rowwise().sum();
      for (const std::size_t i : {std::size_t{1}, tooth.fillet.tangent, std::size_t{5}}) {
        std::string text;
        for (Eigen::Index j = 0; j < across; j += 2) {
          const Eigen::Index row = static_cast<Eigen::Index>(i) * across + j;
          const double centre = stress(3 * row, 1), flank = stress(3 * row, 0), own = correction.places()[i].factor * centre + added[row];
          char cell[80];
          std::snprintf(cell, sizeof cell, " %5.2f %6.3f %6.3f %6.3f|", tooth.fillet.zetas[static_cast<std::size_t>(j)], flank / step, centre / step, own / step);
          text += cell;
        }
        WARN(name_of(member) << " h " << height << " load " << begin << ".." << end << " along " << tooth.fillet.along[i] << " f "
                             << correction.places()[i].factor << ":" << text);
      }
    }
  }
}
