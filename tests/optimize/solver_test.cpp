#include "optimize/solvers/solver.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>

#include "tests/common/random.hpp"
#include "tests/problems/library.hpp"
#include "tests/common/about.hpp"

namespace flankwright {

namespace {

using namespace problems;

/// What is asked of a solver on the library.
struct Expectation {
  const char* solver;
  double tolerance;  ///< model: |f - f*| <= tolerance * max(1, |f*|), from the method's own accuracy
  int budget;        ///< evaluations
  bool converges;    ///< it has a convergence test, and meets it within the budget
};

const std::vector<Expectation>& expectations() {
  // Published optima carry 7 to 10 digits; 1e-6 is what constraint_tolerance leaves to a gradient method.
  static const std::vector<Expectation> table{
      {"ipopt", 1e-6, 200, true},          {"nlopt:slsqp", 1e-6, 200, true},    {"nlopt:mma", 2e-6, 1000, true},
      {"nlopt:ccsaq", 2e-6, 1000, true},   {"nlopt:lbfgs", 1e-6, 200, true},    {"nlopt:cobyla", 1e-6, 3000, true},
      {"nlopt:bobyqa", 1e-8, 500, true},   {"nlopt:sbplx", 1e-6, 1000, true},   {"nlopt:neldermead", 1e-6, 1000, true},
      {"nlopt:crs2_lm", 1e-6, 5000, true}, {"nlopt:isres", 1e-3, 60000, false}, {"nlopt:direct_l", 1e-3, 3000, false},
      {"nlopt:esch", 0.3, 5000, false},    {"nlopt:mlsl", 1e-6, 1000, false}};
  return table;
}

/// First-order and linear models crawl along Rosenbrock's curved valley: a coarse answer, and no convergence asked.
Expectation on_problem(Expectation expectation, const KnownProblem& problem) {
  const std::string solver = expectation.solver;
  const bool crawls = solver == "nlopt:mma" || solver == "nlopt:ccsaq" || solver == "nlopt:cobyla";
  if (problem.name() == "Rosenbrock" && crawls) {
    expectation.tolerance = 1e-2;
    expectation.converges = false;
  }
  return expectation;
}

void check_books(const SolverResult& result, const KnownProblem& problem) {
  CHECK(result.evaluations == problem.evaluations);
  CHECK(result.gradient_evaluations == problem.gradient_evaluations);
  CHECK(result.gradient_evaluations == (uses_gradients(result.solver) ? result.evaluations : 0));
  CHECK(problem.outside_bounds == 0);
  REQUIRE(result.history.size() == static_cast<std::size_t>(result.evaluations));
  int failures = 0;
  for (std::size_t i = 0; i < result.history.size(); ++i) {
    const SolverStep& step = result.history[i];
    if (step.evaluation != static_cast<int>(i) + 1) FAIL("the history counts " << step.evaluation << " at " << i);
    if (!std::isfinite(step.objective)) ++failures;
  }
  CHECK(result.failures == failures);
  CHECK(result.seconds >= 0.0);
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void check_same_run(const SolverResult& a, const SolverResult& b) {
  CHECK(a.status == b.status);
  CHECK(a.message == b.message);
  REQUIRE(a.history.size() == b.history.size());
  for (std::size_t i = 0; i < a.history.size(); ++i) {
    if (!same_bits(a.history[i].objective, b.history[i].objective)) FAIL("histories part at evaluation " << i + 1);
  }
  REQUIRE(a.x.size() == b.x.size());
  for (Eigen::Index i = 0; i < a.x.size(); ++i) CHECK(same_bits(a.x[i], b.x[i]));
}

}  // namespace

TEST_CASE("the problem library's gradients agree with central differences", "[optimize][solver]") {
  auto problems = solvable();
  problems.push_back([] { return std::make_unique<Infeasible>(); });
  tests::Random32 random(7);
  for (const auto& make : problems) {
    const auto problem = make();
    CAPTURE(problem->name());
    const Eigen::VectorXd lower = problem->lower(), range = problem->upper() - lower;
    for (int trial = 0; trial < 3; ++trial) {
      Eigen::VectorXd x = problem->start();
      if (trial > 0) {
        for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = lower[i] + random(0.2, 0.45) * range[i];
      }
      const ProgramValues at = problem->evaluate(x, true);
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        // Discretisation: the truncation is h^2/6 f''', the cancellation 1e-16 |f| / h; h = 1e-5 keeps both below 1e-6
        // of the values' scale.
        const double h = 1e-5;
        const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(x.size(), i);
        const ProgramValues up = problem->evaluate(x + step, false), down = problem->evaluate(x - step, false);
        const double scale = 1.0 + std::abs(at.objective) + std::abs(at.objective_gradient[i]);
        CHECK(std::abs((up.objective - down.objective) / (2.0 * h) - at.objective_gradient[i]) <= 1e-6 * scale);
        if (problem->constraints() == 0) continue;
        const Eigen::VectorXd difference = (up.constraints - down.constraints) / (2.0 * h) - at.constraint_jacobian.col(i);
        CHECK(difference.cwiseAbs().maxCoeff() <= 1e-6 * (1.0 + at.constraints.cwiseAbs().maxCoeff()));
      }
    }
  }
}

TEST_CASE("every solver solves every problem that it accepts", "[optimize][solver]") {
  REQUIRE(expectations().size() == solver_names().size());
  for (const Expectation& general : expectations()) {
    for (const auto& make : solvable()) {
      const auto problem = make();
      if (problem->constraints() > 0 && !accepts_constraints(general.solver)) continue;
      const Expectation expectation = on_problem(general, *problem);
      SolverOptions options;
      options.name = expectation.solver;
      options.max_evaluations = expectation.budget;
      const SolverResult result = solve(*problem, options);
      CAPTURE(expectation.solver, problem->name(), result.message, result.evaluations);

      CHECK(result.solver == expectation.solver);
      CHECK(std::abs(result.objective - problem->optimum()) <= expectation.tolerance * std::max(1.0, std::abs(problem->optimum())));
      CHECK(result.constraint_violation <= options.constraint_tolerance);
      CHECK(result.evaluations <= options.max_evaluations);
      if (expectation.converges) CHECK(result.status == SolverStatus::Converged);
      if (problem->minimiser().size() > 0) {
        // f is locally quadratic in the library's problems, or better: the distance goes with the root of the error.
        const double distance = (result.x - problem->minimiser()).cwiseAbs().maxCoeff();
        CHECK(distance <= 30.0 * std::sqrt(expectation.tolerance));
      }
      CHECK((result.x.array() >= problem->lower().array()).all());
      CHECK((result.x.array() <= problem->upper().array()).all());
      check_books(result, *problem);

      // The result is the values at x, and no feasible point of the history is better by more than the violation that
      // the constraint tolerance allows buys (SolverResult::x).
      const ProgramValues again = problem->evaluate(result.x, false);
      CHECK(same_bits(again.objective, result.objective));
      double least = std::numeric_limits<double>::infinity();
      for (const SolverStep& step : result.history) {
        if (step.constraint_violation <= options.constraint_tolerance) least = std::min(least, step.objective);
      }
      CHECK(result.objective <= least + 10.0 * options.constraint_tolerance * std::max(1.0, std::abs(least)));
    }
  }
}

TEST_CASE("hundreds of constraints with a dense Jacobian cost few evaluations", "[optimize][solver]") {
  const auto* name = GENERATE("ipopt", "nlopt:slsqp", "nlopt:cobyla");
  ChebyshevApproximation problem(10, 250);  // 502 constraints
  SolverOptions options;
  options.name = name;
  options.max_evaluations = 400;
  const SolverResult result = solve(problem, options);
  CAPTURE(name, result.message, result.evaluations);
  CHECK(result.status == SolverStatus::Converged);
  CHECK(std::abs(result.objective - problem.optimum()) <= 1e-6);  // model: the constraint tolerance
  if (uses_gradients(name)) CHECK(result.evaluations <= 40);
  check_books(result, problem);
}

TEST_CASE("an infeasible programme ends at the least violation and never converges", "[optimize][solver]") {
  for (const Expectation& expectation : expectations()) {
    if (!accepts_constraints(expectation.solver)) continue;
    Infeasible problem;
    SolverOptions options;
    options.name = expectation.solver;
    options.max_evaluations = expectation.budget;
    const SolverResult result = solve(problem, options);
    CAPTURE(expectation.solver, result.message);
    CHECK((result.status == SolverStatus::Infeasible || result.status == SolverStatus::EvaluationLimit));
    if (uses_gradients(expectation.solver)) CHECK(result.status == SolverStatus::Infeasible);
    CHECK(result.constraint_violation == tests::about(1.0, 1e-6));  // model: the solvers' step tolerance
    CHECK(result.multipliers.size() == 0);
    check_books(result, problem);
  }
}

TEST_CASE("evaluation limits are honoured exactly, with the best point so far", "[optimize][solver]") {
  const int limit = GENERATE(1, 2, 7);
  for (const std::string& name : solver_names()) {
    Rosenbrock valley;
    HockSchittkowski100 constrained;
    KnownProblem& problem = accepts_constraints(name) ? static_cast<KnownProblem&>(constrained) : valley;
    SolverOptions options;
    options.name = name;
    options.max_evaluations = limit;
    const SolverResult result = solve(problem, options);
    CAPTURE(name, limit, result.message);
    CHECK(result.status == SolverStatus::EvaluationLimit);
    CHECK(result.evaluations == limit);
    // Both starts are feasible, and the start is evaluated first: never worse than it.
    CHECK(result.constraint_violation <= options.constraint_tolerance);
    CHECK(result.objective <= result.history.front().objective);
    check_books(result, problem);
  }
}

TEST_CASE("the same input gives the same bits, and only stochastic solvers heed the seed", "[optimize][solver]") {
  for (const std::string& name : solver_names()) {
    SolverOptions options;
    options.name = name;
    options.max_evaluations = 300;
    const auto run = [&](unsigned long seed) {
      options.seed = seed;
      if (accepts_constraints(name)) {
        CharalambousBandler2 problem;
        return solve(problem, options);
      }
      Rosenbrock problem;
      return solve(problem, options);
    };
    CAPTURE(name);
    const SolverResult first = run(1), other = run(2);
    check_same_run(first, run(1));
    const bool stochastic = name == "nlopt:crs2_lm" || name == "nlopt:isres" || name == "nlopt:esch" || name == "nlopt:mlsl";
    if (!stochastic) {
      check_same_run(first, other);
      continue;
    }
    bool same = first.history.size() == other.history.size();
    for (std::size_t i = 0; same && i < first.history.size(); ++i) {
      same = same_bits(first.history[i].objective, other.history[i].objective);
    }
    CHECK_FALSE(same);
  }
}

TEST_CASE("Ipopt's multipliers make the Lagrangian stationary on HS100", "[optimize][solver]") {
  HockSchittkowski100 problem;
  SolverOptions options;
  options.tolerance = 1e-9;
  const SolverResult result = solve(problem, options);
  REQUIRE(result.status == SolverStatus::Converged);
  REQUIRE(result.multipliers.size() == 4);
  const ProgramValues at = problem.evaluate(result.x, true);
  const Eigen::VectorXd residual = at.objective_gradient + at.constraint_jacobian.transpose() * result.multipliers;  // no bound is active
  // Model: Ipopt's scaled residual of 1e-9 times its scaling, below 100 here, with a margin of ten.
  CHECK(residual.cwiseAbs().maxCoeff() <= 1e-6);
  CHECK((result.multipliers.array() >= 0.0).all());
  CHECK(result.multipliers.cwiseProduct(at.constraints).cwiseAbs().maxCoeff() <= 1e-6);
  // Constraints 2 and 3 are far from active (Hock & Schittkowski): only 1 and 4 carry.
  CHECK(result.multipliers[0] > 0.1);
  CHECK(result.multipliers[3] > 0.1);
}

TEST_CASE("a minimax epigraph's multipliers are weights of the active functions: they sum to one", "[optimize][solver]") {
  CharalambousBandler2 problem;
  SolverOptions options;
  options.tolerance = 1e-9;
  const SolverResult result = solve(problem, options);
  REQUIRE(result.status == SolverStatus::Converged);
  REQUIRE(result.multipliers.size() == 3);
  CHECK(result.multipliers.sum() == tests::about(1.0, 1e-7));  // model: Ipopt's residual of 1e-9, scaled
  // The weighted gradients of the f_i cancel: 0 is in the convex hull of the active ones.
  const ProgramValues at = problem.evaluate(result.x, true);
  const Eigen::VectorXd hull = at.constraint_jacobian.leftCols(2).transpose() * result.multipliers;
  CHECK(hull.cwiseAbs().maxCoeff() <= 1e-6);
}

}  // namespace flankwright
