#include "optimize/design/search/optimality.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/design/design_optimiser.hpp"
#include "tests/common/random.hpp"
#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

TEST_CASE("Away from an optimum the first-order residual is the slope that is left", "[optimize][design][optimality]") {
  DesignTask task = spur({8.0});
  task.variables.erase(task.variables.begin());  // the slope alone
  DesignProblem problem(task);
  const Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 0.45);
  const Optimality here = first_order_optimality(problem, x);
  // Independent route: central difference of the objective, in units of the start's.
  constexpr double step = 1e-5;
  const auto value = [&](double at) { return problem.objective(problem.analyse(Eigen::VectorXd::Constant(1, at), false)); };
  const double slope = (value(0.45 + step) - value(0.45 - step)) / (2.0 * step) / value(0.5);
  // With the leading candidate alone the best lambda leaves (slope lambda, 1 - lambda) = slope / sqrt(1 + slope^2) in length; further
  // candidates can only lower it.
  CHECK(here.residual <= std::abs(slope) / std::sqrt(1.0 + slope * slope) * (1.0 + 1e-6));  // discretisation: the difference
  CHECK(here.residual > 0.05);
}

TEST_CASE("At a minimax optimum the multipliers of the scenes balance and sum to one", "[optimize][design][optimality]") {
  DesignProblem problem(spur({10.0, -10.0}));
  const DesignResult result = optimise_design(problem, SolverOptions{});
  REQUIRE(result.status == SolverStatus::Converged);
  CHECK(result.optimality.residual <= 1e-4);
  CHECK(result.optimality.complementarity <= 1e-4);
  double sum = 0.0, by_scene[2] = {0.0, 0.0};
  for (const ActiveBound& active : result.optimality.active) {
    if (active.variable >= 0 || active.row.kind != EpigraphRow::Kind::Floor || active.row.scene < 0) continue;
    sum += active.multiplier;
    by_scene[active.row.scene] += active.multiplier;
  }
  constexpr double tolerance = 1e-3;  // the optimiser's
  CHECK(sum == Approx(1.0).epsilon(tolerance));
  CHECK(std::min(by_scene[0], by_scene[1]) > 0.2);  // mirror images pull against each other
}

TEST_CASE("A bound that the balance does not need has no multiplier", "[optimize][design][optimality]") {
  const DesignTask task = spur({10.0, -10.0});
  DesignProblem free(task);
  const DesignResult optimum = optimise_design(free, SolverOptions{});
  constexpr double as_good_as_none = 1e-6;
  REQUIRE(optimum.optimality.residual <= as_good_as_none);
  // Bounds moved to where the optimum lies anyway.
  DesignTask bounded = task;
  Eigen::VectorXd x(static_cast<Eigen::Index>(task.variables.size()));
  for (std::size_t i = 0; i < task.variables.size(); ++i) {
    bounded.variables[i].upper = optimum.after.variables[i];
    x[static_cast<Eigen::Index>(i)] = 1.0;
  }
  DesignProblem problem(bounded);
  const Optimality found = first_order_optimality(problem, x);
  CHECK(found.residual <= as_good_as_none);
  for (const ActiveBound& active : found.active) CHECK(active.variable < 0);
}

TEST_CASE("Where the conditions hold no direction descends, and on kinks they hold by the gradients of both sides",
          "[optimize][design][optimality]") {
  int on_kinks = 0;
  for (const auto& [misalignments, positions] : {std::pair{std::vector{0.0, 10.0}, 8}, {{0.0}, 16}, {{0.0, -16.0, 16.0}, 12}}) {
    DesignTask task = helical(misalignments, positions);
    task.objective = {term(Output::TePeakToPeak)};
    task.effects = MeshEffects::all_but({"edge_contact"});  // a sharp edge at a line's end moves these optima off their kinks
    task.variables.back() = {"pinion.modification.parabolic_te", Member::Pinion, parameter_of("parabolic_te"), 0.0,
                             0.02 * units::arcsec / (units::deg * units::deg)};
    DesignProblem problem(task);
    SolverOptions options;
    options.name = "nlopt:slsqp";
    const DesignResult result = optimise_design(problem, options);
    CAPTURE(positions, result.message, result.optimality.residual, result.optimality.complementarity);
    REQUIRE(result.optimality.satisfied());
    on_kinks += std::ranges::any_of(result.optimality.active, [](const ActiveBound& bound) { return bound.is_kink; }) ? 1 : 0;
    // Independent route: the objective itself along random directions. A multiplier of the wrong sign would let it fall by a jump of
    // the gradient, some 0.1, times the step; what the conditions leave and the curvature of f_t allow 1e-3.
    const Eigen::VectorXd x = problem.scaled_design(result.after.variables);
    const auto value = [&](const Eigen::VectorXd& at) { return problem.objective(problem.analyse(at, false)) / result.before.objective; };
    const double least = value(x);
    tests::Random32 random(3);
    for (int k = 0; k < 50; ++k) {
      constexpr double step = 3e-3;
      const Eigen::VectorXd towards = random_design(static_cast<int>(x.size()), random) - x;
      CHECK(value(x + step * towards.normalized()) >= least - 1e-3 * step);
    }
  }
  CHECK(on_kinks >= 1);  // which of them is on one, the contact law decides
}

TEST_CASE("A limit has a multiplier at its optimum and none at a design that leaves it room", "[optimize][design][optimality]") {
  DesignTask task = helical();
  task.objective = {term(Output::PeakContactStress)};
  DesignProblem free(task);
  const DesignResult lowest = optimise_design(free, SolverOptions{});
  REQUIRE(lowest.optimality.satisfied());
  const Eigen::VectorXd x = free.scaled_design(lowest.after.variables);
  OutputConstraint bound{term(Output::TePeakToPeak)};
  const double reached = free.constraint_value(lowest.after.analysis, bound);
  const auto multiplier = [](const Optimality& optimality) {
    double sum = 0.0;
    for (const ActiveBound& active : optimality.active) {
      if (active.variable < 0 && active.row.kind == EpigraphRow::Kind::OutputBound) sum += active.multiplier;
    }
    return sum;
  };
  // Beside the optimum, where more of the gradient is left for the limit to make up for. The first-order conditions hold to 1e-4 with the limit or without it.
  int tried = 0;
  for (const double step : {0.0, 1e-6, -1e-6, 1e-5, -1e-5, 1e-4, -1e-4}) {
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const Eigen::VectorXd beside = (x + step * Eigen::VectorXd::Unit(x.size(), i)).cwiseMax(0.0).cwiseMin(1.0);
      if (!first_order_optimality(free, beside).satisfied()) continue;
      ++tried;
      for (const double room : {0.005, 0.01, 0.015}) {
        bound.maximum = reached * (1.0 + room);
        DesignTask bounded = task;
        bounded.constraints = {bound};
        DesignProblem problem(bounded);
        CAPTURE(step, i, room);
        CHECK(multiplier(first_order_optimality(problem, beside)) == 0.0);
      }
    }
  }
  CHECK(tried > 0);
  bound.maximum = 0.9 * reached;  // now it is in the way
  task.constraints = {bound};
  DesignProblem problem(task);
  const DesignResult bounded = optimise_design(problem, SolverOptions{});
  REQUIRE(bounded.optimality.satisfied());
  REQUIRE(bounded.after.objective > (1.0 + 1e-3) * lowest.after.objective);
  CHECK(multiplier(bounded.optimality) > 0.0);
}
