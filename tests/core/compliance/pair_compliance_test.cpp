#include "core/compliance/pair/pair_compliance.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/compliance/finite_element/load_functional.hpp"
#include "core/gear/involute.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"
#include "tests/core/gear/pair_cases.hpp"
#include "tests/common/about.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;

namespace {

constexpr double kModule = 10, kWidth = 60;

GearPair pair_of(Hand hand, WorkingFlank flank) {
  PairData data = pair_cases::pair_data(18, 27, 30, kModule, kWidth);
  data.pinion_hand = hand;
  data.working_flank = flank;
  data.wheel.face_width += 20;
  return make_gear_pair(data);
}

GearMesh mesh_of(const GearPair& pair, Member member) {
  GearToMesh gear;
  gear.gear = pair.data[member];
  gear.normal_module = kModule;
  gear.pressure_angle = pair.data.pressure_angle;
  gear.helix_angle = pair.data.helix_angle;
  GearMeshOptions options = test::coarse();
  options.teeth_each_side = 2;
  return gear_mesh(gear, options);
}

/// Where a contact point on the theoretical path lies in the housing, drawn from nothing but the line of action: the
/// pinion's base tangent, inclined by the working pressure angle, at the roll length of the point's radius.
Eigen::Vector3d in_housing(const GearPair& pair, const ContactPoint& point) {
  const double alpha = pair.working_transverse_pressure_angle;
  const double s = pair.pinion.roll_length_at(point.pinion_radius) - pair.pitch_point;
  return {pair.pinion.working_pitch_radius + s * std::sin(alpha), s * std::cos(alpha), point.z};
}

}  // namespace

TEST_CASE("Contact points lie on the finite-element gears as in the housing: same radii and distances", "[core][compliance]") {
  const auto [hand, flank] =
      GENERATE(std::pair{Hand::Right, WorkingFlank::Right}, std::pair{Hand::Left, WorkingFlank::Right}, std::pair{Hand::Right, WorkingFlank::Left});
  const double axial_offset = 5;
  const GearPair pair = pair_of(hand, flank);
  const PathOfContact path(pair);
  const std::vector<ContactPoint> points = contact_points(pair, path, {QuadratureRule::Gauss2, 4}, 0.7, false, -0.5 * kWidth, 0.5 * kWidth);
  int teeth = 0;
  for (Member member : {Member::Pinion, Member::Wheel}) {
    const GearMesh mesh = mesh_of(pair, member);
    const Gear& gear = pair[member];
    int middle = 0;
    for (const ContactPoint& p : points) middle += flank_station(pair, member, p, axial_offset).tooth;
    middle = static_cast<int>(std::lround(static_cast<double>(middle) / static_cast<double>(points.size())));
    std::vector<LoadFrame> frames;
    for (const ContactPoint& p : points) {
      const FlankStation station = flank_station(pair, member, p, axial_offset);
      const double radius = gear.form_radius + (station.u + 1) / 2 * (gear.tip_radius - gear.form_radius);
      const double own = member == Member::Pinion ? p.pinion_radius : p.wheel_radius;
      CHECK(radius == Approx(own).epsilon(1e-12));
      frames.push_back(load_frame(mesh, {station.tooth - middle, radius, station.zeta * kModule - 0.5 * gear.data.face_width}));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        // Common normals are parallel all over the plane of action, and distances are those of the housing. Round-off.
        const double apart = (in_housing(pair, points[i]) - in_housing(pair, points[j])).norm();
        CHECK((frames[i].position - frames[j].position).norm() == tests::about(apart, 1e-9 * kModule));
        CHECK(frames[i].normal.dot(frames[j].normal) == tests::about(1.0, 1e-12));
        if (points[i].tooth != points[j].tooth) ++teeth;
      }
    }
  }
  CHECK(teeth > 0);  // the case has points on different teeth
}

TEST_CASE("The influence of thin slices is diagonal, and depends on the length of each slice", "[core][compliance]") {
  const GearPair pair = pair_of(Hand::Right, WorkingFlank::Right);
  const ThinSlicePair slices{ThinSlice(pair, {}, {})};
  const std::vector<ContactPoint> points =
      contact_points(pair, PathOfContact(pair), {QuadratureRule::Gauss2, 4}, 0.7, false, -0.5 * kWidth, 0.5 * kWidth);
  const Eigen::MatrixXd influence = slices.influence(points, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      const double expected = i == j ? slices.slice().compliance(points[i].pinion_radius, points[i].wheel_radius) / points[i].weight : 0.0;
      CHECK(influence(i, j) == expected);
    }
  }
}

namespace {

/// Says at which stations it is asked: K_ij = the product of a function of either.
class StationReader final : public FlankCompliance {
 public:
  Eigen::MatrixXd evaluate(std::span<const FlankStation> stations) const override {
    Eigen::VectorXd at(std::ssize(stations));
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      const FlankStation& s = stations[static_cast<std::size_t>(i)];
      at[i] = 1.0 + 0.1 * s.tooth + 0.3 * s.u + 0.7 * s.zeta;
    }
    return at * at.transpose();
  }
};

}  // namespace

TEST_CASE("The structure of a pair on its other flanks is that of the pair turned over end for end", "[core][compliance]") {
  const GearPair own = pair_of(Hand::Right, WorkingFlank::Right);
  const double axial_offset = 5;
  const GearStructure gear{.compliance = std::make_shared<const StationReader>(), .youngs_modulus = 2e5};
  const StructuralPair structure(own, gear, gear);
  const std::vector<ContactPoint> points =
      contact_points(own, PathOfContact(own), {QuadratureRule::Gauss2, 4}, 0.7, false, -0.5 * kWidth, 0.5 * kWidth);
  std::vector<ContactPoint> turned = points;
  for (ContactPoint& p : turned) p.z = -p.z;
  const Eigen::MatrixXd there = structure.influence(points, axial_offset), here = structure.on_other_flanks()->influence(turned, -axial_offset);
  CHECK((here - there).cwiseAbs().maxCoeff() <= 1e-13 * there.cwiseAbs().maxCoeff());  // round-off
  CHECK((structure.influence(turned, -axial_offset) - there).cwiseAbs().maxCoeff() > 1e-3 * there.cwiseAbs().maxCoeff());
}
