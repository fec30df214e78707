#include "optimize/assessment/usual_signs.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/design/design_optimiser.hpp"
#include "tests/optimize/design_tasks.hpp"

namespace flankwright {
namespace {

using design_tasks::spur;

DesignVariable gear_variable(const char* name, ModificationParameter parameter, double lower_um, double upper_um, Member member = Member::Pinion) {
  return {std::string(name_of(member)) + ".modification." + name, member, parameter, lower_um * units::um, upper_um * units::um};
}

/// Misaligned one way only: a slope compensates it, and crowning is of no use.
DesignTask one_sided() {
  DesignTask task = spur({30.0});
  task.variables = {gear_variable("lead_crowning", parameter_of("lead_crowning"), -20.0, 40.0),
                    gear_variable("lead_slope", parameter_of("lead_slope"), -60.0, 60.0)};
  return task;
}

TEST_CASE("An optimum with slope and no crowning is named, and the best design behind its borders costs something", "[optimize][assessment][signs]") {
  DesignProblem problem(one_sided());
  const DesignResult result = optimise_design(problem, SolverOptions{});
  const auto usual = find_usual_signs(problem, result.after);
  REQUIRE(usual);
  CHECK_FALSE(usual->unusual.empty());
  REQUIRE(usual->design);
  const double crowning = usual->design->variables[0], slope = usual->design->variables[1];
  constexpr double solver_tolerance = 1e-4 * 0.06;  // of the range [mm]
  CHECK(crowning >= -solver_tolerance);
  CHECK(std::abs(slope) <= 2.0 * crowning + solver_tolerance);
  // Fewer designs to choose from: no better than the optimum.
  CHECK(usual->price >= -1e-6);
  CHECK(usual->design->objective == Approx((1.0 + usual->price) * result.after.objective).epsilon(1e-12));  // round-off
  // Independent route: no design of a grid within the limits is better.
  for (double c = 0.0; c <= 40.0; c += 8.0) {
    for (double s = -2.0 * c; s <= 2.0 * c && std::abs(s) <= 60.0; s += 8.0) {
      PerGear<Modification> modification;
      modification.pinion.lead_crowning = c * units::um;
      modification.pinion.lead_slope = s * units::um;
      CHECK(problem.objective(problem.analyse_design(modification)) >= usual->design->objective * (1.0 - 1e-4));
    }
  }
}

TEST_CASE("An optimum that crowns a pair misaligned either way is usual", "[optimize][assessment][signs]") {
  DesignProblem problem(spur({10.0, -10.0}));
  CHECK_FALSE(find_usual_signs(problem, optimise_design(problem, SolverOptions{}).after));
}

TEST_CASE("A slope alone is a correction of the helix and has no limits, each gear and direction its own", "[optimize][assessment][signs]") {
  DesignTask task = one_sided();
  task.variables = {gear_variable("lead_slope", parameter_of("lead_slope"), -60.0, 60.0),
                    gear_variable("lead_crowning", parameter_of("lead_crowning"), 0.0, 40.0, Member::Wheel),
                    gear_variable("profile_crowning", parameter_of("profile_crowning"), -20.0, 40.0)};
  const auto limits = usual_sign_limits(task);
  REQUIRE(limits.size() == 2);
  CHECK(limits[0].name == "a negative pinion profile crowning");
  CHECK(limits[1].name == "a negative wheel lead crowning");
}

TEST_CASE("A border that both slope and crowning reach is limited by what remains of it", "[optimize][assessment][signs]") {
  DesignTask task = one_sided();
  task.variables.push_back(gear_variable("profile_slope", parameter_of("profile_slope"), -20.0, 20.0));
  task.variables.push_back(gear_variable("tip_relief.amount", parameter_of("tip_relief.amount"), 0.0, 60.0));
  PerGear<Modification> modification;
  const auto exceeded = [&] {
    int count = 0;
    for (const ModificationConstraint& limit : usual_sign_limits(task)) {
      const double value = limit.value(modification);
      count += value > limit.maximum + 1e-12 || value < limit.minimum - 1e-12;  // round-off of amounts of micrometres
    }
    return count;
  };
  modification.pinion.profile_slope = -8.0 * units::um;  // raises the tip by 4 um
  CHECK(exceeded() == 1);
  modification.pinion.tip_relief.amount = 4.0 * units::um;
  CHECK(exceeded() == 0);
  modification.pinion.profile_slope = 8.0 * units::um;  // raises the root, where nothing is varied that could lower it
  CHECK(exceeded() == 0);
}

}  // namespace
}  // namespace flankwright
