#pragma once

#include <vector>

#include "optimize/assessment/compared_design.hpp"
#include "optimize/design/two_level.hpp"
#include "studies/analysis/study_run.hpp"

namespace flankwright::studies {

/// The search of an optimisation: from coarse to fine, until the design is the optimum of what an analysis of it would show.
class OptimiseSearch {
 public:
  explicit OptimiseSearch(StudyRun& run);

  /// What is searched, with the limits that the study asks for, at the resolution that has been reached.
  const DesignTask& task() const { return task_; }

  /// Searches from all starts, takes as many positions and intervals as the design needs, and chooses what can be ground.
  /// @param problem  of task(); afterwards at the resolution that was reached, and with limits that keep those of the study where they are seen more finely
  TwoLevelDesign find(DesignProblem& problem, const DesignOptions& options);

  /// By how much a design exceeds the constraint that it exceeds most [-, relative to the limit]; below 0: it keeps all.
  double excess_of(const DesignReport& report) const;

  /// A scene with the modifications of a design.
  DesignScene scene_of(const DesignAnalysis& analysis, int s) const;

  /// What lies between the positions of a design, for each load case; with the errors of its figures where asked for.
  std::vector<ResolvedCycle> resolved_cycles(const DesignProblem& problem, const DesignAnalysis& analysis, bool with_errors);

 private:
  /// The listed ones and those drawn from tolerances.
  std::vector<DesignScene> all_scenes() const;
  DesignTask design_task();
  /// Of an accuracy that asks for finite elements: the fitted compliance, whose optima lie near theirs.
  std::shared_ptr<const PairCompliance> structure_to_search_by() const;
  /// A design as it is shown, with what lies between the positions.
  DesignReport shown_between_positions(const DesignProblem& problem, const DesignReport& report);
  /// Whether the positions see too little of a design. Between them the objective, or the value of a constraint that is exceeded, rises by more than the accuracy for
  /// which an analysis chooses its positions. Where no design keeps the constraints, the excess takes the objective's place.
  bool rises_between_positions(const DesignReport& at_positions, const DesignReport& shown, bool infeasible) const;
  /// A search at few positions may leave a peak between them, such as that of an edge which a hundredth of a micrometre of relief keeps from touching. It goes
  /// on at twice the positions then, unless the design rounded to the steps that can be ground has no such peak.
  void take_more_positions(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found);
  /// The scaled design x rounded to what can be ground; nothing where rounding leaves it as it is. An optimum often lies where a tip edge only just stays clear, and the
  /// next step keeps it clear: what is ground needs no finer search then.
  std::optional<DesignReport> ground_of(DesignProblem& problem, const DesignOptions& options, const Eigen::VectorXd& x, TwoLevelDesign& found);
  /// A search with few points along the contact lines may see a transmission error, or an order of the scenes, that more points do not. It goes on with twice
  /// the intervals then, up to those of an analysis, unless the design rounded to the steps that can be ground is seen well enough.
  /// @returns by how much still more intervals change the constraints, as FinerLook has it; empty where that is not known
  std::vector<double> take_more_intervals(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found);
  /// Where the study asks for an accuracy, the figures of the best design are to keep it: while they do not, it is seen at the resolution of refine_resolution(), and the search
  /// goes on there unless that is_confirmed().
  void keep_accuracy(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found);
  /// Whether the figures of a design do not keep the accuracy and a finer resolution may. It is the study's and that of task() then.
  bool needs_finer_resolution(const DesignProblem& problem, const DesignReport& report);
  /// Whether a design is seen as the search saw it at a resolution that has changed: is_turned() by the accuracy is false, and it keeps the limits. `problem` and what was found
  /// are of the changed resolution then. Lists of objectives are never, as each of their objectives has a limit by the resolution that it was found with.
  bool is_confirmed(DesignProblem& problem, const Eigen::VectorXd& x, TwoLevelDesign& found);
  /// What is ground may be known less well than the optimum before it was rounded. Where the study asks for an accuracy, it is shown at a resolution that keeps it, without another
  /// search.
  void show_accurately(DesignProblem& problem, TwoLevelDesign& found);
  bool may_look_finer() const;
  /// Continues from a design, or from optima beside it, at a resolution that has changed.
  void go_on_at_resolution(DesignProblem& problem, const DesignOptions& options, const Eigen::VectorXd& x, TwoLevelDesign& found);
  /// A search may get stuck at a design that is worse than a rule of thumb. Where the best rule within the bounds of the variables is better, or keeps constraints that no design found
  /// keeps, the search goes on from there. Lists of objectives are left out as for take_better_usual_design().
  void take_better_rule(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found);
  /// Those of designs that may be better than the one found: where the worst load case counts, by that of the design found.
  std::vector<NamedDesign> promising(const DesignProblem& problem, const std::vector<NamedDesign>& designs, const DesignReport& found) const;
  /// Takes what the search finds from a scaled design, if that is better.
  void go_on_from_better(DesignProblem& problem, const DesignOptions& options, const Eigen::VectorXd& x, TwoLevelDesign& found);
  /// A search may get stuck at a design that is seldom ground. Where the best design within the limits that flanks have as a rule is better, the search goes on
  /// from there. A list of objectives is left out, because each of its objectives has a limit from the ones before.
  void take_better_usual_design(DesignProblem& problem, const DesignOptions& options, TwoLevelDesign& found);
  /// Constraints that are kept at the positions may be exceeded between them, or with more intervals along the contact lines. They are then asked for at the positions with as much
  /// to spare, and the search goes on from there; `problem` has these limits afterwards. A limit that would fall to 0 stays as it is. Of
  /// all designs met, the one is kept that exceeds the constraints least as it is seen more finely. Nothing to do where no design keeps the constraints at all.
  /// @param by_intervals  of the design found, see take_more_intervals()
  void keep_constraints_where_finer(DesignProblem& problem, const DesignOptions& options, std::vector<double> by_intervals, TwoLevelDesign& found);
  /// Whether it still exceeds a limit that it keeps at the positions: no limit there was tight enough, see keep_limits_between_positions().
  bool exceeds_between_positions(const DesignProblem& problem, const TwoLevelDesign& found);
  /// Per constraint the excess of a design with what more intervals would add to it; what they would take from it is left out.
  /// @param shown         with what lies between the positions
  /// @param by_intervals  FinerLook::excess_changes
  std::vector<double> finer_excesses(const DesignReport& shown, const std::vector<double>& by_intervals) const;

  StudyRun& run_;
  StudyResults& results_;
  DesignTask task_;
};

}  // namespace flankwright::studies
