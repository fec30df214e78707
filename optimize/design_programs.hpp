#pragma once

#include <functional>
#include <set>
#include <vector>

#include "optimize/design_problem.hpp"
#include "optimize/nonlinear_program.hpp"

namespace flankwright {

/// Best design met so far and every analysis on the way, judged by the true outputs rather than by a programme's candidates.
class DesignLog {
 public:
  /// Called after each new analysis with (analyses so far, best feasible objective so far).
  using Progress = std::function<void(int, double)>;
  explicit DesignLog(Progress progress) : progress_(std::move(progress)) {}

  /// Judges an analysis of design x; the same design twice in a row is one entry.
  void record(const DesignProblem& problem, const Eigen::VectorXd& x, const DesignAnalysis& analysis);

  struct Entry {
    Eigen::VectorXd x;
    double objective{not_given};             ///< outside units
    double constraint_violation{not_given};  ///< max(0, value / maximum - 1) over the bounded outputs [-]
  };
  const std::vector<Entry>& entries() const { return entries_; }
  /// Feasible (violation <= tolerance) with the least objective, else the least violation; nullptr where nothing was recorded.
  const Entry* best() const { return best_ < 0 ? nullptr : &entries_[static_cast<std::size_t>(best_)]; }
  /// A relative excess over a bound that is still called feasible [-].
  static constexpr double tolerance = 1e-6;

 private:
  Progress progress_;
  std::vector<Entry> entries_;
  int best_{-1};
};

/// The design task as it stands: objective and bounded outputs of the true peaks. For derivative-free solvers; with gradients it
/// offers those of the leading candidate, a gradient wherever the maximum is smooth.
class DirectProgram : public NonlinearProgram {
 public:
  DirectProgram(DesignProblem& problem, DesignLog& log) : problem_(problem), log_(log) {}
  int variables() const override { return problem_.variables(); }
  int constraints() const override { return static_cast<int>(problem_.task().constraints.size()); }
  Eigen::VectorXd lower() const override { return Eigen::VectorXd::Zero(variables()); }
  Eigen::VectorXd upper() const override { return Eigen::VectorXd::Ones(variables()); }
  Eigen::VectorXd start() const override { return problem_.start(); }
  ProgramValues evaluate(const Eigen::VectorXd& x, bool with_gradients) override;

 private:
  DesignProblem& problem_;
  DesignLog& log_;
};

/// The design task as an epigraph: every peak becomes a variable u that may not lie below its candidates,
///
///     minimise  f(u)   subject to   candidate_j(x) <= u_sk (all leading candidates j of output k in scene s),
///                                   sum_k w_k u_sk <= t  (worst case of several outputs),   bounded outputs likewise,
///
/// so that a solver sees smooth functions only. Candidates are those near a peak at the designs given to
/// add_candidates(); optimise_design() repeats until no other candidate rises above them. Exact for Nominal, Worst and Mean, whose
/// value grows with every u; not for mean + 2 sigma, which may fall with one.
class EpigraphProgram : public NonlinearProgram {
 public:
  EpigraphProgram(DesignProblem& problem, DesignLog& log);

  /// Adds the leading candidates at design x (scaled); returns how many were new.
  int add_candidates(const Eigen::VectorXd& x);
  /// Designs start here from now on, with every u at its peak.
  void restart_from(const Eigen::VectorXd& x);
  Eigen::VectorXd design(const Eigen::VectorXd& y) const { return y.head(problem_.variables()); }
  /// The task's objective in outside units is the programme's times this.
  double objective_scale() const { return objective_scale_; }

  int variables() const override;
  int constraints() const override;
  Eigen::VectorXd lower() const override;
  Eigen::VectorXd upper() const override;
  Eigen::VectorXd start() const override { return start_; }
  ProgramValues evaluate(const Eigen::VectorXd& y, bool with_gradients) override;

 private:
  struct Row {
    int scene;
    int term;  ///< index into the objective, or -1 - index into the constraints
    PeakCandidate candidate;
    auto operator<=>(const Row&) const = default;
  };
  const ObjectiveTerm& term_of(const Row& row) const;
  bool is_bound(const Row& row) const { return row.term < 0; }
  int auxiliary(int scene, int term) const;  ///< index of u_sk in y
  bool shares_one_bound() const;             ///< worst case of a single output: u is the worst case itself
  bool has_worst_row() const;
  int considered_scenes() const { return problem_.task().over == Aggregate::Nominal ? 1 : problem_.scenes(); }
  double peak(const DesignAnalysis& analysis, int scene, int term) const;

  DesignProblem& problem_;
  DesignLog& log_;
  std::set<Row> rows_;
  std::vector<double> reference_;  ///< per objective term: u is counted in units of this peak at the start
  double objective_scale_{1.0};
  Eigen::VectorXd start_;
};

}  // namespace flankwright
