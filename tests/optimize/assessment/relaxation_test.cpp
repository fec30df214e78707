#include "optimize/assessment/relaxation.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/design/design_optimiser.hpp"
#include "tests/optimize/design_tasks.hpp"
#include "tests/common/about.hpp"

namespace flankwright {
namespace {

using design_tasks::spur;
using design_tasks::term;

/// Too little crowning is allowed for a stress that no design of this task reaches.
DesignTask beyond_reach() {
  DesignTask task = spur({20.0, -20.0});
  task.variables[0].upper = 4.0 * units::um;
  task.objective = {term(Output::TePeakToPeak)};
  OutputConstraint bound{term(Output::PeakContactStress)};
  bound.maximum = 500.0;
  task.constraints = {bound};
  return task;
}

/// The least excess of a task [-].
double least_excess(const DesignTask& task) {
  DesignProblem problem(task);
  const DesignResult found = optimise_design(problem, SolverOptions{});
  REQUIRE(found.status == SolverStatus::Infeasible);
  return problem.violation(found.after.analysis);
}

/// The task after a fraction of a move was granted.
DesignTask granted(const DesignTask& task, const Relaxation::Move& move, double fraction) {
  DesignTask wider = task;
  const double amount = fraction * move.steps * move.parameter.inside;
  if (move.moves_bound()) {
    DesignVariable& v = wider.variables[static_cast<std::size_t>(move.parameter.variable)];
    (move.steps > 0.0 ? v.upper : v.lower) += amount;
    return wider;
  }
  const auto& of = std::get<GearParameter>(move.parameter.parameter);
  Modification& modification = wider.modification[of.member];
  set(modification, of.parameter, get(modification, of.parameter) + amount);
  if (!std::isnan(move.extent)) find_parameter(describe(of.parameter).extent)->set(modification, move.extent);
  return wider;
}

TEST_CASE("Where no design keeps the limits, what would help brings the gain that is said", "[optimize][assessment][relaxation]") {
  const DesignTask task = beyond_reach();
  DesignProblem problem(task);
  const DesignResult found = optimise_design(problem, SolverOptions{});
  REQUIRE(found.status == SolverStatus::Infeasible);
  const Relaxation relaxation = find_relaxation(problem, found.after.analysis.modification, found.after.variables);
  CHECK(relaxation.excess == Approx(problem.violation(found.after.analysis)).epsilon(1e-5));  // two analyses of one design

  // Both scenes are alike but for the side of the misalignment.
  REQUIRE(relaxation.limits.size() == 2);
  for (const Relaxation::Limit& limit : relaxation.limits) {
    CHECK(limit.constraint == 0);
    CHECK(limit.weight == tests::about(0.5, 0.01));  // the optimality of the design, 1e-4, over the slopes that balance
  }

  REQUIRE_FALSE(relaxation.moves.empty());
  CHECK(std::ranges::is_sorted(relaxation.moves, std::less(), &Relaxation::Move::gain));
  CHECK(std::ranges::any_of(relaxation.moves, [](const Relaxation::Move& m) { return m.parameter.variable == 0 && m.steps > 0.0; }));
  CHECK(std::ranges::any_of(relaxation.moves, [](const Relaxation::Move& m) { return m.parameter.name == "wheel.modification.lead_crowning"; }));
  // A slope helps one scene and harms the other.
  CHECK(std::ranges::none_of(relaxation.moves, [](const Relaxation::Move& m) { return m.parameter.name == "wheel.modification.lead_slope"; }));
  for (std::size_t i = 0; i < std::min<std::size_t>(4, relaxation.moves.size()); ++i) {
    const Relaxation::Move& move = relaxation.moves[i];
    constexpr double fraction = 0.05;
    const double gain = (least_excess(granted(task, move, fraction)) - relaxation.excess) / fraction;
    CAPTURE(move.parameter.name, move.steps, move.gain, gain);
    CHECK(gain < 0.0);
    CHECK(gain == Approx(move.gain).epsilon(0.1));  // second order of a twentieth of a step, and the optimiser's tolerance over it
  }
}

TEST_CASE("Amounts that the design gives no extent are spread by the rules of thumb", "[optimize][assessment][relaxation]") {
  const DesignTask task = beyond_reach();
  DesignProblem problem(task);
  const DesignResult found = optimise_design(problem, SolverOptions{});
  const Relaxation relaxation = find_relaxation(problem, found.after.analysis.modification, found.after.variables);
  const auto end_relief =
      std::ranges::find(relaxation.moves, "pinion.modification.end_relief.amount", [](const Relaxation::Move& m) { return m.parameter.name; });
  REQUIRE(end_relief != relaxation.moves.end());
  CHECK(end_relief->extent == Approx(4.0).epsilon(1e-14));  // the smaller of 0.1 b and m_n; round-off
  CHECK_FALSE(end_relief->moves_bound());
}

}  // namespace
}  // namespace flankwright
