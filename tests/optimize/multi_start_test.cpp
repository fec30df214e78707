#include "optimize/design/search/multi_start.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>

#include "optimize/design/design_optimiser.hpp"
#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

TEST_CASE("Starts fill the space evenly, and the seed decides where", "[optimize][design][starts]") {
  const Eigen::VectorXd first = Eigen::VectorXd::Constant(3, 0.5);
  const auto starts = space_filling_starts(first, 65, 1), again = space_filling_starts(first, 65, 1), other = space_filling_starts(first, 65, 2);
  REQUIRE(starts.size() == 65);
  CHECK(starts.front() == first);
  for (std::size_t i = 1; i < starts.size(); ++i) {
    CHECK(starts[i] == again[i]);
    CHECK(starts[i] != other[i]);
    CHECK(starts[i].minCoeff() >= 0.0);
    CHECK(starts[i].maxCoeff() < 1.0);
  }
  // Discrepancy: of 64 points each half of each axis gets 32, but for those that a shift moves around its end.
  for (int k = 0; k < 3; ++k) {
    const auto below = std::count_if(starts.begin() + 1, starts.end(), [&](const Eigen::VectorXd& x) { return x[k] < 0.5; });
    CHECK(std::abs(static_cast<double>(below) - 32.0) <= 4.0);
  }
}

TEST_CASE("Several starts give the same bits on one thread and on two, and no worse a design than one", "[optimize][design][starts][determinism]") {
  DesignOptions options;
  options.starts = 3;
  options.solver.name = GENERATE("ipopt", "nlopt:slsqp");
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    DesignProblem problem(spur({10.0, -10.0}));
    return optimise_design(problem, options);
  };
  const DesignResult one = run(1), two = run(2);
  CHECK(one.after.objective == two.after.objective);
  CHECK(one.after.variables == two.after.variables);
  CHECK(one.optimality.residual == two.optimality.residual);
  REQUIRE(one.runs.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(one.runs[i].x == two.runs[i].x);
    CHECK(one.runs[i].evaluations == two.runs[i].evaluations);
  }
  DesignProblem problem(spur({10.0, -10.0}));
  CHECK(one.after.objective <= optimise_design(problem, SolverOptions{}).after.objective * (1.0 + 1e-12));  // round-off
  int found = 0;
  for (const LocalOptimum& optimum : one.optima) found += optimum.found_by;
  CHECK(found == 3);
  CHECK_FALSE(one.is_multimodal());  // mirrored scenes, crowning against misalignment: one optimum
}

TEST_CASE("A start that cannot be analysed is counted, and the others go on", "[optimize][design][starts]") {
  LocalRun failed, good, better;
  failed.status = SolverStatus::Failed;
  good.status = better.status = SolverStatus::Converged;
  good.objective = 2.0;
  better.objective = 1.0;
  good.constraint_violation = better.constraint_violation = 0.0;
  CHECK(best_run({failed, good, better}) == 2);
  CHECK(best_run({failed, failed}) == 0);
  const auto optima = distinct_optima({failed, good, better, good}, 1e-3);
  REQUIRE(optima.size() == 2);
  CHECK(optima[0].run == 2);
  CHECK(optima[0].found_by == 1);
  CHECK(optima[1].found_by == 2);
}

TEST_CASE("The budget of analyses is that of all starts together", "[optimize][design][starts]") {
  DesignProblem problem(helical());
  DesignOptions options;
  options.starts = 4;
  options.solver.max_evaluations = 12;
  const DesignResult result = optimise_design(problem, options);
  CHECK(result.evaluations <= 12);
  CHECK(result.after.objective <= result.before.objective);
}

TEST_CASE("In a list of objectives the later ones fall while the earlier ones stay within the tolerance", "[optimize][design][lexicographic]") {
  DesignTask task = helical({0.0, 12.0, -12.0});
  task.lexicographic_tolerance = 0.02;
  task.later_objectives = {{{term(Output::TePeakToPeak)}, Aggregate::Worst}};
  DesignProblem problem(task);
  const DesignResult result = optimise_design(problem, SolverOptions{});
  task.later_objectives.clear();
  DesignProblem first(task);
  const DesignResult alone = optimise_design(first, SolverOptions{});
  REQUIRE(result.stages.size() == 2);
  CHECK(result.stages[0].least == alone.after.objective);
  CHECK(result.after.objective <= result.stages[0].limit * (1.0 + DesignLog::tolerance));
  const Objective later{{term(Output::TePeakToPeak)}, Aggregate::Worst};
  CHECK(result.after.later_objectives.at(0) < first.value(later, alone.after.analysis));
  CHECK(result.stages[1].least == Approx(result.after.later_objectives.at(0)).epsilon(1e-12));  // round-off
}
