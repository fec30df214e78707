#include "optimize/design/search/multi_start.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>
#include <random>

namespace flankwright {

namespace {

/// Bases of the Halton sequence; more variables than these take up the first again, with a shift of their own.
constexpr std::array bases{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53};

/// The digits of i in a base mirrored at the point [-], 0 .. 1.
double radical_inverse(int i, int base) {
  double value = 0.0, digit = 1.0;
  for (; i > 0; i /= base) {
    digit /= base;
    value += digit * (i % base);
  }
  return value;
}

bool better(const LocalRun& a, const LocalRun& b) {
  const bool fa = a.constraint_violation <= DesignLog::tolerance, fb = b.constraint_violation <= DesignLog::tolerance;
  if (fa != fb) return fa;
  if (fa) return a.objective < b.objective;
  return a.constraint_violation < b.constraint_violation;  // false where a never got anywhere (NaN)
}

}  // namespace

std::vector<Eigen::VectorXd> space_filling_starts(const Eigen::VectorXd& first, int count, unsigned long seed) {
  std::mt19937_64 generator(seed);
  Eigen::VectorXd shift(first.size());
  for (double& s : shift) s = static_cast<double>(generator() >> 11U) * 0x1.0p-53;  // the same on every library
  std::vector<Eigen::VectorXd> starts{first};
  for (int i = 1; i < count; ++i) {
    Eigen::VectorXd x(first.size());
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      const double moved = radical_inverse(i, bases[static_cast<std::size_t>(k) % bases.size()]) + shift[k];
      x[k] = moved - std::floor(moved);
    }
    starts.push_back(x);
  }
  return starts;
}

std::vector<LocalRun> run_from(const DesignProblem& problem, const SolverOptions& options, const std::vector<Eigen::VectorXd>& starts) {
  std::vector<LocalRun> runs(starts.size());
  std::mutex reporting;
  int analyses = 0;
  double best = not_given;
  tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t i) {
    SolverOptions own = options;
    own.max_evaluations = std::max(1, options.max_evaluations / static_cast<int>(starts.size()));
    own.seed = options.seed + i;
    if (options.progress) {
      own.progress = [&](int, double objective) {
        const std::lock_guard lock(reporting);
        best = std::fmin(best, objective);
        options.progress(++analyses, best);
      };
    }
    DesignProblem copy = problem;
    copy.set_start(starts[i]);
    runs[i] = run_local(copy, own);
  });
  return runs;
}

std::vector<LocalRun> run_from_starts(const DesignProblem& problem, const SolverOptions& options, int count) {
  return run_from(problem, options, space_filling_starts(problem.start(), count, options.seed));
}

std::size_t best_run(const std::vector<LocalRun>& runs) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < runs.size(); ++i) {
    if (better(runs[i], runs[best])) best = i;
  }
  return best;
}

std::vector<LocalOptimum> distinct_optima(const std::vector<LocalRun>& runs, double same_objective) {
  std::vector<std::size_t> order(runs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return better(runs[a], runs[b]); });
  std::vector<LocalOptimum> optima;
  for (std::size_t i : order) {
    const bool ended_well = runs[i].status == SolverStatus::Converged || runs[i].status == SolverStatus::Stalled;
    if (!ended_well || !(runs[i].constraint_violation <= DesignLog::tolerance)) continue;
    const bool same =
        !optima.empty() && runs[i].objective - runs[optima.back().run].objective <= same_objective * std::abs(runs[optima.back().run].objective);
    if (same)
      ++optima.back().found_by;
    else
      optima.push_back({i, 1});
  }
  return optima;
}

}  // namespace flankwright
