#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

TEST_CASE("A tooth of a gear with many teeth leaves contact without a load", "[core][load]") {
  // Tip edges of such gears stay near the mate far outside the path of contact. An elastic tooth that leaves has no load left, so that the transmission error has
  // no step; with 200 positions its steepest part changes by a few per cent of the peak to peak from one to the next.
  const GearPair gears = GENERATE(mesh_cases::pair(100, 150, 0, 2, 20), mesh_cases::pair(180, 240, 0, 2, 20));
  constexpr int positions = 200;
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 6}, equally_spaced_phases(positions)});
  const LoadedCycle cycle = analyse_cycle(model, {}, mesh_cases::torque_for(gears, 500.0));
  REQUIRE(cycle.usable());
  const Eigen::VectorXd te = cycle.transmission_error();
  double step = 0.0;
  for (Eigen::Index i = 0; i < positions; ++i) step = std::max(step, std::abs(te[(i + 1) % positions] - te[i]));
  CAPTURE(gears.pinion.data.teeth, step / units::um, (te.maxCoeff() - te.minCoeff()) / units::um);
  CHECK(step < 0.15 * (te.maxCoeff() - te.minCoeff()));
}
