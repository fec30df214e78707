#include "optimize/design/search/least_excess.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "optimize/design/design_optimiser.hpp"
#include "optimize/design/search/multi_start.hpp"
#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

/// A spur pair in oil, at two misalignments. What is minimised is the transmission error.
DesignTask oiled_spur() {
  DesignTask task = spur({20.0, -10.0});
  for (DesignScene& scene : task.scenes) scene.operation.speed = 150.0;
  LifeModel life;
  life.lubricant = Lubricant{.viscosity_40 = 220.0, .viscosity_100 = 19.0, .temperature = 80.0};
  life.roughness = 0.5;
  life.permissible_film = 0.3;
  task.life = std::make_shared<const LifeModel>(life);
  task.objective = {term(Output::TePeakToPeak)};
  return task;
}

SolverOptions slsqp() {
  SolverOptions options;
  options.name = "nlopt:slsqp";
  return options;
}

}  // namespace

TEST_CASE("Where no design keeps a lower bound on the film, the nearest one has the thickest film there is", "[optimize][design][excess]") {
  DesignTask task = oiled_spur();
  OutputConstraint bound{.output = term(Output::SpecificFilmThickness), .minimum = 1.0};
  // Independent route: the film by itself over a grid of all designs.
  DesignProblem free(task);
  double thickest = 0.0;
  constexpr int steps = 40;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const Eigen::Vector2d x(static_cast<double>(i) / steps, static_cast<double>(j) / steps);
      thickest = std::max(thickest, free.constraint_value(free.analyse(x, false), bound));
    }
  }
  const double limit_over_thickest = GENERATE(1.02, 1.2);
  bound.minimum = limit_over_thickest * thickest;
  task.constraints = {bound};
  DesignProblem problem(task);
  const DesignResult found = optimise_design(problem, slsqp());
  CAPTURE(found.message, thickest, found.after.constraint_values[0]);
  CHECK(found.status == SolverStatus::Infeasible);
  CHECK_THAT(found.message, Catch::Contains("the nearest found exceeds them by"));
  CHECK(found.after.constraint_values[0] >= (1.0 - 2.0 * same_excess) * thickest);
  constexpr double between_grid_points = 0.01;  // discretisation
  CHECK(found.after.constraint_values[0] <= (1.0 + between_grid_points) * thickest);
}

TEST_CASE("The excess of a design is the same as a constraint, as what is minimised and by hand", "[optimize][design][excess]") {
  DesignTask task = oiled_spur();
  const DesignProblem free(task);
  const DesignAnalysis given = free.analyse_given();
  OutputConstraint film{.output = term(Output::SpecificFilmThickness), .minimum = 1.0}, stress{term(Output::PeakContactStress)};
  const double of_film = free.constraint_value(given, film), of_stress = free.constraint_value(given, stress);
  for (const auto& [film_excess, stress_excess] : {std::pair{0.1, 0.05}, {0.02, 0.3}, {-0.1, -0.2}, {-0.3, 0.1}}) {
    film.minimum = of_film / (1.0 - film_excess);
    stress.maximum = of_stress / (1.0 + stress_excess);
    task.constraints = {film, stress};
    const DesignProblem problem(task), by_excess = problem.judged_by_excess();
    const double largest = std::max(film_excess, stress_excess);
    constexpr double round_off = 1e-12;
    CHECK(by_excess.objective(given) == Approx(largest).epsilon(round_off));
    CHECK(problem.violation(given) == Approx(std::max(0.0, largest)).epsilon(round_off));
    CHECK(by_excess.task().constraints.empty());
    // Bounds that are moved out by more than the excess are kept.
    CHECK(problem.with_wider_bounds(std::max(0.0, largest) + 1e-9).violation(given) == 0.0);
    if (largest > 0.0) CHECK(problem.with_wider_bounds(largest - 1e-3).violation(given) > 0.0);
  }
}

TEST_CASE("More starts never end with a larger excess, and the same ones with the same bits", "[optimize][design][excess][determinism]") {
  DesignTask task = helical({0.0, 16.0, -16.0});
  OutputConstraint bound{term(Output::TePeakToPeak)};  // has several optima
  bound.maximum = 1e-5;
  task.constraints = {bound};
  DesignProblem problem(task);
  const Eigen::VectorXd start = problem.start();
  const std::vector<Eigen::VectorXd> starts = space_filling_starts(start, 4, 1);
  const auto sought = [&](const Eigen::VectorXd& nearest, std::vector<Eigen::VectorXd> others) {
    DesignProblem copy = problem;
    return seek_least_excess(copy, nearest, {slsqp(), std::move(others), false});
  };
  const LeastExcess of_all = sought(start, {starts.begin() + 1, starts.end()});
  REQUIRE(of_all.excess > 0.0);
  for (const Eigen::VectorXd& x : starts) CHECK(of_all.excess <= sought(x, {}).excess + same_excess * (1.0 + of_all.excess));
  CHECK(of_all.evaluations > sought(start, {}).evaluations);
  const LeastExcess again = sought(start, {starts.begin() + 1, starts.end()});
  CHECK(again.x == of_all.x);
  CHECK(again.excess == of_all.excess);
  CHECK(again.evaluations == of_all.evaluations);
}

TEST_CASE("Among designs of the same excess the one with the better objective is shown", "[optimize][design][excess]") {
  // Once the tip edges are relieved, the peak of the contact stress lies where one pair of teeth carries. More relief is felt by the transmission error alone.
  DesignTask task = relieved_spur();
  task.objective = {term(Output::PeakContactStress)};
  DesignProblem stress_alone(task);
  const double lowest = optimise_design(stress_alone, slsqp()).after.objective;
  OutputConstraint bound{term(Output::PeakContactStress)};
  bound.maximum = 0.9 * lowest;
  task.constraints = {bound};
  task.objective = {term(Output::TePeakToPeak)};
  DesignProblem problem(task);
  const auto shown = [&](bool with_objective) {
    DesignProblem copy = problem;
    const LeastExcess found = seek_least_excess(copy, copy.start(), {slsqp(), {}, with_objective});
    return std::pair{found.excess, copy.objective(copy.analyse(found.x, false))};
  };
  const auto [least, objective_of_least] = shown(false);
  const auto [excess, objective] = shown(true);
  CAPTURE(least, excess, objective_of_least, objective);
  CHECK(least > 0.1);
  CHECK(excess <= least + same_excess * (1.0 + least));
  CHECK(objective < 0.95 * objective_of_least);
}
