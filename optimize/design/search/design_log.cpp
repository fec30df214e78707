#include "optimize/design/search/design_log.hpp"

#include <algorithm>

namespace flankwright {

bool is_nearer(const DesignProblem& problem, const DesignAnalysis& a, const DesignAnalysis& b) {
  const auto broken = [&](const DesignAnalysis& of) { return std::max(0.0, problem.violation(of.modification) - DesignLog::tolerance); };
  if (broken(a) != broken(b)) return broken(a) < broken(b);
  return problem.violation(a) < problem.violation(b);
}

void DesignLog::record(const DesignProblem& problem, const Eigen::VectorXd& x, const DesignAnalysis& analysis) {
  if (!entries_.empty() && entries_.back().x == x) return;
  const Entry entry{x, problem.objective(analysis), problem.violation(analysis)};
  entries_.push_back(entry);
  const auto worse = [](const Entry& a, const Entry& b) {  // a is worse than b
    const bool fa = a.constraint_violation <= tolerance, fb = b.constraint_violation <= tolerance;
    if (fa != fb) return fb;
    return fa ? b.objective < a.objective : b.constraint_violation < a.constraint_violation;
  };
  if (best_ < 0 || worse(*best(), entry)) best_ = static_cast<int>(entries_.size()) - 1;
  const bool is_kept = best()->constraint_violation <= tolerance;
  if (progress_) progress_(static_cast<int>(entries_.size()), is_kept ? best()->objective : not_given);
}

}  // namespace flankwright
