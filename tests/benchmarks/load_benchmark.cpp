#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <sys/resource.h>
#include <vector>

#include "core/contact/gap/plane_of_action_gap.hpp"
#include "core/load/solve/load_solver.hpp"
#include "tests/benchmarks/load_scene.hpp"
#include "tests/benchmarks/reference_solvers.hpp"
#include "tests/core/load/load_cases.hpp"

// Time of loaded contact on one thread, medians of repeated runs, processor time:
//   1. a mesh cycle of the 18/54 pair, 32 positions, 10 points per full line, all points coupled, with and without gradients with
//      respect to eight modifications; points, influence matrices and contact laws made before;
//   2. the same programmes by Ipopt and by NLopt's SLSQP, side by side;
//   3. one solve by number of points, with the exponent of the cost and the memory in use.
// An argument sets how often (default 31); with 1 the third part ends at 200 points.

using namespace flankwright;
using reference_solvers::processor_ms;

namespace {

double median(std::vector<double> times) {
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

double time_of(int repetitions, const std::function<void()>& work) {
  std::vector<double> times;
  for (int i = 0; i < repetitions; ++i) {
    const double start = processor_ms();
    work();
    times.push_back(processor_ms() - start);
  }
  return median(times);
}

constexpr int positions = 32, intervals = 5;

void report_cycle(bool root_stress, int repetitions) {
  const MeshModel model = load_scene::model(positions, intervals, root_stress);
  const FlankCondition condition = load_scene::condition();
  const auto parameters = load_scene::eight_modifications();
  const LoadedCycle cycle = analyse_cycle(model, condition, load_scene::torque, parameters);
  double sum = 0.0;  // keeps the work from being optimised away
  const auto time_once = [&](const std::vector<MeshParameter>& by) {
    const double start = processor_ms();
    sum += analyse_cycle(model, condition, load_scene::torque, by).positions.back().load.transmission_error;
    return processor_ms() - start;
  };
  std::vector<double> without, with, shares;  // in turn, so that both meet the same machine
  for (int i = 0; i < repetitions; ++i) {
    without.push_back(time_once({}));
    with.push_back(time_once(parameters));
    shares.push_back(100.0 * (1.0 - without.back() / with.back()));
  }
  const double plain = median(without), with_gradients = median(with);
  std::size_t points = 0;
  int steps = 0, factorisations = 0;
  double residual = 0.0;
  for (const LoadedPosition& position : cycle.positions) {
    points += static_cast<std::size_t>(position.load.line_load.size());
    steps += position.load.iterations;
    factorisations += position.load.factorisations;
    residual = std::max(residual, position.load.kkt_residual);
  }
  std::printf(
      "cycle%-18s %4.1f points, %.1f Newton steps, %.1f factorisations a position, residual %.0e\n"
      "                        %7.3f ms, with eight gradients %7.3f ms, of which gradients %4.1f %%\n",
      root_stress ? " with root stress" : "", static_cast<double>(points) / positions, static_cast<double>(steps) / positions,
      static_cast<double>(factorisations) / positions, residual, plain, with_gradients, median(shares));
  if (!cycle.usable() || std::isnan(sum)) std::printf("  NOT SOLVED at %d positions\n", cycle.failures);
}

std::vector<LoadProblem> programmes_of_cycle(int per_line) {
  const MeshModel model = load_scene::model(positions, per_line, false);
  const FlankCondition condition = load_scene::condition();
  std::vector<LoadProblem> problems;
  for (const MeshPosition& at : model.positions) {
    problems.push_back(
        {at.influence, at.weight, plane_of_action_gap(model.pair, at.points, condition).total, at.laws, model.normal_force(load_scene::torque)});
  }
  return problems;
}

void report_references(int per_line, int repetitions) {
  const std::vector<LoadProblem> problems = programmes_of_cycle(per_line);
  Eigen::Index points = 0;
  for (const LoadProblem& problem : problems) points += problem.gap.size();
  std::printf("the %d programmes of a cycle, %.1f points each, each from an even load, at equal natural residual\n", positions,
              static_cast<double>(points) / positions);
  double residual = 0.0;
  const auto own = [&](double tolerance) {
    return time_of(repetitions, [&] {
      residual = 0.0;
      for (const LoadProblem& problem : problems) {
        const LoadDistribution found = solve_load_distribution(problem, {.tolerance = tolerance, .max_iterations = 100});
        residual = std::max(residual, reference_solvers::natural_residual(problem, found.line_load));
      }
    });
  };
  const double tight = own(1e-12);
  std::printf("  this solver     %9.3f ms a cycle, residual %.0e\n", tight, residual);
  const auto reference = [&](const char* name, reference_solvers::Answer (*solve)(const LoadProblem&)) {
    double callbacks = 0.0, worst = 0.0;
    int evaluations = 0;
    const double total = time_of(std::max(1, repetitions / 10), [&] {
      worst = callbacks = 0.0;
      evaluations = 0;
      for (const LoadProblem& problem : problems) {
        const reference_solvers::Answer answer = solve(problem);
        worst = std::max(worst, reference_solvers::natural_residual(problem, answer.line_load));
        callbacks += answer.callback_ms;
        evaluations += answer.evaluations;
      }
    });
    const double equal = own(std::max(1e-12, 0.1 * worst));
    std::printf(
        "  %-15s %9.3f ms a cycle, residual %.0e, %5.1f gradients each, %9.3f ms outside callbacks\n"
        "    this solver   %9.3f ms a cycle, residual %.0e: %.0f times as fast, %.0f times as the other's own work alone\n",
        name, total, worst, static_cast<double>(evaluations) / positions, total - callbacks, equal, residual, total / equal,
        (total - callbacks) / equal);
  };
  reference("Ipopt", reference_solvers::solve_by_ipopt);
  reference("NLopt SLSQP", reference_solvers::solve_by_slsqp);
}

/// Lines of the 18/54 pair's size, finer and finer: a smooth kernel over n points, gaps of a crowned and misaligned flank.
LoadProblem refined_problem(Eigen::Index n) {
  load_cases::Random random(7);
  LoadProblem problem;
  const double length = 400.0;  // mm of contact line
  problem.weight = Eigen::VectorXd::Constant(n, length / static_cast<double>(n));
  const Eigen::VectorXd z = Eigen::VectorXd::LinSpaced(n, 0.0, length);
  problem.influence =
      Eigen::MatrixXd::NullaryExpr(n, n, [&](Eigen::Index i, Eigen::Index j) { return 4e-7 * std::exp(-std::abs(z[i] - z[j]) / 20.0) + 2e-8; });
  problem.gap = z.unaryExpr([&](double s) { return 0.012 * std::pow(s / length - 0.4, 2) + 0.004 * std::sin(s / 15.0); });
  problem.laws = load_cases::random_laws(n, random);
  problem.force = 12000.0;
  return problem;
}

/// The most memory this process has held [MB]; problems grow, so that it is the last one's.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void report_growth(int repetitions) {
  std::printf("one solve by number of points\n");
  double last_time = 0.0, last_n = 0.0, first_time = 0.0, first_n = 0.0;
  for (const Eigen::Index n : {10, 20, 50, 100, 200, 500, 1000, 2000}) {
    if (repetitions == 1 && n > 200) break;
    const LoadProblem problem = refined_problem(n);
    LoadDistribution found;
    const int times = n >= 1000 ? 1 : repetitions;
    const double time = time_of(times, [&] { found = solve_load_distribution(problem); });
    const double mean_exponent = first_time > 0.0 ? std::log(time / first_time) / std::log(static_cast<double>(n) / first_n) : 0.0;
    const double exponent = last_time > 0.0 ? std::log(time / last_time) / std::log(static_cast<double>(n) / last_n) : 0.0;
    std::printf("  %5td points %10.3f ms, %2d Newton steps, %3d factorisations, %4td loaded, %5.0f MB, exponent %.2f (from 10 points %.2f)\n",
                static_cast<std::ptrdiff_t>(n), time, found.iterations, found.factorisations,
                static_cast<std::ptrdiff_t>((found.line_load.array() > 0.0).count()), peak_memory(), exponent, mean_exponent);
    last_time = time;
    last_n = static_cast<double>(n);
    if (first_time == 0.0) {
      first_time = time;
      first_n = last_n;
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int repetitions = argc > 1 ? std::max(1, std::atoi(argv[1])) : 31;
  report_cycle(false, repetitions);
  report_cycle(true, repetitions);
  report_references(intervals, repetitions);
  report_growth(repetitions);
}
