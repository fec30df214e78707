#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "optimize/design/search/design_log.hpp"
#include "optimize/design/search/objective_block.hpp"
#include "optimize/solvers/nonlinear_program.hpp"

namespace flankwright {

/// A row of an EpigraphProgram in terms of the design.
struct EpigraphRow {
  enum class Kind {
    Floor,            ///< candidate <= u of an objective's output in a scene
    Ceiling,          ///< u <= candidate, where the objective falls with u
    OutputBound,      ///< an OutputConstraint
    ObjectiveHelper,  ///< a row of ObjectiveBlock
    ObjectiveBound,
    ScalarisedObjective,
    ModificationBound
  };
  Kind kind{Kind::Floor};
  int scene{-1};      ///< -1: none
  int index{-1};      ///< of the term within its objective, or of the constraint, bound or scalarised objective
  int objective{-1};  ///< of Floor, Ceiling and ObjectiveHelper: block
  PeakCandidate candidate{};
  int side{1};  ///< ModificationBound: 1 maximum, -1 minimum

  auto operator<=>(const EpigraphRow&) const = default;
};

/// The design task as an epigraph: every peak becomes a variable u that may not lie below its candidates,
///
///     minimise  f(u)   subject to   candidate_j(x) <= u_sk (all leading candidates j of output k in scene s),
///                                   rows of the goals (ObjectiveBlock),   bounds on outputs, goals and modifications,
///
/// so that a solver sees smooth functions only, f being the objective's value or tau >= (value - origin) / range of
/// every scalarised objective. Candidates are those near a peak at the designs given to add_candidates();
/// optimise_design() repeats until no other candidate rises above them. Exact where f grows with every u: all but mean
/// + k sigma. Where that falls with a scene's u, the scene's leading candidate at the last restart bounds u from above
/// instead: a majorant, exact at that design, so that rounds descend. So does a quantile, whose block
/// leaves out the scenes beyond it at the last restart. A least value of an output is likewise asked of
/// its leading candidate at the last restart, which is sufficient.
class EpigraphProgram : public NonlinearProgram {
 public:
  EpigraphProgram(DesignProblem& problem, DesignLog& log);

  /// Adds the leading candidates at design x (scaled); returns how many were new.
  int add_candidates(const Eigen::VectorXd& x);
  /// Designs start here from now on, with every u at its peak.
  void restart_from(const Eigen::VectorXd& x);
  Eigen::VectorXd design(const Eigen::VectorXd& y) const { return y.head(problem_.variables()); }
  /// The task's objective in outside units, as the programme's objective sees it, and back: see ObjectiveBlock.
  double seen(double objective) const { return is_scalarised() ? objective : blocks_.front().seen(objective); }
  Slope objective_of(double seen) const { return is_scalarised() ? Slope{seen, 1.0} : blocks_.front().objective_of(seen); }
  /// Whether rows hold that bound from above by a leading candidate: the programme is then no better than the task elsewhere.
  bool is_majorant() const;
  /// What each constraint of the programme is, in their order.
  const std::vector<EpigraphRow>& rows() const { return rows_; }
  /// What the rows alone make of a design: it is better than it is where a peak has no candidate among them.
  struct SeenByRows {
    double objective{not_given};  ///< as seen() has it
    double violation{not_given};  ///< as DesignProblem::violation() has it, at least 0 [-]
  };
  /// Of the last evaluation; NaN where there is none since the rows were chosen, and of a majorant, whose rows are to see other peaks than the task.
  const SeenByRows& seen_by_rows() const { return seen_by_rows_; }
  /// Change of each row at the last evaluation by its output, of Floor, Ceiling and OutputBound [1/inside unit]; 0 of other rows.
  const std::vector<double>& by_output() const { return by_output_; }

  int variables() const override { return variables_; }
  int constraints() const override { return static_cast<int>(rows_.size()); }
  Eigen::VectorXd lower() const override;
  Eigen::VectorXd upper() const override;
  Eigen::VectorXd start() const override { return start_; }
  ProgramValues evaluate(const Eigen::VectorXd& y, bool with_gradients) override;

 private:
  bool is_scalarised() const { return !problem_.task().scalarisation.empty(); }
  int objectives_minimised() const { return is_scalarised() ? static_cast<int>(problem_.task().scalarisation.size()) : 1; }
  const ObjectiveTerm& term_of(const EpigraphRow& row) const;
  void write_row(const EpigraphRow& row, int at, const Eigen::VectorXd& y, const DesignAnalysis& analysis, ProgramValues& values);
  /// @param excess  of an objective's value in outside units, as the row has it
  void write_objective(int at, const ObjectiveBlock& block, const Eigen::VectorXd& y, const std::function<Slope(double)>& excess,
                       ProgramValues& values) const;
  void choose_rows(const DesignAnalysis& analysis);
  SeenByRows judged_by_rows(const Eigen::VectorXd& y, const ProgramValues& values) const;

  DesignProblem& problem_;
  DesignLog& log_;
  std::vector<ObjectiveBlock> blocks_;  ///< what is minimised, then what is bounded
  std::set<EpigraphRow> candidates_;    ///< floors and upper output bounds met so far
  std::vector<EpigraphRow> rows_;
  std::vector<double> by_output_;
  SeenByRows seen_by_rows_;
  int variables_{0};
  Eigen::VectorXd start_;
};

}  // namespace flankwright
