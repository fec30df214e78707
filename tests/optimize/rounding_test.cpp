#include "optimize/design/grinding/rounding.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/design/design_optimiser.hpp"
#include "tests/optimize/design_tasks.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

DesignTask in_steps(double step_um) {
  DesignTask task = spur({10.0, -10.0});
  for (DesignVariable& v : task.variables) v.step = step_um * units::um;
  return task;
}

bool is_multiple(double value, double step) { return std::abs(value / step - std::round(value / step)) < 1e-9; }

}  // namespace

TEST_CASE("An increase from nothing, or to many times as much, is no share of what it was", "[optimize][design]") {
  CHECK(relative_increase(4.0, 5.0) == 0.25);
  CHECK(relative_increase(4.0, 3.0) == -0.25);
  CHECK(relative_increase(-4.0, -3.0) == 0.25);
  CHECK(relative_increase(1.0, 1.0 + largest_increase) == largest_increase);
  CHECK(std::isnan(relative_increase(0.0, 0.0)));
  CHECK(std::isnan(relative_increase(0.0, 1.0)));
  CHECK(std::isnan(relative_increase(1e-10, 5e-4)));
}

TEST_CASE("The rounded design lies on the steps, loses little, and no neighbour is better", "[optimize][design][rounding]") {
  const double step_um = GENERATE(1.0, 3.0);
  CAPTURE(step_um);
  DesignTask task = in_steps(step_um);
  task.over = GENERATE(Aggregate::Worst, Aggregate::Mean);  // a worst case ends at the first scene too bad
  DesignProblem problem(task);
  const DesignResult result = optimise_design(problem, SolverOptions{});
  REQUIRE(result.exact.has_value());
  for (double value : result.after.variables) CHECK(is_multiple(value, step_um * units::um));
  CHECK(result.rounding_loss() >= -1e-6);  // the optimiser's tolerance
  CHECK(result.rounding_loss() < 0.05);
  // Independent route: every neighbour by one step, pairs as well.
  for (int a : {-1, 0, 1}) {
    for (int b : {-1, 0, 1}) {
      const std::vector<double> values{result.after.variables[0] + a * step_um * units::um, result.after.variables[1] + b * step_um * units::um};
      const Eigen::VectorXd x = problem.scaled_design(values);
      if (x.minCoeff() < 0.0 || x.maxCoeff() > 1.0) continue;
      CHECK(problem.objective(problem.analyse(x, false)) >= result.after.objective * (1.0 - 1e-12));  // round-off
    }
  }
}

TEST_CASE("Where rounding is dear no design within two steps of the rounded one is better", "[optimize][design][rounding]") {
  int dear = 0;
  for (const double step_um : {8.0, 9.0, 11.0, 13.0}) {
    CAPTURE(step_um);
    DesignTask task = in_steps(step_um);
    task.variables[1].lower = -40.0 * units::um;
    task.variables[1].upper = 40.0 * units::um;
    task.scenes[1].condition.misalignment.mesh_misalignment = 33.0 * units::um;
    DesignProblem problem(task);
    const DesignResult result = optimise_design(problem, SolverOptions{});
    if (result.rounding_loss() <= dear_rounding) continue;
    ++dear;
    const double step = step_um * units::um;
    for (int a = -2; a <= 2; ++a) {
      for (int b = -2; b <= 2; ++b) {
        const Eigen::VectorXd x = problem.scaled_design({result.after.variables[0] + a * step, result.after.variables[1] + b * step});
        if (x.minCoeff() < 0.0 || x.maxCoeff() > 1.0) continue;
        CHECK(problem.objective(problem.analyse(x, false)) >= result.after.objective * (1.0 - 1e-12));  // round-off
      }
    }
  }
  CHECK(dear > 0);
}

TEST_CASE("Rounding keeps the constraints where it can", "[optimize][design][rounding]") {
  DesignTask task = in_steps(2.0);
  DesignProblem free(task);
  const DesignResult unbounded = optimise_design(free, SolverOptions{});
  ModificationConstraint sum{"sum", {{Member::Pinion, parameter_of("lead_crowning"), 1.0}}};
  sum.maximum = unbounded.exact->variables[0] - 0.5 * units::um;
  task.modification_constraints = {sum};
  DesignProblem problem(task);
  const DesignResult result = optimise_design(problem, SolverOptions{});
  CHECK(is_multiple(result.after.variables[0], 2.0 * units::um));
  CHECK(result.after.variables[0] <= sum.maximum);
  CHECK(result.after.objective >= result.exact->objective * (1.0 - 1e-6));  // the optimiser's tolerance
}

TEST_CASE("Where no design keeps the limit of an output, rounding still keeps what the machine can grind", "[optimize][design][rounding]") {
  DesignTask task = in_steps(2.0);
  DesignProblem free(task);
  const double best = optimise_design(free, SolverOptions{}).exact->variables[0];
  ModificationConstraint sum{"sum", {{Member::Pinion, parameter_of("lead_crowning"), 1.0}}};
  sum.maximum = best - 0.5 * units::um;  // a step up would lower the stress
  task.modification_constraints = {sum};
  task.constraints = {{.output = *find_term("peak_contact_stress"), .maximum = 100.0}};
  DesignProblem problem(task);
  const DesignResult result = optimise_design(problem, SolverOptions{});
  CHECK(result.after.constraint_values[0] > 2.0 * task.constraints[0].maximum);
  CHECK(is_multiple(result.after.variables[0], 2.0 * units::um));
  CHECK(result.after.variables[0] <= sum.maximum);
}

TEST_CASE("Without steps nothing is rounded, and a budget of one analysis gives the nearest steps", "[optimize][design][rounding]") {
  DesignProblem smooth(spur({10.0}));
  SolverOptions options;
  options.max_evaluations = 3;
  CHECK_FALSE(optimise_design(smooth, options).exact.has_value());
  DesignProblem problem(in_steps(1.0));
  const RoundedDesign nearest = round_design(problem, Eigen::Vector2d(0.26, 0.51), 1);
  CHECK(nearest.analyses == 1);
  constexpr double round_off = 1e-12;
  CHECK(problem.unscaled(nearest.x, 0) == Approx(0.010).epsilon(round_off));  // 10.4 um
  CHECK(problem.unscaled(nearest.x, 1) == tests::about(0.0, round_off));      // 0.4 um
}

TEST_CASE("The least of a function on the steps is that of the whole grid", "[optimize][design][rounding]") {
  const DesignProblem problem(in_steps(3.0));
  // A narrow valley at 45 degrees, in which the least of the grid is not at the nearest steps; kept is only what lies on one side of a line.
  const auto figure = [&](const Eigen::VectorXd& x) {
    const double a = problem.unscaled(x, 0) / units::um, b = problem.unscaled(x, 1) / units::um;
    return StepFigure{0.0, std::max(0.0, 4.0 - a), 10.0 + std::pow(a + b - 7.7, 2) + 0.05 * std::pow(a - b - 6.2, 2)};
  };
  const Eigen::VectorXd found = least_on_steps(problem, problem.scaled_design({6.95 * units::um, 0.75 * units::um}), figure);
  const DesignVariable &first = problem.task().variables[0], &second = problem.task().variables[1];
  constexpr double step = 3.0 * units::um;
  StepFigure least{INFINITY, INFINITY, INFINITY};
  for (double a = std::ceil(first.lower / step) * step; a <= first.upper; a += step) {
    for (double b = std::ceil(second.lower / step) * step; b <= second.upper; b += step)
      least = std::min(least, figure(problem.scaled_design({a, b})));
  }
  for (int i = 0; i < 2; ++i) CHECK(is_multiple(problem.unscaled(found, i), step));
  constexpr double round_off = 1e-9;
  CHECK(figure(found).violation == tests::about(least.violation, round_off));
  CHECK(figure(found).objective == Approx(least.objective).epsilon(round_off));
}

TEST_CASE("An amount that the objective does not feel is not ground", "[optimize][design][rounding]") {
  // End relief over a hundredth of a millimetre lies beside all points of contact: whatever its amount, the stress is the same.
  DesignTask task = in_steps(1.0);
  set(task.modification.pinion, parameter_of("end_relief.length"), 0.01);
  task.variables.push_back(
      {"pinion.modification.end_relief.amount", Member::Pinion, parameter_of("end_relief.amount"), 0.0, 40 * units::um, units::um});
  DesignProblem problem(task);
  const RoundedDesign found = round_design(problem, problem.scaled_design({15 * units::um, 0.0, 7 * units::um}), 1000);
  CHECK(problem.unscaled(found.x, 2) == 0.0);
  CHECK(problem.unscaled(found.x, 0) > 0.0);  // crowning is felt
  // Nothing else is given up for it than the share that the objective may rise by.
  DesignProblem held(task);
  held.set_box(Eigen::Vector3d(0.0, 0.0, 7.0 / 40.0), Eigen::Vector3d(1.0, 1.0, 7.0 / 40.0));
  CHECK(found.objective <= (1.0 + idle_share) * round_design(held, held.scaled_design({15 * units::um, 0.0, 7 * units::um}), 1000).objective);
}
