#include "optimize/design/grinding/deciding_positions.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/common/random.hpp"
#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

TEST_CASE("What a few positions give is the objective of the design they are of, and a bound of every other", "[optimize][design][rounding]") {
  constexpr double solver = 1e-8;  // tolerance of the loads, which start from others at single positions
  const Objective objective{{term(GENERATE(Output::PeakContactStress, Output::TePeakToPeak, Output::PeakRootStress, Output::LoadFactor))},
                            Aggregate::Worst};
  CAPTURE(objective.name());
  DesignTask task = helical();
  task.objective = objective.terms;
  const DesignProblem problem(task);
  tests::Random32 random(3);
  const PerGear<Modification> best = problem.modification(random_design(problem.variables(), random));
  for (int scene = 0; scene < problem.scenes(); ++scene) {
    const LoadedCycle cycle = problem.analyse_scene(scene, best);
    const std::vector<std::size_t> positions = deciding_positions(objective, problem.scene_of(cycle, scene));
    REQUIRE_FALSE(positions.empty());
    REQUIRE(positions.size() < cycle.positions.size());
    CHECK(std::ranges::is_sorted(positions));
    for (int run = 0; run < 5; ++run) {
      const PerGear<Modification> design = run == 0 ? best : problem.modification(random_design(problem.variables(), random));
      const LoadedCycle some = problem.analyse_positions(scene, positions, design, &cycle);
      const double least = least_measure(objective, problem.scene_of(some, scene), positions);
      const double measure = problem.scene_measure(objective, problem.analyse_scene(scene, design), scene);
      CHECK(least <= measure * (1.0 + solver));
      if (run == 0) CHECK(least == Approx(measure).epsilon(solver));
    }
  }
}

TEST_CASE("A harmonic takes every position", "[optimize][design][rounding]") {
  DesignTask task = helical({0.0});
  const DesignProblem problem(task);
  const LoadedCycle cycle = problem.analyse_scene(0, {});
  for (const Objective& objective : {Objective{{term(Output::TeHarmonic, 1)}, Aggregate::Worst},
                                     Objective{{term(Output::PeakContactStress), term(Output::EffectiveContactRatio)}, Aggregate::Worst}}) {
    CHECK(deciding_positions(objective, problem.scene_of(cycle, 0)).empty());
  }
}
