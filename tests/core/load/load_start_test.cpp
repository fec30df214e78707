#include "core/load/cycle/load_start.hpp"

#include <catch2/catch.hpp>
#include <functional>
#include <thread>
#include <vector>

#include "core/load/solve/load_solver.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

namespace {

double mean_iterations(const LoadedCycle& cycle) {
  double sum = 0.0;
  for (const LoadedPosition& position : cycle.positions) sum += position.load.iterations;
  return sum / static_cast<double>(cycle.positions.size());
}

}  // namespace

TEST_CASE("Points of a graded line correspond by their position between its ends", "[core][load]") {
  const GearPair gears = mesh_cases::pair(18, 54, 20.0, 3.0, 30.0);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 6}, equally_spaced_phases(32)});
  int compared = 0;
  for (std::size_t i = 1; i < model.positions.size(); ++i) {
    const MeshPosition &from = model.positions[i - 1], &to = model.positions[i];
    const auto found = corresponding_points(from, to);
    REQUIRE(found.size() == to.points.size());
    for (std::size_t j = 0; j < found.size(); ++j) {
      if (found[j] < 0) continue;
      const ContactPoint &here = to.points[j], &there = from.points[static_cast<std::size_t>(found[j])];
      CAPTURE(i, j);
      CHECK(here.tooth == there.tooth);
      CHECK((here.clearance == 0.0) == (there.clearance == 0.0));
      if (j > 0 && found[j - 1] >= 0) CHECK(found[j] > found[j - 1]);
      ++compared;
    }
  }
  CHECK(compared > 1000);
}

TEST_CASE("Points at the same z correspond where the rule does not move with the line", "[core][load]") {
  const GearPair gears = mesh_cases::pair(18, 54, 20.0, 3.0, 30.0);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Gauss2, 12}, equally_spaced_phases(16)});
  for (std::size_t i = 1; i < model.positions.size(); ++i) {
    const auto found = corresponding_points(model.positions[i - 1], model.positions[i]);
    for (std::size_t j = 0; j < found.size(); ++j) {
      if (found[j] >= 0) CHECK(model.positions[i - 1].points[static_cast<std::size_t>(found[j])].z == model.positions[i].points[j].z);
    }
  }
}

TEST_CASE("A cycle that starts from an earlier one's loads ends at the same, sooner", "[core][load]") {
  constexpr double kRoundOff = 1e-10;  // tolerance of the solver times the condition of the problem
  const GearPair gears = mesh_cases::pair(18, 54, 20.0, 3.0, 30.0);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 6}, equally_spaced_phases(32)});
  const double torque = mesh_cases::torque_for(gears, 200.0);
  FlankCondition condition;
  condition.modification.pinion.lead_crowning = 6 * units::um;
  condition.modification.pinion.tip_relief = {10 * units::um, 0.4, ReliefShape::Linear};
  const LoadedCycle earlier = analyse_cycle(model, condition, torque);
  const double change = GENERATE(1e-3, 0.1, 5.0);  // um
  condition.modification.pinion.lead_crowning += change * units::um;
  const LoadedCycle alone = analyse_cycle(model, condition, torque);
  const LoadedCycle after = analyse_cycle(model, condition, torque, {}, RootStresses::WithLoads, &earlier);
  REQUIRE(alone.usable());
  REQUIRE(after.usable());
  for (std::size_t i = 0; i < alone.positions.size(); ++i) {
    const LoadDistribution &a = alone.positions[i].load, &b = after.positions[i].load;
    CAPTURE(change, i);
    CHECK((a.line_load - b.line_load).lpNorm<Eigen::Infinity>() <= kRoundOff * a.line_load.maxCoeff());
    CHECK(b.transmission_error == Approx(a.transmission_error).epsilon(1e-12));
  }
  if (change <= 0.1) CHECK(mean_iterations(after) < mean_iterations(alone));
  CHECK(mean_iterations(alone) <= 4.0);
}

TEST_CASE("The halves of a cycle are those of the whole, and the same in any order and on any thread", "[core][load]") {
  constexpr double kRoundOff = 1e-10;  // tolerance of the solver times the condition of the problem
  const GearPair gears = mesh_cases::pair(18, 54, 20.0, 3.0, 30.0);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 6}, equally_spaced_phases(9)});  // halves of four and five
  const double torque = mesh_cases::torque_for(gears, 200.0);
  const std::vector<MeshParameter> parameters{PinionTorque{}};
  FlankCondition condition;
  const LoadedCycle earlier = analyse_cycle(model, condition, torque);
  condition.modification.pinion.lead_crowning = 2 * units::um;
  const auto by = [&](const ForEachIndex& for_each) {
    return analyse_cycle(model, condition, torque, parameters, RootStresses::WithLoads, &earlier, for_each);
  };
  const LoadedCycle whole = by({});
  const LoadedCycle backwards = by([](std::size_t count, const std::function<void(std::size_t)>& work) {
    for (std::size_t i = count; i-- > 0;) work(i);
  });
  const LoadedCycle side_by_side = by([](std::size_t count, const std::function<void(std::size_t)>& work) {
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < count; ++i) threads.emplace_back(work, i);
    for (std::thread& thread : threads) thread.join();
  });
  REQUIRE(whole.usable());
  REQUIRE(backwards.usable());
  CHECK(backwards.force_derivative == whole.force_derivative);
  for (std::size_t i = 0; i < whole.positions.size(); ++i) {
    CAPTURE(i);
    const LoadedPosition &a = whole.positions[i], &b = backwards.positions[i];
    CHECK(b.phase == a.phase);
    CHECK((b.load.line_load - a.load.line_load).lpNorm<Eigen::Infinity>() <= kRoundOff * a.load.line_load.maxCoeff());
    CHECK(b.transmission_error_derivative[0] == Approx(a.transmission_error_derivative[0]).epsilon(kRoundOff));
    CHECK(b.root_stress.size() == a.root_stress.size());
    CHECK(side_by_side.positions[i].load.line_load == b.load.line_load);
    CHECK(side_by_side.positions[i].transmission_error_derivative == b.transmission_error_derivative);
  }
}

TEST_CASE("A load far below round-off is taken from a point that should have none, whatever the others do", "[core][load]") {
  const GearPair gears = mesh_cases::pair(18, 54, 30.0, 10.0, 120.0);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Graded, 6}, equally_spaced_phases(8)});
  FlankCondition condition;
  condition.modification.pinion.lead_slope = 30 * units::um;
  const LoadedCycle cycle = analyse_cycle(model, condition, mesh_cases::torque_for(gears, 60.0));
  int left_over = 0;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const MeshPosition& at = model.positions[i];
    const LoadProblemView problem{at.influence, at.weight, cycle.positions[i].gap.total, at.laws, cycle.force};
    // To the last digit, so that the slope along a step is round-off alone.
    Eigen::VectorXd answer = cycle.positions[i].load.line_load;
    for (int again = 0; again < 4; ++again) answer = solve_load_distribution(problem, {}, answer).line_load;
    for (Eigen::Index k = 0; k < answer.size(); ++k) {
      if (answer[k] > 0.0) continue;
      for (const double load : {1e-24, 1e-27, 1e-30, 1e-33}) {
        Eigen::VectorXd start = answer;
        start[k] = load;
        const LoadDistribution found = solve_load_distribution(problem, {}, start);
        CAPTURE(i, k, load);
        REQUIRE(found.status == LoadStatus::Converged);
        CHECK(((found.line_load.array() > 0.0) == (answer.array() > 0.0)).all());
        ++left_over;
      }
    }
  }
  CHECK(left_over > 100);
}
