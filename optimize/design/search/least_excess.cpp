#include "optimize/design/search/least_excess.hpp"

#include <algorithm>

#include "core/base/stopwatch.hpp"
#include "optimize/design/search/multi_start.hpp"

namespace flankwright {

namespace {

/// A design where a search ended, as it is judged.
struct End {
  Eigen::VectorXd x;
  double broken;     ///< limits on modifications, beyond what counts as kept [-]
  double excess;     ///< over all limits [-]
  double objective;  ///< outside units
};

End end_of(DesignProblem& problem, const Eigen::VectorXd& x) {
  const DesignAnalysis& analysis = problem.analyse(x, false);
  return {x, DesignLog::beyond_tolerance(problem.violation(analysis.modification)), problem.violation(analysis), problem.objective(analysis)};
}

/// The excess that counts as the same as another by a share [-].
double as_large(double excess, double share) { return excess + share * (1.0 + excess); }

/// The nearest, see is_nearer(), or the one with the least objective of those with the same excess; the first of several.
const End& nearest_of(const std::vector<End>& ends) {
  const End* nearest = &ends.front();
  for (const End& end : ends) {
    if (end.broken < nearest->broken || (end.broken == nearest->broken && end.excess < nearest->excess)) nearest = &end;
  }
  const double same = nearest->excess <= DesignLog::tolerance ? DesignLog::tolerance : as_large(nearest->excess, same_excess);
  const End* chosen = nearest;
  for (const End& end : ends) {
    const bool is_as_near = end.broken == nearest->broken && end.excess <= same;
    if (is_as_near && end.objective < chosen->objective) chosen = &end;
  }
  return *chosen;
}

/// The searches with their budget, which they share one after the other.
class Search {
 public:
  Search(DesignProblem& problem, const Eigen::VectorXd& nearest, const SolverOptions& options)
      : problem_(problem), options_(options), by_excess_(problem.judged_by_excess()), ends_{end_of(problem, nearest)} {}

  LeastExcess run(const std::vector<Eigen::VectorXd>& others, bool with_objective) {
    by_excess_.set_start(ends_.front().x);
    const LocalRun first = run_local(by_excess_, left());
    take(first);
    found_.ended_well = first.status == SolverStatus::Converged || first.status == SolverStatus::Stalled;
    if (is_outside() && !is_spent() && !others.empty()) {
      for (const LocalRun& run : run_from(by_excess_, left(), others)) take(run);
    }
    if (with_objective && is_outside() && !is_spent()) improve_objective();
    const End& best = nearest_of(ends_);
    found_.x = best.x;
    found_.excess = best.excess;
    return std::move(found_);
  }

 private:
  bool is_spent() const { return found_.evaluations >= options_.max_evaluations || clock_.seconds() >= options_.max_seconds; }
  bool is_outside() const { return nearest_of(ends_).excess > DesignLog::tolerance; }

  SolverOptions left() const {
    SolverOptions left = options_;
    left.max_evaluations = std::max(1, options_.max_evaluations - found_.evaluations);
    left.max_seconds = std::max(1e-3, options_.max_seconds - clock_.seconds());
    if (options_.progress) {
      left.progress = [&, before = found_.evaluations](int analyses, double) { options_.progress(before + analyses, not_given); };
    }
    return left;
  }

  void take(const LocalRun& run) {
    found_.evaluations += run.evaluations;
    found_.failures += run.failures;
    const Eigen::VectorXd before = nearest_of(ends_).x;
    ends_.push_back(end_of(problem_, run.x));
    const End& best = nearest_of(ends_);
    if (best.x != before) found_.history.push_back({found_.evaluations, best.objective, best.excess});
  }

  /// The bounds are moved out by half of what counts as the same: what is called feasible there is then the same, DesignLog::tolerance included.
  void improve_objective() {
    const End nearest = nearest_of(ends_);
    DesignProblem within = problem_.with_wider_bounds(as_large(nearest.excess, 0.5 * same_excess));
    within.set_start(nearest.x);
    take(run_local(within, left()));
  }

  DesignProblem& problem_;
  const SolverOptions& options_;
  const Stopwatch clock_;
  DesignProblem by_excess_;
  std::vector<End> ends_;  ///< the start, then those of the searches
  LeastExcess found_;
};

}  // namespace

LeastExcess seek_least_excess(DesignProblem& problem, const Eigen::VectorXd& nearest, const LeastExcessOptions& options) {
  return Search(problem, nearest, options.solver).run(options.others, options.with_objective);
}

}  // namespace flankwright
