#include "core/rating/load_sharing.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;
using mesh_cases::torque_for;

namespace {

std::map<int, double> shares_at(const GearPair& gears, double phase, const FlankCondition& condition = {}) {
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 5}, {phase}});
  const LoadedCycle cycle = analyse_cycle(model, condition, torque_for(gears, 200));
  std::map<int, double> shares;
  for (const ToothShare& tooth : load_sharing(model.positions[0], cycle.positions[0])) shares[tooth.tooth] = tooth.share;
  return shares;
}

}  // namespace

TEST_CASE("Shares of all teeth sum to the whole force", "[core][load][load-sharing]") {
  const GearPair gears = GENERATE(mesh_cases::pair(18, 54, 30, 10, 120), mesh_cases::pair(20, 40, 0, 4, 30));
  const double phase = GENERATE(0.0, 0.35, 0.8);
  double sum = 0;
  for (const auto& [tooth, share] : shares_at(gears, phase)) {
    CHECK(share >= 0);
    sum += share;
  }
  CHECK(sum == Approx(1).epsilon(1e-11));
}

TEST_CASE("Twin gears share alike before and after the middle of the path", "[core][load][load-sharing]") {
  constexpr double kRoundOff = 1e-9;
  const GearPair gears = GENERATE(mesh_cases::pair(24, 24, 0, 4, 30), mesh_cases::pair(24, 24, 20, 4, 30));
  const PathOfContact path(gears);
  // A line as far from its first phase as another is from its last: read from the other gear's side they are the same mesh.
  const double phase = 0.21, mirrored = path.last_line_phase() - phase;
  const int shift = static_cast<int>(std::floor(mirrored));
  const std::map<int, double> before = shares_at(gears, phase), after = shares_at(gears, mirrored - shift);
  for (const auto& [tooth, share] : before) {
    if (share == 0) continue;
    CAPTURE(tooth);
    const int twin = shift - tooth;
    REQUIRE(after.contains(twin));
    CHECK(after.at(twin) == Approx(share).epsilon(kRoundOff));
  }
}

TEST_CASE("A tooth that lags carries less", "[core][load][load-sharing]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30, 10, 120);
  FlankCondition condition;
  condition.error.pinion.cumulative_pitch = std::vector<double>(18, 0.0);
  condition.error.pinion.cumulative_pitch[2] = -3 * units::um;
  const auto perfect = shares_at(gears, 0.3), with_error = shares_at(gears, 0.3, condition);
  CHECK(with_error.at(2) < perfect.at(2));
  CHECK(with_error.at(1) > perfect.at(1));
  CHECK(load_sharing({}, {}).empty());
}
