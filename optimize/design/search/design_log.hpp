#pragma once

#include <functional>
#include <vector>

#include "optimize/design/problem/design_problem.hpp"

namespace flankwright {

/// Best design met so far and every analysis on the way, judged by the true outputs rather than by a programme's candidates.
class DesignLog {
 public:
  /// Called after each new analysis with (analyses so far, best feasible objective so far: NaN where none).
  using Progress = std::function<void(int, double)>;
  explicit DesignLog(Progress progress) : progress_(std::move(progress)) {}

  /// Judges an analysis of design x; the same design twice in a row is one entry.
  void record(const DesignProblem& problem, const Eigen::VectorXd& x, const DesignAnalysis& analysis);

  struct Entry {
    Eigen::VectorXd x;
    double objective{not_given};             ///< DesignProblem::objective(), outside units
    double constraint_violation{not_given};  ///< DesignProblem::violation() [-]
  };
  const std::vector<Entry>& entries() const { return entries_; }
  /// Feasible (violation <= tolerance) with the least objective, else the least violation; nullptr where nothing was recorded.
  const Entry* best() const { return best_ < 0 ? nullptr : &entries_[static_cast<std::size_t>(best_)]; }
  /// A relative excess over a bound that is still called feasible [-].
  static constexpr double tolerance = 1e-6;
  /// A relative excess over a bound, or 0 where it is still called feasible [-].
  static constexpr double beyond_tolerance(double excess) { return excess > tolerance ? excess : 0.0; }

 private:
  Progress progress_;
  std::vector<Entry> entries_;
  int best_{-1};
};

/// Whether design a is nearer to keeping everything than b: first by the limits on modifications, which every load leaves as they are and a search can
/// always keep where any design does, then by DesignProblem::violation().
bool is_nearer(const DesignProblem& problem, const DesignAnalysis& a, const DesignAnalysis& b);

}  // namespace flankwright
