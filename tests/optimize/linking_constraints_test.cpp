#include <catch2/catch.hpp>

#include "optimize/design/design_optimiser.hpp"
#include "tests/common/random.hpp"
#include "tests/optimize/design_tasks.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

LinkingConstraint link(std::size_t as, Member member, ModificationParameter parameter, double factor, double offset) {
  LinkingConstraint result;
  result.linked.path = "tied";
  result.linked.member = member;
  result.linked.parameter = parameter;
  result.as = as;
  result.factor = factor;
  result.offset = offset;
  return result;
}

/// Lead crowning of the pinion, and of the wheel tied to it.
DesignTask shared_crowning(double factor, double offset) {
  DesignTask task = spur({10.0, -10.0});
  task.variables.pop_back();
  task.links = {link(0, Member::Wheel, parameter_of("lead_crowning"), factor, offset)};
  return task;
}

}  // namespace

TEST_CASE("A tied modification follows its variable, and gradients go through it", "[optimize][design][ties][gradient]") {
  DesignTask task = helical();
  task.links = {link(0, Member::Wheel, parameter_of("lead_crowning"), 0.5, 0.002),
                link(2, Member::Wheel, parameter_of("profile_crowning"), -1.0, 0.030)};
  DesignProblem problem(task);
  tests::Random32 random(21);
  const Eigen::VectorXd x = random_design(problem.variables(), random);
  const DesignAnalysis at = problem.analyse(x, true);
  constexpr double round_off = 1e-15;
  CHECK(at.modification.wheel.lead_crowning == Approx(0.5 * problem.unscaled(x, 0) + 0.002).epsilon(round_off));
  CHECK(at.modification.wheel.addendum_crowning == Approx(0.030 - problem.unscaled(x, 2)).epsilon(round_off));

  const ObjectiveTerm stress = term(Output::PeakContactStress);
  const auto leader = leading_candidates(stress, {problem.model(1), at.cycles[1]}, 0.0, 1).front();
  const Eigen::VectorXd exact = problem.scaled(candidate_value(stress, leader, {problem.model(1), at.cycles[1]}).gradient);
  REQUIRE(exact.size() == 3);
  constexpr double step = 2e-5, discretisation = 1e-6;
  for (int i = 0; i < 3; ++i) {
    const auto value = [&](double by) {
      const DesignAnalysis moved = problem.analyse(x + by * Eigen::VectorXd::Unit(3, i), false);
      return candidate_value(stress, leader, {problem.model(1), moved.cycles[1]}).value;
    };
    CHECK(exact[i] == tests::about((value(step) - value(-step)) / (2.0 * step), discretisation * exact.cwiseAbs().maxCoeff()));
  }
}

TEST_CASE("The same crowning on both gears is half of it on each", "[optimize][design][ties][physics]") {
  DesignTask alone = spur({10.0, -10.0});
  alone.variables.pop_back();
  DesignProblem on_pinion(alone), on_both(shared_crowning(1.0, 0.0));
  const DesignResult one = optimise_design(on_pinion, SolverOptions{}), both = optimise_design(on_both, SolverOptions{});
  // The gap knows the sum only (plane of action). Discretisation: the optimiser's tolerance.
  CHECK(both.after.objective == Approx(one.after.objective).epsilon(1e-5));
  CHECK(2.0 * both.after.variables[0] == Approx(one.after.variables[0]).epsilon(1e-2));
  CHECK(both.after.linked == both.after.variables);
}

TEST_CASE("A total that two gears share makes no difference to the gap", "[optimize][design][ties][physics]") {
  DesignProblem problem(shared_crowning(-1.0, 0.040));
  const auto stress = [&](double x) { return problem.objective(problem.analyse(Eigen::VectorXd::Constant(1, x), false)); };
  CHECK(stress(0.2) == Approx(stress(0.9)).epsilon(1e-12));  // round-off
}

TEST_CASE("A bound on a sum of modifications holds, whichever solver, and is felt", "[optimize][design][ties]") {
  DesignTask task = spur({10.0, -10.0});
  task.variables[1] = {"wheel.modification.lead_crowning", Member::Wheel, parameter_of("lead_crowning"), 0.0, 0.040};
  DesignProblem free(task);
  const DesignResult unbounded = optimise_design(free, SolverOptions{});
  const double total = unbounded.after.variables[0] + unbounded.after.variables[1];
  ModificationConstraint sum{"sum", {{Member::Pinion, parameter_of("lead_crowning"), 1.0}, {Member::Wheel, parameter_of("lead_crowning"), 1.0}}};
  sum.maximum = 0.5 * total;
  task.modification_constraints = {sum};
  DesignProblem problem(task);
  for (const char* solver : {"ipopt", "nlopt:slsqp", "nlopt:cobyla"}) {
    CAPTURE(solver);
    SolverOptions options;
    options.name = solver;
    options.max_evaluations = 300;
    options.tolerance = 1e-6;
    const DesignResult bounded = optimise_design(problem, options);
    REQUIRE(bounded.after.modification_values.size() == 1);
    // Crowning is short: all of it is used. Discretisation: the optimiser's tolerance.
    CHECK(bounded.after.modification_values[0] == Approx(sum.maximum).epsilon(1e-3));
    CHECK(bounded.after.modification_values[0] <= sum.maximum + DesignLog::tolerance * problem.modification_scale(sum));
    CHECK(bounded.after.objective > unbounded.after.objective);
  }
}
