#include "core/load/solve/load_solver.hpp"

#include <catch2/catch.hpp>

#include "tests/core/load/load_cases.hpp"

using namespace flankwright;
using load_cases::Random;

namespace {

/// Loaded in the middle, out of reach at the ends.
LoadProblem parabolic_problem(Eigen::Index n, double depth, Random& random) {
  LoadProblem problem;
  problem.weight = random.vector(n, 0.5, 1.5);
  problem.influence = load_cases::influence(load_cases::Structure::DecayingKernel, n, 3e-6, random);
  const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(n, -1.0, 1.0);
  problem.gap = depth * place.square();
  problem.laws = load_cases::random_laws(n, random);
  problem.force = 100.0 * problem.weight.sum();
  return problem;
}

}  // namespace

TEST_CASE("Points that the start leaves far from contact are loaded where they must be", "[core][load]") {
  constexpr double kRoundOff = 1e-10;  // tolerance of the solver times the condition of the problem
  Random random(71);
  for (int trial = 0; trial < 30; ++trial) {
    const Eigen::Index n = random.integer(5, 60);
    const LoadProblem problem = parabolic_problem(n, random.log_uniform(0.01, 1.0), random);
    const LoadDistribution reference = solve_load_distribution(problem);
    REQUIRE(reference.usable());
    // All of the force on one point presses it in so deep that the solver takes many others in, one at an end where the gap is wide few.
    const Eigen::Index alone = trial % 2 == 0 ? n / 2 : 0;
    const LoadDistribution found = solve_load_distribution(problem, {}, Eigen::VectorXd::Unit(n, alone));
    CAPTURE(trial, n, alone);
    REQUIRE(found.usable());
    CHECK((found.line_load - reference.line_load).lpNorm<Eigen::Infinity>() <= kRoundOff * reference.line_load.maxCoeff());
    CHECK((found.remaining_gap - reference.remaining_gap).lpNorm<Eigen::Infinity>() <= kRoundOff * reference.transmission_error);
    CHECK(load_cases::optimality(problem, found.line_load, found.transmission_error).worst() <= 1e-12);
  }
}

TEST_CASE("A start a little off the answer takes few steps, and fewer points than there are", "[core][load]") {
  Random random(72);
  const LoadProblem problem = parabolic_problem(60, 0.1, random);
  const LoadDistribution reference = solve_load_distribution(problem);
  REQUIRE(reference.usable());
  REQUIRE(reference.line_load.minCoeff() == 0.0);
  // Newton's method squares a relative error of 1e-3 about twice.
  const Eigen::VectorXd near = reference.line_load.cwiseProduct(random.vector(60, 0.999, 1.001));
  const LoadDistribution found = solve_load_distribution(problem, {}, near);
  REQUIRE(found.usable());
  CHECK(found.iterations <= 3);
  CHECK(found.factorisations == found.iterations);
}

TEST_CASE("An answer does not depend on what was solved before", "[core][load]") {
  Random random(73);
  LoadSolver solver;
  for (int trial = 0; trial < 60; ++trial) {
    const LoadProblem problem = load_cases::random_problem(random.integer(1, 60), random);
    const LoadDistribution found = solver.solve(problem), alone = solve_load_distribution(problem);
    CHECK(found.line_load == alone.line_load);
    CHECK(found.transmission_error == alone.transmission_error);
    CHECK(found.iterations == alone.iterations);
  }
}

TEST_CASE("The solver's own derivatives are those of its answer", "[core][load][gradient]") {
  // Bound of the change of H's diagonal that the factor may be old by, times the condition of the problem.
  constexpr double kOldFactor = 1e-7;
  Random random(74);
  LoadSolver solver;
  for (int trial = 0; trial < 60; ++trial) {
    const Eigen::Index n = random.integer(1, 60);
    const LoadProblem problem = parabolic_problem(n, random.log_uniform(0.001, 1.0), random);
    const LoadDistribution found = solver.solve(problem);
    REQUIRE(found.usable());
    const Eigen::MatrixXd gaps = random.matrix(n, 3);
    const auto own = solver.sensitivity().with_gap(gaps), anew = LoadSensitivity(problem, found).with_gap(gaps);
    CAPTURE(trial, n);
    CHECK((own.line_load - anew.line_load).norm() <= kOldFactor * anew.line_load.norm());
    CHECK((own.transmission_error - anew.transmission_error).norm() <= kOldFactor * anew.transmission_error.norm());
  }
}
