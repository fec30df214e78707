#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/load/solve/load_solver.hpp"
#include "tests/core/load/load_cases.hpp"
#include "tests/hard_cases/floating_point_traps.hpp"
#include "tests/reference/eigenvalues.hpp"

using namespace flankwright;
using load_cases::Random;

namespace {

/// Solves random problems of 1 .. largest points, small ones most often; reports the worst of all, not each.
void check_random_problems(int count, double largest, std::uint64_t seed) {
  constexpr double kRoundOff = 1e-9;
  const hard_cases::FloatingPointTraps traps;
  Random random(seed);
  int failed = 0, most_iterations = 0, first_failure = -1;
  double worst = 0.0;
  for (int i = 0; i < count; ++i) {
    const LoadProblem problem = load_cases::random_problem(static_cast<int>(random.log_uniform(1.0, largest + 1.0)), random);
    const LoadDistribution found = solve_load_distribution(problem);
    const bool good = found.usable() && found.kkt_residual <= kRoundOff &&
                      load_cases::optimality(problem, found.line_load, found.transmission_error).worst() <= kRoundOff;
    if (!good) {
      if (failed++ == 0) first_failure = i;
      continue;
    }
    worst = std::max(worst, found.kkt_residual);
    most_iterations = std::max(most_iterations, found.iterations);
  }
  CAPTURE(count, first_failure, worst, most_iterations);
  CHECK(failed == 0);
  CHECK(most_iterations <= 30);  // Newton: a handful, 9 when written
}

/// Solves problems again from a random start, and with the points in random order: f_t and both deflections must be the same, relative
/// to the largest deflection. So must the loads, relative to the largest, except where there are no contact laws and the structure is nearly
/// singular: loads that cause no deflection are anything.
void check_independence(int count, double largest, std::uint64_t seed) {
  constexpr double kRoundOff = 1e-9;
  Random random(seed);
  double worst = 0.0, worst_load = 0.0;
  int failed = 0;
  for (int i = 0; i < count; ++i) {
    const int n = static_cast<int>(random.log_uniform(1.0, largest + 1.0));
    const LoadProblem problem = load_cases::random_problem(n, random);
    const LoadDistribution reference = solve_load_distribution(problem);

    Eigen::VectorXd start = random.vector(n, -1.0, 1.0).cwiseMax(0.0);  // some points start without load
    start[random.integer(0, n - 1)] = 1.0;
    const LoadDistribution restarted = solve_load_distribution(problem, {}, start);

    std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t j = order.size() - 1; j > 0; --j) std::swap(order[j], order[static_cast<std::size_t>(random.integer(0, static_cast<int>(j)))]);
    LoadProblem shuffled{problem.influence(order, order), problem.weight(order), problem.gap(order), {}, problem.force};
    if (!problem.laws.empty()) {
      for (const Eigen::Index j : order) shuffled.laws.push_back(problem.laws[static_cast<std::size_t>(j)]);
    }
    LoadDistribution permuted = solve_load_distribution(shuffled);
    if (!reference.usable() || !restarted.usable() || !permuted.usable()) {
      ++failed;
      continue;
    }
    Eigen::VectorXd loads(n), bent(n), flattened(n);
    loads(order) = permuted.line_load;
    bent(order) = permuted.structural_deflection;
    flattened(order) = permuted.contact_deflection;
    permuted.line_load = loads;
    permuted.structural_deflection = bent;
    permuted.contact_deflection = flattened;
    const double deflection =
        (problem.influence.cwiseAbs() * problem.weight.cwiseProduct(reference.line_load) + reference.contact_deflection).maxCoeff();
    const double digits = std::numeric_limits<double>::epsilon() * std::abs(reference.transmission_error);
    for (const LoadDistribution* other : {&restarted, static_cast<const LoadDistribution*>(&permuted)}) {
      const double f = std::abs(other->transmission_error - reference.transmission_error) - digits;
      const double bending = (other->structural_deflection - reference.structural_deflection).cwiseAbs().maxCoeff();
      const double local = (other->contact_deflection - reference.contact_deflection).cwiseAbs().maxCoeff();
      worst = std::max(worst, std::max({f, bending, local}) / deflection);
      const double load = (other->line_load - reference.line_load).cwiseAbs().maxCoeff() / reference.line_load.maxCoeff();
      if (!problem.laws.empty()) worst_load = std::max(worst_load, load);
    }
  }
  CAPTURE(count, worst, worst_load);
  CHECK(failed == 0);
  CHECK(worst <= kRoundOff);
  CHECK(worst_load <= kRoundOff);
}

}  // namespace

TEST_CASE("Every one of 3000 random load problems is solved", "[core][load][hard]") { check_random_problems(3000, 200, 1991); }

TEST_CASE("Neither start nor order of points matters to random load problems", "[core][load][hard]") { check_independence(400, 100, 2028); }

TEST_CASE("The number of threads does not change a bit of random load problems", "[core][load][hard]") {
  constexpr int count = 60;
  Random random(2029);
  std::vector<LoadProblem> problems;
  for (int i = 0; i < count; ++i) problems.push_back(load_cases::random_problem(random.integer(1, 80), random));
  const auto solve_all = [&](int threads) {
    std::vector<LoadDistribution> found(count);
    tbb::task_arena(threads).execute([&] {
      tbb::parallel_for(0, count,
                        [&](int i) { found[static_cast<std::size_t>(i)] = solve_load_distribution(problems[static_cast<std::size_t>(i)]); });
    });
    return found;
  };
  const auto alone = solve_all(1), together = solve_all(2);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    CAPTURE(i);
    CHECK(alone[i].line_load == together[i].line_load);
    CHECK(alone[i].transmission_error == together[i].transmission_error);
  }
}

TEST_CASE("Neither start nor order of points matters to 20000 random load problems", "[.soak][core][load]") { check_independence(20000, 400, 2030); }

TEST_CASE("Random load problems cover what they claim", "[core][load]") {
  Random random(2031);
  double least_load = 1e300, most_load = 0.0, largest_gap = 0.0, worst_condition = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const LoadProblem problem = load_cases::random_problem(random.integer(2, 12), random);
    const double mean = problem.force / problem.weight.sum();
    least_load = std::min(least_load, mean);
    most_load = std::max(most_load, mean);
    largest_gap = std::max(largest_gap, problem.gap.maxCoeff() - problem.gap.minCoeff());
    const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(problem.influence);
    worst_condition = std::max(worst_condition, eigenvalues.maxCoeff() / std::max(eigenvalues.minCoeff(), 1e-300));
  }
  CHECK(least_load < 2e-3);       // N/mm
  CHECK(most_load > 5e5);         // N/mm
  CHECK(largest_gap > 0.5);       // mm
  CHECK(worst_condition > 1e12);  // singular to round-off
}

TEST_CASE("Every one of 100000 random load problems is solved", "[.soak][core][load]") {
  check_random_problems(99700, 200, 2026);
  check_random_problems(300, 2000, 2027);
}
