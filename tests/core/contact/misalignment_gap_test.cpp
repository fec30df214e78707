#include "core/contact/gap/misalignment_gap.hpp"

#include <catch2/catch.hpp>

#include "core/base/error.hpp"
#include "core/contact/gap/condition_gap.hpp"
#include "tests/common/random.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;

namespace {

/// As a poor housing has it.
Misalignment of_every_kind(tests::Random& random) {
  Misalignment m;
  for (const NamedMisalignmentParameter& p : misalignment_parameters) m.*p.parameter = random(-1.0, 1.0) * units::arcmin;
  m.centre_distance = random(-0.1, 0.1);
  m.mesh_misalignment = random(-0.02, 0.02);
  m.axial_offset = random(-2.0, 2.0);
  return m;
}

}  // namespace

TEST_CASE("Gaps change with misalignment as central differences say", "[core][contact][gap][gradient]") {
  // Discretisation, step^2 times a third derivative of the order of the radius, and round-off of gaps below 1 mm over the step;
  // relative to the largest derivative.
  constexpr double kDifference = 1e-8, step = 1e-5;
  // Of a wheel that moves along the profile both are differences: where contact comes to an edge the curvature jumps within steps of 5e-5 mm.
  constexpr double kEdge = 1e-5;
  const double helix = GENERATE(0.0, 12.0, 30.0);
  const bool left = GENERATE(false, true);
  tests::Random random(71);
  PairData data = mesh_cases::pair_data(19, 41, helix, 5, 60);
  data.working_flank = left ? WorkingFlank::Left : WorkingFlank::Right;
  const GearPair pair = make_gear_pair(data);
  const MeshModel model = mesh_cases::model(pair, {{}, {0.2, 0.9}});
  for (int trial = 0; trial < 10; ++trial) {
    FlankCondition condition;
    condition.misalignment = of_every_kind(random);
    for (const MeshPosition& at : model.positions) {
      for (const NamedMisalignmentParameter& p : misalignment_parameters) {
        if (p.parameter == &Misalignment::axial_offset) continue;  // moves the points: core/load
        CAPTURE(helix, left, trial, std::string(p.name));
        const auto gap = [&](double by) {
          FlankCondition moved = condition;
          moved.misalignment.*p.parameter += by;
          return plane_of_action_gap(pair, at.points, moved).total;
        };
        const Eigen::VectorXd difference = (gap(step) - gap(-step)) / (2 * step);
        const Eigen::VectorXd exact = misalignment_slopes(pair, at.points, condition, p.parameter).gap;
        const bool moves_wheel =
            p.parameter == &Misalignment::crossing || p.parameter == &Misalignment::intersecting || p.parameter == &Misalignment::centre_distance;
        const double allowed = moves_wheel ? kEdge : kDifference;
        CHECK((exact - difference).cwiseAbs().maxCoeff() <= allowed * exact.cwiseAbs().maxCoeff() + kDifference);
        CHECK(exact.cwiseAbs().maxCoeff() > 0.1);  // mm/rad or mm/mm
      }
    }
  }
}

TEST_CASE("There is no derivative at held contact points with respect to what moves them", "[core][contact][gap][input]") {
  const GearPair pair = mesh_cases::pair(20, 40, 0, 4, 30);
  const MeshModel model = mesh_cases::model(pair, {{}, {0.5}});
  CHECK_THROWS_AS(misalignment_slopes(pair, model.positions[0].points, {}, &Misalignment::axial_offset), InvalidInput);
  const FlankCondition aligned;
  const ConditionGap surface(pair, GapModel::WholeSurface, aligned);
  CHECK_THROWS_AS(surface.slopes(model.positions[0].points, &Misalignment::crossing), InvalidInput);
}
