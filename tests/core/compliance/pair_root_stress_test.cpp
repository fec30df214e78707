#include "core/compliance/pair/pair_root_stress.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/contact/path/path_of_contact.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/core/gear/pair_cases.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;

namespace {

constexpr double kStressModule = 4, kStressWidth = 24;

/// A table that says where a force and a fillet are: s_tt = teeth between them, s_aa = u of the force, s_ta = zeta of
/// the force less that of the fillet. Linear, so that splines interpolate it exactly.
std::shared_ptr<const RootStressTable> telltale(double face_width) {
  RootStressTable table{station_grid(face_width / kStressModule, 4), {{0.2, 0.5, 0.8}, 1, {0, 1, face_width / kStressModule}}, {}};
  const std::vector<FlankStation> forces = table.grid.stations();
  for (int m = -2; m <= 2; ++m) {
    Eigen::MatrixXd stress(3 * table.fillet.size(), table.grid.size());
    for (Eigen::Index p = 0; p < table.fillet.size(); ++p) {
      for (std::size_t f = 0; f < forces.size(); ++f) {
        const double zeta = table.fillet.zetas[static_cast<std::size_t>(p) % 3];
        stress.block<3, 1>(3 * p, static_cast<Eigen::Index>(f)) << m, forces[f].u, forces[f].zeta - zeta;
      }
    }
    table.stress.push_back(stress);
  }
  return std::make_shared<const RootStressTable>(std::move(table));
}

}  // namespace

TEST_CASE("Fillets of both gears feel forces where these are in the housing", "[core][compliance][root-stress]") {
  const auto [hand, flank] =
      GENERATE(std::pair{Hand::Right, WorkingFlank::Right}, std::pair{Hand::Left, WorkingFlank::Right}, std::pair{Hand::Right, WorkingFlank::Left});
  PairData data = pair_cases::pair_data(20, 33, 25, kStressModule, kStressWidth);
  data.pinion_hand = hand;
  data.working_flank = flank;
  data.wheel.face_width += 8;
  const double offset = 1.5;
  const GearPair pair = make_gear_pair(data);
  const std::vector<ContactPoint> points =
      contact_points(pair, PathOfContact(pair), {QuadratureRule::Gauss2, 3}, 0.8, false, -kStressWidth / 2, kStressWidth / 2);
  const TabulatedRootStress stress(pair, {telltale(kStressWidth)}, {telltale(kStressWidth + 8)});
  const RootStressInfluence found = stress.influence(points, offset);
  // All places together under arbitrary forces are what the places are one by one.
  const Eigen::VectorXd forces = Eigen::VectorXd::LinSpaced(std::ssize(points), 1.0, 2.0);
  const Eigen::VectorXd together = found.components(forces);
  REQUIRE(together.size() == 3 * std::ssize(found.stations));
  int tangents = 0;
  for (std::size_t p = 0; p < found.stations.size(); ++p) {
    const RootStation& station = found.stations[p];
    const bool pinion = station.member == Member::Pinion;
    tangents += station.tangent;
    CHECK(station.tangent == (station.along == 0.5));
    const double half = pair[station.member].data.face_width / 2;
    CHECK(std::abs(station.z - (pinion ? 0 : offset)) <= half * (1 + 1e-12));
    const Eigen::Matrix3Xd components = found.components_of(static_cast<Eigen::Index>(p));
    REQUIRE(components.cols() == std::ssize(points));
    CHECK((together.segment<3>(3 * static_cast<Eigen::Index>(p)) - components * forces).norm() <= 1e-12 * (1.0 + together.norm()));  // round-off
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d s = components.col(static_cast<Eigen::Index>(i)) * kStressModule * kStressModule;
      // The same number of teeth apart, in the mesh's own sense of counting on either gear; round-off of splines.
      CHECK(s[0] == tests::about((pinion ? -1 : 1) * (points[i].tooth - station.tooth), 1e-11));
      const double radius = pinion ? points[i].pinion_radius : points[i].wheel_radius;
      CHECK(s[1] ==
            tests::about(2 * (radius - pair[station.member].form_radius) / (pair[station.member].tip_radius - pair[station.member].form_radius) - 1,
                         1e-11));
      // zeta runs from the acute end, opposite ends on both gears: with z on one, against it on the other.
      const double along_z = (points[i].z - station.z) / kStressModule;
      const double sense = (pinion ? -1 : 1) * (pair.contact_line_sense() >= 0 ? 1.0 : -1.0);
      CHECK(s[2] == tests::about(sense * along_z, 1e-11));
    }
  }
  CHECK(tangents * 3 == static_cast<int>(found.stations.size()));
}
