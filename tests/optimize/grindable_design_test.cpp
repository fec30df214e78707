#include "optimize/design/grinding/grindable_design.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/design/design_optimiser.hpp"
#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

/// Bent one way more than the other: some slope and some crowning are best.
DesignTask unevenly_bent(double more_um = 14.0) { return spur({more_um, -8.0}); }

/// The best of the task with one variable held in a part of its range, from searches of its own.
double best_with(const DesignTask& task, std::size_t i, double lower_um, double upper_um) {
  DesignTask held = task;
  held.grindable = {};
  held.variables[i].lower = lower_um * units::um;
  held.variables[i].upper = upper_um * units::um;
  DesignProblem problem(held);
  return optimise_design(problem, SolverOptions{}).after.objective;
}

/// The same with it at zero.
double best_without(const DesignTask& task, std::size_t i) {
  DesignTask held = task;
  held.grindable = {};
  set(held.modification.pinion, task.variables[i].parameter, 0.0);
  held.variables.erase(held.variables.begin() + static_cast<std::ptrdiff_t>(i));
  DesignProblem problem(held);
  return optimise_design(problem, SolverOptions{}).after.objective;
}

DesignResult solved(const DesignTask& task) {
  DesignProblem problem(task);
  return optimise_design(problem, SolverOptions{});
}

constexpr double of_two_searches = 1e-4;  // each ends where it gains less than 1e-5

}  // namespace

TEST_CASE("An amount below the smallest is left out or raised, whichever is better", "[optimize][design][grinding]") {
  // The slope takes out the mean of both, 3 or 1.5 um: 3.6 um is nearer to the one than 0 and farther from the other.
  const double more_um = GENERATE(14.0, 11.0), smallest_um = 3.6;
  DesignTask task = unevenly_bent(more_um);
  const DesignResult free = solved(task);
  const double slope_um = free.after.variables[1] / units::um;
  CAPTURE(free.after.variables[0] / units::um, slope_um);
  REQUIRE(std::abs(slope_um) > 1.0);
  CHECK_FALSE(free.exact.has_value());
  CHECK(free.choices.empty());
  task.grindable.smallest = smallest_um * units::um;
  const DesignResult found = solved(task);
  REQUIRE(found.choices.size() == 1);
  const GrindingChoice& choice = found.choices.front();
  REQUIRE(choice.amounts.size() == 1);
  CHECK_FALSE(choice.is_of_pair());
  CHECK(choice.amounts.front().parameter == parameter_of("lead_slope"));
  CHECK(choice.amounts.front().found == Approx(free.after.variables[1]).epsilon(1e-5));  // the same search once more
  REQUIRE(choice.tried.size() == 2);
  CHECK(choice.tried[0].held == HeldAmount::AtZero);
  CHECK(choice.tried[0].value == 0.0);
  // Independent routes: each alternative searched by itself.
  const bool is_positive = slope_um > 0.0;
  const double raised = is_positive ? best_with(task, 1, smallest_um, 20.0) : best_with(task, 1, -20.0, -smallest_um);
  const double without = best_without(task, 1);
  CHECK(choice.tried[0].objective == Approx(without).epsilon(of_two_searches));
  CHECK(choice.tried[1].objective == Approx(raised).epsilon(of_two_searches));
  CHECK(choice.tried[1].held == (is_positive ? HeldAmount::AtLeast : HeldAmount::AtMost));
  CHECK(choice.taken == (raised < without ? 1U : 0U));
  CHECK(choice.taken == (more_um == 14.0 ? 1U : 0U));
  CHECK(found.after.objective == Approx(std::min(raised, without)).epsilon(of_two_searches));
  for (const double value : found.after.variables) CHECK((value == 0.0 || std::abs(value) >= task.grindable.smallest * (1.0 - 1e-12)));  // round-off
  REQUIRE(found.exact.has_value());
  CHECK(found.exact->objective == Approx(free.after.objective).epsilon(1e-12));  // the search knows nothing of it
  CHECK(found.rounding_loss() > 0.0);
}

TEST_CASE("A smallest amount that every amount reaches changes nothing", "[optimize][design][grinding]") {
  DesignTask task = unevenly_bent();
  const DesignResult free = solved(task);
  task.grindable.smallest = 0.5 * std::abs(free.after.variables[1]);
  const DesignResult found = solved(task);
  CHECK(found.choices.empty());
  CHECK_FALSE(found.exact.has_value());
  CHECK(found.after.variables == free.after.variables);
  CHECK(found.evaluations == free.evaluations);
}

TEST_CASE("Rounding to steps keeps what was left out and what was raised", "[optimize][design][grinding][rounding]") {
  DesignTask task = unevenly_bent();
  for (DesignVariable& v : task.variables) v.step = 2.0 * units::um;
  const double slope_um = solved(unevenly_bent()).after.variables[1] / units::um;
  task.grindable.smallest = (std::abs(slope_um) + 1.5) * units::um;
  const DesignResult found = solved(task);
  REQUIRE(!found.choices.empty());  // the smallest amount on the steps may be more than other amounts, too
  for (const double value : found.after.variables) {
    const double steps = value / (2.0 * units::um);
    CHECK(std::abs(steps - std::round(steps)) < 1e-9);                                    // round-off
    CHECK((value == 0.0 || std::abs(value) >= task.grindable.smallest * (1.0 - 1e-12)));  // round-off
  }
}

TEST_CASE("Where the steps have nothing between the smallest amount and a limit, the amount is left out", "[optimize][design][grinding][rounding]") {
  DesignTask task = unevenly_bent();
  for (DesignVariable& v : task.variables) v.step = 2.0 * units::um;
  ModificationConstraint limit{"limit", {{Member::Pinion, parameter_of("lead_crowning"), 1.0}}};
  limit.maximum = task.grindable.smallest = 5.0 * units::um;
  task.modification_constraints = {limit};
  const DesignResult found = solved(task);
  CHECK(found.after.variables[0] == 0.0);
  CHECK(found.after.modification_values[0] <= limit.maximum);
}

TEST_CASE("What is tied to a variable must be ground as well", "[optimize][design][grinding]") {
  DesignTask task = unevenly_bent();
  LinkingConstraint half{{"wheel.modification.lead_slope", Member::Wheel, parameter_of("lead_slope"), -10 * units::um, 10 * units::um}, 1, 0.5};
  task.links.push_back(half);
  const double slope = solved(task).after.variables[1];
  task.grindable.smallest = 0.75 * std::abs(slope);  // the variable reaches it, its half does not
  const DesignResult found = solved(task);
  REQUIRE(found.choices.size() == 1);
  const double on_pinion = std::abs(found.after.variables[1]), on_wheel = std::abs(found.after.linked[0]);
  CHECK((on_pinion == 0.0 || on_wheel >= task.grindable.smallest * (1.0 - 1e-12)));  // round-off
}

TEST_CASE("Of two modifications that are not ground together the better one stays", "[optimize][design][grinding]") {
  DesignTask task = unevenly_bent();
  task.grindable.not_together = {{Member::Pinion, parameter_of("lead_slope"), parameter_of("lead_crowning")}};
  const DesignResult found = solved(task);
  REQUIRE(found.choices.size() == 1);
  const GrindingChoice& choice = found.choices.front();
  REQUIRE(choice.is_of_pair());
  REQUIRE(choice.tried.size() == 2);
  const double without_slope = best_without(task, 1), without_crowning = best_without(task, 0);
  CHECK(choice.tried[0].objective == Approx(without_slope).epsilon(of_two_searches));
  CHECK(choice.tried[1].objective == Approx(without_crowning).epsilon(of_two_searches));
  CHECK(choice.taken == (without_crowning < without_slope ? 1U : 0U));
  CHECK(found.after.objective == Approx(std::min(without_slope, without_crowning)).epsilon(of_two_searches));
  CHECK((found.after.variables[0] == 0.0) != (found.after.variables[1] == 0.0));
}

TEST_CASE("Neither half of a profile crowning is ground beside what excludes the whole", "[optimize][design][grinding]") {
  DesignTask task = helical({6.0, -6.0});
  task.variables.erase(task.variables.begin(), task.variables.begin() + 3);
  task.variables.push_back({"pinion.modification.lead_crowning", Member::Pinion, parameter_of("lead_crowning"), 0.0, 0.04});
  task.variables.push_back({"pinion.modification.addendum_crowning", Member::Pinion, parameter_of("addendum_crowning"), 0.0, 0.03});
  task.variables.push_back({"pinion.modification.dedendum_crowning", Member::Pinion, parameter_of("dedendum_crowning"), 0.0, 0.03});
  task.grindable.not_together = {{Member::Pinion, parameter_of("profile_crowning"), parameter_of("lead_crowning")}};
  DesignProblem problem(task);
  const DesignToGrind design = design_to_grind(problem, Eigen::Vector3d(0.3, 0.2, 0.1), SolverOptions{});
  REQUIRE(design.choices.size() == 1);
  const PerGear<Modification> ground = problem.modification(design.x);
  const bool has_profile = ground.pinion.addendum_crowning != 0.0 || ground.pinion.dedendum_crowning != 0.0;
  CHECK(has_profile != (ground.pinion.lead_crowning != 0.0));
  CHECK(problem.lower() == Eigen::VectorXd::Zero(3));  // the box is as it was
  CHECK(problem.upper() == Eigen::VectorXd::Ones(3));
}

TEST_CASE("A range that leaves nothing to grind is refused", "[optimize][design][grinding][input]") {
  DesignTask task = unevenly_bent();
  task.variables[1].lower = 1.0 * units::um;
  task.variables[1].upper = 3.0 * units::um;
  task.grindable.smallest = 5.0 * units::um;
  DesignProblem problem(task);
  CHECK_THROWS_AS(design_to_grind(problem, Eigen::Vector2d(0.5, 0.5), SolverOptions{}), InvalidInput);
}
