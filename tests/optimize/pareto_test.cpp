#include "optimize/design/pareto.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/common/random.hpp"
#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

/// Transmission error alone has more than one optimum here.
DesignTask trading_task() {
  DesignTask task = spur({10.0, -10.0});
  task.variables.push_back({"pinion.modification.profile_crowning", Member::Pinion, parameter_of("profile_crowning"), 0.0, 0.040});
  return task;
}

const Objective stress{{term(Output::PeakContactStress)}, Aggregate::Worst};
const Objective error{{term(Output::TePeakToPeak)}, Aggregate::Worst};

}  // namespace

TEST_CASE("A front of two objectives runs from the best of one to the best of the other without domination", "[optimize][design][pareto][slow]") {
  const DesignProblem problem(trading_task());
  SolverOptions options;
  options.name = GENERATE("ipopt", "nlopt:slsqp");  // from the start alone they may end in different optima
  const ParetoFront front = trace_front(problem, {stress, error}, 5, options);
  CAPTURE(options.name, front.message, front.evaluations);
  REQUIRE(front.points.size() == 5);
  for (std::size_t i = 0; i < front.points.size(); ++i) {
    CAPTURE(i, front.points[i].values);
    CHECK_FALSE(front.points[i].dominated);
    if (i == 0) continue;
    CHECK(front.points[i].values[0] >= front.points[i - 1].values[0]);
    CHECK(front.points[i].values[1] <= front.points[i - 1].values[1]);
  }
  // Discretisation: equal steps along the broken line of the first pass, of which the arc is up to a quarter longer.
  CHECK(front.unevenness() < 1.5);

  // Independent route: derivative-free CRS2 over the whole box; model: an anchor's slack of 1e-3.
  static const double best_error = [] {
    DesignTask task = trading_task();
    task.objective = error.terms;
    SolverOptions global;
    global.name = "nlopt:crs2_lm";
    global.max_evaluations = 8000;
    DesignProblem whole(task);
    return optimise_design(whole, global).after.objective;
  }();
  CHECK(front.ideal[1] == Approx(best_error).epsilon(2e-3));

  // Independent route: no design on a grid lies more than a little below the front's broken line.
  DesignProblem grid(trading_task());
  for (double a : {0.1, 0.3, 0.5}) {
    for (double b : {0.45, 0.5, 0.55}) {
      for (double c : {0.0, 0.2, 0.5}) {
        const DesignAnalysis& analysis = grid.analyse(Eigen::Vector3d(a, b, c), false);
        const double s = grid.value(stress, analysis), e = grid.value(error, analysis);
        for (const ParetoPoint& point : front.points) {
          // Model: the first objective of an anchor may rise by its slack of 1e-3.
          CHECK_FALSE((s < point.values[0] * (1.0 - 2e-3) && e < point.values[1] * (1.0 - 2e-3)));
        }
      }
    }
  }
}

TEST_CASE("A front of three objectives has the best of each among its corners and compromises between them", "[optimize][design][pareto][slow]") {
  const DesignProblem problem(trading_task());
  const Objective edge{{term(Output::EdgeLoad)}, Aggregate::Worst};
  const ParetoFront front = trace_front(problem, {stress, error, edge}, 6, SolverOptions{});
  CAPTURE(front.message, front.evaluations);
  REQUIRE(front.points.size() == 6);  // two steps a side
  constexpr double slack = 2e-3;      // of each objective: slack of an anchor for the others, and tolerance of the solver
  for (std::size_t k = 0; k < 3; ++k) {
    CAPTURE(k);
    for (const ParetoPoint& point : front.points) CHECK(point.values[k] >= front.points[k].values[k] * (1.0 - slack));
    CHECK(front.ideal[k] == front.points[k].values[k]);
  }
  // A compromise seen from the middle of two corners is better than each of them in what the other is best in.
  for (std::size_t p = 3; p < 6; ++p) {
    CAPTURE(p, front.points[p].values);
    int strictly_between = 0;
    for (std::size_t k = 0; k < 3; ++k) strictly_between += front.points[p].values[k] < front.worst[k] * (1.0 - 1e-6);
    CHECK(strictly_between >= 2);
    CHECK_FALSE(front.points[p].dominated);
  }
  CHECK(std::isnan(front.unevenness()));
}

TEST_CASE("An objective that can vanish stays near zero at its best point, and the other objective is minimised there",
          "[optimize][design][pareto]") {
  DesignProblem problem(trading_task());
  tests::Random32 random(2);
  problem.set_start(random_design(3, random));
  const Objective edge{{term(Output::EdgeLoad)}, Aggregate::Worst};
  SolverOptions options;
  options.name = "nlopt:slsqp";
  const ParetoFront front = trace_front(problem, {edge, error}, 5, options);
  CAPTURE(front.message, front.evaluations);
  REQUIRE(front.points.size() == 5);
  for (const ParetoPoint& point : front.points) CHECK_FALSE(point.dominated);
  CHECK(front.ideal[0] <= 1.01e-3 * front.worst[0]);  // slack of an anchor, relative to the objective at the best of the other
  // Independent route: no edge load is left to most of a grid of designs, and none of them has less error.
  DesignProblem grid(trading_task());
  int without = 0;
  for (double a : {0.5, 0.6, 0.7, 0.8, 1.0}) {
    for (double c : {0.3, 0.4, 0.5, 0.6, 1.0}) {
      const DesignAnalysis& analysis = grid.analyse(Eigen::Vector3d(a, 0.5, c), false);
      if (grid.value(edge, analysis) > 0.0) continue;
      ++without;
      CHECK(grid.value(error, analysis) >= front.worst[1]);
    }
  }
  CHECK(without > 0);
}

TEST_CASE("A front has the same bits on one thread and on two", "[optimize][design][pareto][determinism][slow]") {
  DesignOptions options;
  options.starts = 2;
  options.solver.name = GENERATE("ipopt", "nlopt:slsqp");
  const auto trace = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const DesignProblem problem(trading_task());
    return trace_front(problem, {stress, error}, 4, options);
  };
  const ParetoFront one = trace(1), two = trace(2);
  CHECK(one.evaluations == two.evaluations);
  REQUIRE(one.points.size() == two.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    CHECK(one.points[i].x == two.points[i].x);
    CHECK(one.points[i].values == two.points[i].values);
  }
}

TEST_CASE("Objectives with one common optimum have a front of one design", "[optimize][design][pareto]") {
  const DesignProblem problem(spur({10.0, -10.0}));
  const Objective load{{term(Output::PeakLineLoad)}, Aggregate::Worst};  // stress is a function of load and radius
  SolverOptions options;
  options.max_evaluations = 150;
  const ParetoFront front = trace_front(problem, {stress, load}, 3, options);
  REQUIRE(front.worst.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) CHECK(front.worst[k] == Approx(front.ideal[k]).epsilon(0.01));
}

TEST_CASE("A front keeps its budget and reports it", "[optimize][design][pareto]") {
  const DesignProblem problem(trading_task());
  SolverOptions options;
  options.max_evaluations = 10;
  const ParetoFront front = trace_front(problem, {stress, error}, 9, options);
  CHECK(front.evaluations <= 10);
  CHECK(front.points.size() < 9);
  CHECK_FALSE(front.message.empty());
  CHECK(front.ended_early);
  CHECK_THROWS_AS(trace_front(problem, {stress}, 5, options), InvalidInput);
  options.name = "nlopt:crs2_lm";
  CHECK_THROWS_AS(trace_front(problem, {stress, error}, 5, options), InvalidInput);
}

TEST_CASE("A front is judged by the limits asked for, not by the tighter ones of its search", "[optimize][design][pareto]") {
  DesignTask task = trading_task();
  DesignProblem open(task);
  const Eigen::Vector3d x(0.3, 0.5, 0.2);
  const double value = open.value(error, open.analyse(x, false)) * units::um;  // inside
  const auto limited = [&](double maximum) { return OutputConstraint{.output = term(Output::TePeakToPeak), .maximum = maximum}; };
  task.constraints = {limited(0.9 * value)};
  const DesignProblem problem(task);
  const DesignResolver at_positions = [&](const DesignAnalysis& analysis) {
    std::vector<ResolvedCycle> cycles;
    for (int s = 0; s < problem.scenes(); ++s) {
      ResolvedCycle& resolved = cycles.emplace_back();
      resolved.summary = summarise(problem.model(s), analysis.cycles[static_cast<std::size_t>(s)]);
    }
    return cycles;
  };
  const auto violation_under = [&](double maximum) {
    ParetoFront front;
    front.objectives = {stress, error};
    front.points = {{.x = x, .values = {1.0, 1.0}, .status = SolverStatus::Converged, .constraint_violation = 0.2}};
    resolve_front(problem, {limited(maximum)}, at_positions, {}, front);
    return front.points.front().constraint_violation;
  };
  constexpr double round_off = 1e-12;
  CHECK(violation_under(1.1 * value) == 0.0);
  CHECK(violation_under(value / 1.1) == Approx(0.1).margin(round_off));
}
