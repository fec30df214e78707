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
#include "tests/core/gear/pair_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using namespace flankwright::test;

namespace {

GearPair pair_of(double helix_deg, double face) { return pair_cases::pair(18, 54, helix_deg, 1, face); }

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

  FlankPoint point(const FlankStation& station) const { return {0, flank_radius(mesh.form, station.u), station.zeta - mesh.face_width / 2}; }

  /// (s_tt, s_aa, s_ta) at places along a fillet, three rows each, under loads.
  Eigen::MatrixXd stresses(const Eigen::SparseMatrix<double>& loads, const FilletGrid& at) const {
    std::vector<FilletPoint> places;
    for (const double along : at.along) {
      for (const double zeta : at.zetas) places.push_back({along, zeta - mesh.face_width / 2});
    }
    return stress.functionals(places).transpose() * SolidModel(mesh.solid, kUnit, mesh.supports).solve(loads);
  }

  /// flank_functional() at stations.
  Eigen::SparseMatrix<double> on_flank(const std::vector<FlankStation>& stations) const {
    Eigen::MatrixXd loads(mesh.solid.nodes.size(), std::ssize(stations));
    for (std::size_t i = 0; i < stations.size(); ++i) loads.col(static_cast<Eigen::Index>(i)) = flank_functional(mesh, point(stations[i]));
    return loads.sparseView();
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
  // Of lines along the flank, which at the acute end of a helical tooth have the load nearest to the fillet.
  const auto [member, helix] = GENERATE(std::pair{Member::Pinion, 0.0}, std::pair{Member::Wheel, 30.0});
  const double face = 4, piece = 0.2;
  const GearPair pair = pair_of(helix, face);
  GearMeshOptions usual, finer;
  usual.teeth_each_side = finer.teeth_each_side = 1;
  finer.flank_elements = 12;
  finer.fillet_elements = 12;
  finer.half_thickness_elements = 5;
  finer.end_element = finer.largest_element = 0.25;
  const Tooth tooth(pair, member, usual), truth(pair, member, finer);
  const RootStressCorrection correction = tooth.correction();
  const StationGrid grid = station_grid(face);
  const Eigen::MatrixXd table = tooth.stresses(tooth.on_flank(grid.stations()), tooth.fillet);

  struct Line {
    double height, begin, end;
    double rms, largest;  ///< error over the largest stress: of all places, and of that stress
  };
  // Discretisation of both meshes, and how the load's own field spreads along the face.
  const std::vector<Line> lines{{0.25, 0, face / 2, 0.022, 0.045}, {0.5, 0, face, 0.018, 0.012}};
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(truth.mesh.solid.nodes.size(), std::ssize(lines));
  for (std::size_t k = 0; k < lines.size(); ++k) {
    for (const FlankStation& force : line(lines[k].height, lines[k].begin, lines[k].end, piece)) {
      loads.col(static_cast<Eigen::Index>(k)) += flank_traction(truth.mesh, truth.point(force), 0.25);
    }
  }
  const Eigen::MatrixXd solved = truth.stresses(loads.sparseView(), tooth.fillet);
  const auto across = std::ssize(tooth.fillet.zetas);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::vector<FlankStation> forces = line(lines[k].height, lines[k].begin, lines[k].end, piece);
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(grid.size());
    for (const FlankStation& force : forces) weights += grid.weights(force);
    const Eigen::VectorXd by_table = table * weights;
    const double slant = std::cos(pair.base_helix_angle);
    const Eigen::VectorXd more = correction.added(tooth.fillet, forces, std::vector<double>(forces.size(), piece / slant), slant).rowwise().sum();
    double squares = 0, largest = 0, largest_solved = 0;
    for (Eigen::Index i = 0; i < more.size(); ++i) {
      const RootStressCorrection::Place& place = correction.places()[static_cast<std::size_t>(i / across)];
      const Eigen::Vector3d own = place.factor * by_table.segment<3>(3 * i) + more[i] * place.components;
      const double here = largest_principal(own).value, there = largest_principal(solved.col(static_cast<Eigen::Index>(k)).segment<3>(3 * i)).value;
      squares += std::pow(here - there, 2) / static_cast<double>(more.size());
      largest = std::max(largest, here);
      largest_solved = std::max(largest_solved, there);
    }
    CAPTURE(name_of(member), helix, lines[k].height, lines[k].end);
    CHECK(std::sqrt(squares) < lines[k].rms * largest_solved);
    CHECK(largest == Approx(largest_solved).epsilon(lines[k].largest));
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
    const Eigen::VectorXd stress = tooth.stresses(tooth.on_flank(line(0.6, 0, 4, 0.2)), tooth.fillet).rowwise().sum();
    const RootStressCorrection correction = tooth.correction();
    std::vector<double> at_places;
    for (std::size_t i = 0; i < tooth.fillet.along.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i * tooth.fillet.zetas.size() + tooth.fillet.zetas.size() / 2);
      at_places.push_back(correction.places()[i].factor * stress[3 * row]);
    }
    return at_places;
  };
  const std::vector<double> coarse = stress_at_mid_face(6, 3), fine = stress_at_mid_face(12, 5);
  const double largest = *std::ranges::max_element(fine);
  // Model: the plane section for the tooth. Without the factors 1 to 5 %.
  for (std::size_t i = 0; i < fine.size(); ++i) CHECK(coarse[i] == tests::about(fine[i], 0.012 * largest));
}

TEST_CASE("A line adds the same however many pieces it is of, and an even one the plane value", "[core][compliance][fe][root-stress]") {
  const double face = 40;
  GearMeshOptions options = coarse();
  options.largest_element = 8;
  const Tooth tooth(pair_of(0, face), Member::Pinion, options);
  const RootStressCorrection correction = tooth.correction();
  const Eigen::VectorXd few = added(correction, tooth.fillet, line(0.3, 0, face, 2), 2),
                        many = 0.25 * added(correction, tooth.fillet, line(0.3, 0, face, 0.5), 0.5);
  CHECK((few - many).cwiseAbs().maxCoeff() < 1e-12 * few.cwiseAbs().maxCoeff());  // round-off
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
  const Eigen::VectorXd stress = tooth.stresses(tooth.on_flank(line(0.7, 0, 6, 0.3)), tooth.fillet).rowwise().sum();
  const RootStressCorrection correction = tooth.correction();
  for (std::size_t i = 0; i < tooth.fillet.along.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i * tooth.fillet.zetas.size() + tooth.fillet.zetas.size() / 2);
    const PrincipalStress solved = largest_principal(stress.segment<3>(3 * row)), plane = largest_principal(correction.places()[i].components);
    CAPTURE(name_of(member), i, solved.direction.transpose(), plane.direction.transpose());
    CHECK(plane.value == Approx(1).epsilon(1e-12));  // round-off
    // Model: the torsion of a narrow face turns it by up to 10 deg more, the same way.
    const double turned = std::asin(plane.direction[0] * solved.direction[1] - plane.direction[1] * solved.direction[0]);
    CHECK(turned > -2 * units::deg);
    CHECK(turned < 12 * units::deg);
  }
}
