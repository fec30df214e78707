#include "core/load/solve/load_problem.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "core/base/error.hpp"
#include "core/load/solve/load_solver.hpp"
#include "tests/core/load/load_cases.hpp"

using namespace flankwright;
using load_cases::Random;
using load_cases::steel_law;
using load_cases::Structure;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Where an increasing function passes a value, by bisection to the last bit.
template <class Function>
double bisect(const Function& increasing, double value, double low, double high) {
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high)) {
    (increasing(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Independent slices: the approach f at which the loads they take add up to the force, each load found for itself.
struct Slices {
  const LoadProblem& problem;

  double load_at(Eigen::Index i, double f) const {
    if (f <= problem.gap[i]) return 0.0;
    const auto deflection = [&](double w) {
      const double local = problem.laws.empty() ? 0.0 : problem.laws[static_cast<std::size_t>(i)].deflection(w);
      return problem.influence(i, i) * problem.weight[i] * w + local;
    };
    double high = problem.force / problem.weight.minCoeff();
    while (deflection(high) < f - problem.gap[i]) high *= 2.0;
    return bisect(deflection, f - problem.gap[i], 0.0, high);
  }
  double force_at(double f) const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < problem.gap.size(); ++i) sum += problem.weight[i] * load_at(i, f);
    return sum;
  }
  double approach() const {
    double span = 1e-6;
    while (force_at(problem.gap.minCoeff() + span) < problem.force) span *= 2.0;
    return bisect([&](double f) { return force_at(f); }, problem.force, problem.gap.minCoeff(), problem.gap.minCoeff() + span);
  }
};

LoadProblem gear_like_problem(int n, Random& random, Structure structure) {
  LoadProblem problem;
  problem.weight = random.vector(n, 5.0, 15.0);
  problem.influence = load_cases::influence(structure, n, 3e-6, random);
  problem.gap = random.vector(n, 0.0, 0.02);
  problem.laws = load_cases::random_laws(n, random);
  problem.force = random.log_uniform(1.0, 500.0) * problem.weight.sum();
  return problem;
}

/// Two springs, compliances 2e-6 and 3e-6 mm/N, the second one 4 um further away.
LoadProblem two_springs(double force) {
  LoadProblem problem;
  problem.influence = Eigen::Vector2d(2e-6, 3e-6).asDiagonal();
  problem.weight = Eigen::Vector2d(10.0, 20.0);
  problem.gap = Eigen::Vector2d(0.001, 0.005);
  problem.force = force;
  return problem;
}

}  // namespace

TEST_CASE("A single point yields by its gap, its bending and its contact", "[core][load][closed-form]") {
  constexpr double kRoundOff = 1e-14;
  const double force = GENERATE(1e-2, 1e3, 1e7);  // N
  LoadProblem problem{
      Eigen::MatrixXd::Constant(1, 1, 4e-6), Eigen::VectorXd::Constant(1, 12.0), Eigen::VectorXd::Constant(1, 0.003), {steel_law()}, force};
  const LoadDistribution found = solve_load_distribution(problem);
  REQUIRE(found.usable());
  const double contact = steel_law().deflection(force / 12.0);
  CHECK(found.line_load[0] == Approx(force / 12.0).epsilon(kRoundOff));
  CHECK(found.structural_deflection[0] == Approx(4e-6 * force).epsilon(kRoundOff));
  CHECK(found.contact_deflection[0] == Approx(contact).epsilon(kRoundOff));
  CHECK(found.transmission_error == Approx(0.003 + 4e-6 * force + contact).epsilon(kRoundOff));
}

TEST_CASE("Two springs share the force once the second one is reached", "[core][load][closed-form]") {
  constexpr double kRoundOff = 1e-13;
  SECTION("before: the first carries all") {
    const LoadDistribution found = solve_load_distribution(two_springs(1500.0));
    REQUIRE(found.usable());
    CHECK(found.line_load[0] * 10.0 == Approx(1500.0).epsilon(kRoundOff));
    CHECK(found.line_load[1] == 0.0);
    CHECK(found.transmission_error == Approx(0.001 + 2e-6 * 1500.0).epsilon(kRoundOff));
    CHECK(found.remaining_gap[1] == Approx(0.005 - 0.004).epsilon(kRoundOff));
  }
  SECTION("after: in parallel, F = (f - g_1)/K_1 + (f - g_2)/K_2") {
    const LoadDistribution found = solve_load_distribution(two_springs(6000.0));
    REQUIRE(found.usable());
    const double f = (6000.0 + 0.001 / 2e-6 + 0.005 / 3e-6) / (1.0 / 2e-6 + 1.0 / 3e-6);
    CHECK(found.transmission_error == Approx(f).epsilon(kRoundOff));
    CHECK(found.line_load[0] * 10.0 == Approx((f - 0.001) / 2e-6).epsilon(kRoundOff));
    CHECK(found.line_load[1] * 20.0 == Approx((f - 0.005) / 3e-6).epsilon(kRoundOff));
  }
}

TEST_CASE("Slices without coupling carry what a bisection over the approach finds", "[core][load][independent]") {
  constexpr double kRoundOff = 1e-10;  // two nested bisections
  Random random(31);
  const bool bending = GENERATE(true, false);  // false: Hertzian contact alone
  const bool contact = GENERATE(true, false);
  if (!bending && !contact) return;  // nothing would yield
  for (int trial = 0; trial < 8; ++trial) {
    LoadProblem problem = gear_like_problem(random.integer(1, 30), random, bending ? Structure::Slices : Structure::Rigid);
    if (!contact) problem.laws.clear();
    const LoadDistribution found = solve_load_distribution(problem);
    CAPTURE(bending, contact, trial);
    REQUIRE(found.usable());
    const double f = Slices{problem}.approach();
    CHECK(found.transmission_error == Approx(f).epsilon(kRoundOff));
    const double mean = problem.force / problem.weight.sum();
    for (Eigen::Index i = 0; i < problem.gap.size(); ++i) {
      CHECK(std::abs(found.line_load[i] - Slices{problem}.load_at(i, f)) <= kRoundOff * mean * 100.0);
    }
  }
}

TEST_CASE("Loads balance the force, never pull, and never overlap the flanks", "[core][load]") {
  constexpr double kRoundOff = 1e-12;
  Random random(32);
  const auto structure = GENERATE(Structure::Slices, Structure::DecayingKernel, Structure::LowRank, Structure::WholeBody);
  for (int trial = 0; trial < 20; ++trial) {
    const LoadProblem problem = gear_like_problem(random.integer(2, 60), random, structure);
    const LoadDistribution found = solve_load_distribution(problem);
    REQUIRE(found.usable());
    const auto conditions = load_cases::optimality(problem, found.line_load, found.transmission_error);
    CHECK(conditions.non_negative);
    CHECK(conditions.balance <= 4e-16 * static_cast<double>(problem.gap.size()));
    CHECK(conditions.loaded <= kRoundOff);
    CHECK(conditions.unloaded <= kRoundOff);
    CHECK(found.line_load.cwiseProduct(found.remaining_gap).lpNorm<Eigen::Infinity>() <=
          kRoundOff * found.line_load.maxCoeff() * (found.transmission_error - problem.gap.minCoeff()));
  }
}

TEST_CASE("Neither the order of the points nor the start changes the loads", "[core][load]") {
  constexpr double kRoundOff = 1e-10;  // tolerance of the solver times the condition of the problem
  Random random(33);
  for (int trial = 0; trial < 40; ++trial) {
    const int n = random.integer(2, 60);
    const LoadProblem problem = gear_like_problem(n, random, static_cast<Structure>(trial % 4));
    const LoadDistribution reference = solve_load_distribution(problem);
    REQUIRE(reference.usable());
    const double scale = reference.line_load.maxCoeff();
    CAPTURE(trial, n);

    Eigen::VectorXd start = random.vector(n, -1.0, 1.0).cwiseMax(0.0);  // some points start without load
    start[random.integer(0, n - 1)] = 1.0;
    const LoadDistribution restarted = solve_load_distribution(problem, {}, start);
    REQUIRE(restarted.usable());
    CHECK((restarted.line_load - reference.line_load).lpNorm<Eigen::Infinity>() <= kRoundOff * scale);
    CHECK(restarted.transmission_error == Approx(reference.transmission_error).epsilon(kRoundOff));

    std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size() - 1; i > 0; --i) {
      std::swap(order[i], order[static_cast<std::size_t>(random.integer(0, static_cast<int>(i)))]);
    }
    LoadProblem shuffled{problem.influence(order, order), problem.weight(order), problem.gap(order), {}, problem.force};
    for (Eigen::Index i : order) shuffled.laws.push_back(problem.laws[static_cast<std::size_t>(i)]);
    const LoadDistribution permuted = solve_load_distribution(shuffled);
    REQUIRE(permuted.usable());
    CHECK((permuted.line_load - reference.line_load(order)).lpNorm<Eigen::Infinity>() <= kRoundOff * scale);
    CHECK(permuted.transmission_error == Approx(reference.transmission_error).epsilon(kRoundOff));
  }
}

TEST_CASE("A gap common to all points moves the transmission error and no load", "[core][load]") {
  constexpr double kRoundOff = 1e-11;
  Random random(34);
  LoadProblem problem = gear_like_problem(20, random, Structure::DecayingKernel);
  problem.force = 1e-3 * problem.weight.sum();  // nanometres of deflection ...
  problem.gap.setConstant(0.0);
  const LoadDistribution touching = solve_load_distribution(problem);
  problem.gap.setConstant(1.0);  // ... a millimetre away
  const LoadDistribution apart = solve_load_distribution(problem);
  REQUIRE(touching.usable());
  REQUIRE(apart.usable());
  CHECK((apart.line_load - touching.line_load).norm() <= kRoundOff * touching.line_load.norm());
  CHECK(apart.transmission_error == Approx(1.0 + touching.transmission_error).epsilon(1e-15));
}

TEST_CASE("Without force the flanks touch where the gap is least", "[core][load][closed-form]") {
  Random random(35);
  LoadProblem problem = gear_like_problem(9, random, Structure::Slices);
  problem.force = 0.0;
  const LoadDistribution found = solve_load_distribution(problem);
  REQUIRE(found.usable());
  CHECK(found.line_load.isZero(0.0));
  CHECK(found.transmission_error == problem.gap.minCoeff());
  CHECK(found.remaining_gap.minCoeff() == 0.0);
  CHECK(found.kkt_residual == 0.0);
}

TEST_CASE("A load distribution that is not found has a status", "[core][load]") {
  const LoadDistribution none = solve_load_distribution({{}, {}, {}, {}, 100.0});
  CHECK(none.status == LoadStatus::NoContactPoints);
  CHECK_FALSE(none.usable());

  Random random(36);
  const LoadProblem problem = gear_like_problem(20, random, Structure::DecayingKernel);
  const LoadDistribution stopped = solve_load_distribution(problem, {.tolerance = 1e-12, .max_iterations = 1});
  CHECK(stopped.status == LoadStatus::IterationLimit);
  CHECK_FALSE(stopped.usable());
  CHECK_THAT(stopped.message, Catch::Contains("1 Newton step"));

  CHECK(LoadDistribution{}.status == LoadStatus::NotRun);
}

TEST_CASE("A load problem that is not one is refused", "[core][load][input]") {
  Random random(37);
  LoadProblem problem = gear_like_problem(4, random, Structure::Slices);
  SECTION("a gap too few") { problem.gap = problem.gap.head(3).eval(); }
  SECTION("a law too few") { problem.laws.pop_back(); }
  SECTION("an influence matrix of another size") { problem.influence = problem.influence.topRows(3).eval(); }
  SECTION("a weight of zero") { problem.weight[2] = 0.0; }
  SECTION("a negative weight") { problem.weight[0] = -1.0; }
  SECTION("a gap that is not a number") { problem.gap[1] = not_given; }
  SECTION("an infinite influence") { problem.influence(1, 1) = infinity; }
  SECTION("a negative force") { problem.force = -1.0; }
  SECTION("an infinite force") { problem.force = infinity; }
  SECTION("a force that is not a number") { problem.force = not_given; }
  CHECK_THROWS_AS(solve_load_distribution(problem), InvalidInput);
}

TEST_CASE("A start of the wrong size is refused", "[core][load][input]") {
  Random random(38);
  const LoadProblem problem = gear_like_problem(4, random, Structure::Slices);
  CHECK_THROWS_AS(solve_load_distribution(problem, {}, Eigen::VectorXd::Ones(3)), InvalidInput);
}
