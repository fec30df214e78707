#include <catch2/catch.hpp>

#include "optimize/design/design_optimiser.hpp"
#include "tests/common/random.hpp"
#include "tests/optimize/design_tasks.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

/// A pair, a set of misalignments, an objective and how it is taken over the set, all at random.
DesignTask random_task(unsigned seed) {
  tests::Random32 random(seed);
  PairData data;
  data.normal_module = random.coarse(1.5, 8.0);
  data.helix_angle = random.one_of<double>({0.0, 10.0, 20.0, 30.0}) * units::deg;
  data.pinion.teeth = 18 + static_cast<int>(random.below(15));
  data.wheel.teeth = data.pinion.teeth + static_cast<int>(random.below(50));
  data.pinion.face_width = data.wheel.face_width = random.coarse(6.0, 12.0) * data.normal_module;
  DesignTask task;
  task.pair = make_gear_pair(data);
  task.resolution = {{QuadratureRule::Gauss2, 5}, equally_spaced_phases(8)};
  const double m = data.normal_module, reach = random.coarse(0.5, 1.5) * m * units::um;
  for (double share : {0.0, 1.0, -1.0}) {
    DesignScene scene;
    scene.name = std::to_string(share);
    scene.torque = random.coarse(0.8, 1.2) * 1.5 * m * m * m * units::newton_metre;  // some 1000 MPa at most
    scene.condition.misalignment.mesh_misalignment = share * reach;
    task.scenes.push_back(scene);
  }
  const auto variable = [&](const char* name, ModificationParameter parameter, double low, double high) {
    task.variables.push_back({std::string("pinion.modification.") + name, Member::Pinion, parameter, low * m * units::um, high * m * units::um});
  };
  variable("lead_crowning", parameter_of("lead_crowning"), 0.0, 4.0);
  variable("lead_slope", parameter_of("lead_slope"), -2.0, 2.0);
  variable("profile_crowning", parameter_of("profile_crowning"), 0.0, 3.0);
  task.objective = {random.one_of<ObjectiveTerm>(
      {term(Output::PeakContactStress), term(Output::TePeakToPeak), term(Output::TeHarmonic, 1), term(Output::LoadFactor)})};
  task.over = random.one_of<Aggregation>({Aggregate::Worst, Aggregate::Mean, {Aggregate::Cvar, 2.0, 0.5}});
  return task;
}

/// What the issue asks of each problem from five starts.
void check_problem(unsigned seed) {
  const DesignTask task = random_task(seed);
  DesignProblem problem(task);
  DesignOptions options;
  options.starts = 5;
  options.solver.seed = seed;
  const DesignResult result = optimise_design(problem, options);
  CAPTURE(seed, task.objective_name(), to_string(task.over), result.message, result.optimality.residual, result.optimality.complementarity,
          result.before.objective, result.after.objective, result.optima.size());
  REQUIRE_FALSE(result.optima.empty());
  const bool agree = result.optima.front().found_by >= 3;
  CAPTURE(result.optima.front().found_by);
  CHECK((agree || result.is_multimodal()));
  CHECK(result.optimality.satisfied());                                      // smooth or on a kink, which `active` then marks
  CHECK(result.after.objective <= result.before.objective * (1.0 + 1e-12));  // round-off
}

}  // namespace

TEST_CASE("Random problems from five starts have an optimum that most agree on, or are called multimodal", "[optimize][design][random]") {
  for (unsigned seed : {2U, 5U}) check_problem(seed);
}

TEST_CASE("Thirty random problems from five starts have an optimum that most agree on, or are called multimodal",
          "[optimize][design][random][.soak]") {
  for (unsigned seed = 1; seed <= 30; ++seed) check_problem(seed);
}
