#include "optimize/design/search/deciding_scenes.hpp"

#include <catch2/catch.hpp>

#include "optimize/design/search/local_run.hpp"
#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

const std::vector<double> misalignments{0.0, 2.0, -2.0, 4.0, -4.0, 6.0, -6.0, 8.0, -8.0, 10.0, -10.0, 12.0, -12.0};

/// A bound that no design comes near: the same optimum, searched over all scenes.
DesignTask with_idle_bound(DesignTask task) {
  task.constraints = {{task.objective.front(), 1e9}};
  return task;
}

}  // namespace

TEST_CASE("A worst case has the same optimum over the scenes that decide and over all", "[optimize][design][scenes]") {
  DesignTask task = helical(misalignments);
  task.objective = {GENERATE(term(Output::PeakContactStress), term(Output::PeakLineLoad))};
  // From a slope that makes one side of the misalignments decide; at the optimum both do.
  const double slope = GENERATE(0.0, 15.0, -15.0);
  set(task.modification.pinion, task.variables[1].parameter, slope * 1e-3);
  DesignProblem problem(task), all(with_idle_bound(task));
  REQUIRE(single_scenes_decide(problem.task()));
  REQUIRE_FALSE(single_scenes_decide(all.task()));
  SolverOptions options;
  options.name = "nlopt:slsqp";
  const LocalRun of_deciding = run_local(problem, options), of_all = run_local(all, options);
  CAPTURE(slope, of_deciding.message, of_all.message);
  // What is reported is the worst of all scenes.
  CHECK(of_deciding.objective == Approx(all.objective(all.analyse(of_deciding.x, false))).epsilon(1e-9));  // round-off of loads
  const double tolerance = task.objective.front().output == Output::PeakContactStress ? 1e-4 : 1e-3;       // of the solver, at a kink
  CHECK(of_deciding.objective == Approx(of_all.objective).epsilon(tolerance));
  if (slope == 0.0) CHECK(problem.cycles() < all.cycles());  // where the worst scenes of the start are those of the optimum
}

TEST_CASE("Scenes decide that exceed those searched over, and those nearly as bad", "[optimize][design][scenes]") {
  DesignProblem problem(helical(misalignments));
  const DesignAnalysis& analysis = problem.analyse(problem.start(), false);
  const std::vector<double> measures = problem.scene_measures(problem.task().combined_objective(), analysis);
  const auto least_of = [&](const std::set<int>& scenes) {
    double least = INFINITY;
    for (const int s : scenes) least = std::min(least, measures[static_cast<std::size_t>(s)]);
    return least;
  };
  const double worst = *std::ranges::max_element(measures);
  CHECK(deciding_scenes(problem, analysis, 0.0).size() == static_cast<std::size_t>(std::ranges::count(measures, worst)));
  CHECK(deciding_scenes(problem, analysis, 1.0).size() == measures.size());
  const std::set<int> near = deciding_scenes(problem, analysis, 0.1);
  CHECK(least_of(near) >= 0.9 * worst);
  // All that are worse than a scene by itself.
  for (int s = 0; s < problem.scenes(); ++s) {
    const double own = measures[static_cast<std::size_t>(s)];
    CHECK(deciding_scenes(problem, analysis, 0.0, {s}).size() ==
          static_cast<std::size_t>(std::ranges::count_if(measures, [&](double m) { return m >= own; })));
  }
  CHECK(worst_scenes(problem, analysis, 3).size() == 3);
  CHECK(worst_scenes(problem, analysis, 100).size() == measures.size());
}

TEST_CASE("A mean, a sum over a spectrum, a transmission error and a bound need every scene", "[optimize][design][scenes]") {
  DesignTask task = helical(misalignments);
  CHECK(single_scenes_decide(task));
  task.over = Aggregate::Mean;
  CHECK_FALSE(single_scenes_decide(task));
  task = helical(misalignments);
  for (const Output output : {Output::ContactDamage, Output::TePeakToPeak}) {
    task.objective = {term(output)};
    CHECK_FALSE(single_scenes_decide(task));
  }
  CHECK_FALSE(single_scenes_decide(with_idle_bound(helical(misalignments))));
}
