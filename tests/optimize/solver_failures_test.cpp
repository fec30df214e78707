#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/base/error.hpp"
#include "optimize/solvers/solver.hpp"
#include "tests/problems/library.hpp"
#include "tests/common/about.hpp"

namespace flankwright {

namespace {

using namespace problems;

/// A quadratic whose every part a test can bend; the minimiser is (0.25, ..., 0.25).
class Bendable final : public NonlinearProgram {
 public:
  Eigen::VectorXd lower_bounds = Eigen::VectorXd::Zero(2), upper_bounds = Eigen::VectorXd::Ones(2);
  Eigen::VectorXd from = Eigen::VectorXd::Constant(2, 0.8);
  std::chrono::milliseconds delay{0};
  bool throws{false};
  Eigen::Index gradient_size{2};

  int variables() const override { return static_cast<int>(from.size()); }
  int constraints() const override { return 0; }
  Eigen::VectorXd lower() const override { return lower_bounds; }
  Eigen::VectorXd upper() const override { return upper_bounds; }
  Eigen::VectorXd start() const override { return from; }
  ProgramValues evaluate(const Eigen::VectorXd& x, bool) override {
    std::this_thread::sleep_for(delay);
    if (throws) throw std::runtime_error("the tooth is undercut");
    ProgramValues values;
    const Eigen::VectorXd way = x.array() - 0.25;
    values.objective = way.squaredNorm();
    values.objective_gradient = 2.0 * way;
    values.objective_gradient.conservativeResize(gradient_size);
    return values;
  }
};

/// |x - 0.5| + 2 |y - 0.3|, which a quadratic model cannot follow: a line search goes on shortening its step at the kink.
class Kinked final : public NonlinearProgram {
 public:
  std::vector<Eigen::VectorXd> asked{};  ///< every point, in order

  int variables() const override { return 2; }
  int constraints() const override { return 0; }
  Eigen::VectorXd lower() const override { return Eigen::VectorXd::Zero(2); }
  Eigen::VectorXd upper() const override { return Eigen::VectorXd::Ones(2); }
  Eigen::VectorXd start() const override { return Eigen::Vector2d(0.9, 0.8); }
  ProgramValues evaluate(const Eigen::VectorXd& x, bool) override {
    asked.push_back(x);
    const Eigen::Array2d way = x.array() - Eigen::Array2d(0.5, 0.3), steepness(1.0, 2.0);
    ProgramValues values;
    values.objective = (steepness * way.abs()).sum();
    values.objective_gradient = steepness * way.sign();
    return values;
  }
};

bool is_global(const std::string& name) {
  return name == "nlopt:crs2_lm" || name == "nlopt:isres" || name == "nlopt:direct_l" || name == "nlopt:esch" || name == "nlopt:mlsl";
}

SolverOptions options_for(const std::string& name, int max_evaluations = 1000) {
  SolverOptions options;
  options.name = name;
  options.max_evaluations = max_evaluations;
  return options;
}

}  // namespace

TEST_CASE("a time limit ends every solver in order with the best point so far", "[optimize][solver]") {
  for (const std::string& name : solver_names()) {
    Bendable problem;
    problem.delay = std::chrono::milliseconds(8);
    SolverOptions options = options_for(name);
    options.max_seconds = 0.02;
    const SolverResult result = solve(problem, options);
    CAPTURE(name, result.message);
    // The limit comes at the third or fourth evaluation; Ipopt, SLSQP and L-BFGS may solve this quadratic in as many.
    CHECK((result.status == SolverStatus::TimeLimit || result.status == SolverStatus::Converged));
    CHECK(result.evaluations <= 5);
    CHECK(result.objective <= result.history.front().objective);
    if (!uses_gradients(name)) CHECK(result.status == SolverStatus::TimeLimit);
  }
}

TEST_CASE("points that cannot be evaluated are survived and counted", "[optimize][solver]") {
  for (const std::string& name : solver_names()) {
    ThrowingBowl problem;
    const SolverResult result = solve(problem, options_for(name, 3000));
    CAPTURE(name, result.message, result.failures);
    CHECK(result.objective == Approx(problem.optimum()).epsilon(1e-3));  // model: the coarsest solver's accuracy
    if (is_global(name)) CHECK(result.failures > 0);
    CHECK((result.failures > 0) == (result.message.find("no contact") != std::string::npos));
  }
}

TEST_CASE("a start that cannot be evaluated fails a local solver and not a global one", "[optimize][solver]") {
  for (const std::string& name : solver_names()) {
    ThrowingBowl problem(vector_of(0.9, 0.9));
    const SolverResult result = solve(problem, options_for(name, 3000));
    CAPTURE(name, result.message);
    if (is_global(name)) {
      CHECK(result.objective == Approx(problem.optimum()).epsilon(1e-3));
      continue;
    }
    CHECK(result.status == SolverStatus::Failed);
    CHECK(result.message.find("no contact") != std::string::npos);
    CHECK(result.evaluations == 1);
    CHECK(result.failures == 1);
    CHECK(result.x.size() == 0);
    CHECK(std::isnan(result.objective));
  }
}

TEST_CASE("a programme that never evaluates is a status, not an exception", "[optimize][solver]") {
  for (const std::string& name : solver_names()) {
    Bendable problem;
    problem.throws = true;
    const SolverResult result = solve(problem, options_for(name, 200));
    CAPTURE(name);
    CHECK(result.status == SolverStatus::Failed);
    CHECK(result.message.find("the tooth is undercut") != std::string::npos);
    CHECK(result.failures == result.evaluations);
  }
}

TEST_CASE("a gradient of the wrong size is a failed evaluation that names both sizes", "[optimize][solver]") {
  Bendable problem;
  problem.gradient_size = 3;
  const SolverResult result = solve(problem, options_for("ipopt"));
  CHECK(result.status == SolverStatus::Failed);
  CHECK(result.message.find("objective_gradient = 3 entries: allowed is 2") != std::string::npos);
  CHECK(solve(problem, options_for("nlopt:bobyqa")).status == SolverStatus::Converged);  // never asks for it
}

TEST_CASE("the progress callback sees every evaluation and a best value that never rises", "[optimize][solver]") {
  for (const std::string& name : solver_names()) {
    if (!accepts_constraints(name)) continue;
    HockSchittkowski71 problem;  // its start is infeasible
    SolverOptions options = options_for(name, 200);
    int calls = 0;
    double best = std::numeric_limits<double>::quiet_NaN();
    bool rises = false, skips = false;
    options.progress = [&](int evaluations, double value) {
      skips = skips || evaluations != ++calls;
      rises = rises || value > best || (std::isnan(value) && !std::isnan(best));
      best = value;
    };
    const SolverResult result = solve(problem, options);
    CAPTURE(name);
    CHECK(calls == result.evaluations);
    CHECK_FALSE(skips);
    CHECK_FALSE(rises);
  }
}

TEST_CASE("a progress callback that throws ends the run in order", "[optimize][solver]") {
  for (const std::string& name : solver_names()) {
    Bendable problem;
    SolverOptions options = options_for(name);
    options.progress = [](int evaluations, double) {
      if (evaluations == 3) throw std::runtime_error("cancelled by the engineer");
    };
    const SolverResult result = solve(problem, options);
    CAPTURE(name, result.message);
    CHECK(result.status == SolverStatus::Failed);
    CHECK(result.message.find("cancelled by the engineer") != std::string::npos);
    CHECK(result.evaluations == 3);
    CHECK(result.objective <= result.history.front().objective);
  }
}

TEST_CASE("slsqp ends with its first step below the tolerance, within a line search too", "[optimize][solver]") {
  Kinked kinked;
  SolverOptions options = options_for("nlopt:slsqp");
  options.tolerance = GENERATE(1e-3, 1e-5);
  const SolverResult result = solve(kinked, options);
  CHECK(result.status == SolverStatus::Converged);
  REQUIRE(kinked.asked.size() > 2);
  for (std::size_t i = 1; i < kinked.asked.size(); ++i) {
    const double step = (kinked.asked[i] - kinked.asked[i - 1]).lpNorm<Eigen::Infinity>();
    CAPTURE(options.tolerance, i, step);
    CHECK((step <= options.tolerance) == (i + 1 == kinked.asked.size()));
  }
}

TEST_CASE("a variable with equal bounds stays where it is", "[optimize][solver]") {
  for (const std::string& name : solver_names()) {
    Bendable problem;
    problem.gradient_size = 3;
    problem.from = vector_of(0.8, 0.6, 0.8);
    problem.lower_bounds = vector_of(0.0, 0.6, 0.0);
    problem.upper_bounds = vector_of(1.0, 0.6, 1.0);
    const SolverResult result = solve(problem, options_for(name, 4000));
    CAPTURE(name, result.message);
    CHECK(result.x[1] == 0.6);
    CHECK(result.objective == tests::about(0.35 * 0.35, 1e-3));  // model: the coarsest solver's accuracy

    problem.lower_bounds = problem.upper_bounds = problem.from;
    const SolverResult fixed = solve(problem, options_for(name));
    CHECK(fixed.status == SolverStatus::Converged);
    CHECK(fixed.evaluations == 1);
    CHECK(fixed.x == problem.from);
  }
}

TEST_CASE("local solvers take variables without bounds", "[optimize][solver]") {
  for (const std::string& name : solver_names()) {
    Bendable problem;
    problem.lower_bounds.setConstant(-std::numeric_limits<double>::infinity());
    problem.upper_bounds[0] = std::numeric_limits<double>::infinity();
    CAPTURE(name);
    if (is_global(name)) {
      CHECK_THROWS_AS(solve(problem, options_for(name)), InvalidInput);
    } else {
      CHECK(solve(problem, options_for(name)).objective == tests::about(0.0, 1e-8));  // model: the step tolerance, squared
    }
  }
}

TEST_CASE("solvers that cannot take a programme are refused with those that can", "[optimize][solver]") {
  HockSchittkowski71 problem;
  for (const std::string& name : solver_names()) {
    if (accepts_constraints(name)) continue;
    CAPTURE(name);
    CHECK_THROWS_WITH(solve(problem, options_for(name)), Catch::Contains("ipopt, nlopt:slsqp, nlopt:mma, nlopt:ccsaq, nlopt:cobyla, nlopt:isres"));
  }
  CHECK(problem.evaluations == 0);
}

TEST_CASE("options and programmes that contradict themselves are bad input", "[optimize][solver]") {
  Bendable problem;
  const auto refused = [&](auto change) {
    SolverOptions options;
    change(options);
    CHECK_THROWS_AS(solve(problem, options), InvalidInput);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](SolverOptions& o) { o.name = "nlopt:simplex"; });
  refused([](SolverOptions& o) { o.tolerance = 0.0; });
  refused([&](SolverOptions& o) { o.tolerance = nan; });
  refused([](SolverOptions& o) { o.constraint_tolerance = -1.0; });
  refused([](SolverOptions& o) { o.max_evaluations = 0; });
  refused([&](SolverOptions& o) { o.max_seconds = nan; });
  CHECK_THROWS_WITH(uses_gradients("nlopt:simplex"), Catch::Contains("nlopt:slsqp"));

  Bendable outside, crossed, short_start;
  outside.from[1] = 1.5;
  CHECK_THROWS_WITH(solve(outside, {}), Catch::Contains("start[1]"));
  crossed.lower_bounds[0] = 2.0;
  CHECK_THROWS_WITH(solve(crossed, {}), Catch::Contains("bounds[0]"));
  short_start.from.resize(1);
  CHECK_THROWS_AS(solve(short_start, {}), InvalidInput);

  Bendable rounded;  // round-off outside a bound is clipped
  rounded.from[0] = 1.0 + 1e-15;
  CHECK(solve(rounded, {}).status == SolverStatus::Converged);

  Bendable single;
  single.lower_bounds[0] = single.upper_bounds[0] = single.from[0];
  CHECK_THROWS_WITH(solve(single, options_for("nlopt:bobyqa")), Catch::Contains("at least 2 free variables"));
}

TEST_CASE("runs side by side in threads give the bits of runs one after the other", "[optimize][solver]") {
  const std::vector<std::string> names{"ipopt", "nlopt:isres", "nlopt:slsqp", "ipopt", "nlopt:isres", "ipopt"};
  const auto run = [](const std::string& name) {
    HockSchittkowski100 problem;
    return solve(problem, options_for(name, 400));
  };
  std::vector<SolverResult> together(names.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < names.size(); ++i) {
    threads.emplace_back([&, i] { together[i] = run(names[i]); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const SolverResult alone = run(names[i]);
    CAPTURE(names[i]);
    REQUIRE(alone.history.size() == together[i].history.size());
    bool same = true;
    for (std::size_t k = 0; k < alone.history.size(); ++k) {
      same = same && std::memcmp(&alone.history[k].objective, &together[i].history[k].objective, sizeof(double)) == 0;
    }
    CHECK(same);
  }
}

}  // namespace flankwright
