#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optimize/design/problem/design_problem.hpp"
#include "optimize/design/grinding/grindable_design.hpp"
#include "optimize/design/search/local_run.hpp"
#include "optimize/design/search/multi_start.hpp"
#include "optimize/design/search/optimality.hpp"
#include "optimize/design/grinding/rounding.hpp"

namespace flankwright {

/// One design with what the task asks of it.
struct DesignReport {
  std::vector<double> variables;            ///< value of each design variable [mm]
  std::vector<double> linked;               ///< value of each linked modification [mm]
  double objective{not_given};              ///< outside units (MPa, um, N/mm; weighted sum for a table)
  std::vector<double> scene_measures;       ///< per scene, outside units
  std::vector<double> constraint_values;    ///< per constraint, nearest to its bound over the scenes, inside units
  std::vector<double> modification_values;  ///< per modification constraint [mm]
  std::vector<double> later_objectives;     ///< of a list, after the first, outside units
  DesignAnalysis analysis;

  double objective_of_stage(std::size_t k) const { return k == 0 ? objective : later_objectives[k - 1]; }  ///< of a list, from 0
  double last_objective() const { return objective_of_stage(later_objectives.size()); }
};

/// One of a list of objectives.
struct LexicographicStage {
  std::string name;
  double least{not_given};  ///< reached while those before it kept their limits, outside units
  double limit{not_given};  ///< it kept in the stages after it; NaN for the last
};

/// Increase of an objective as a share of what it was [-]; NaN where it has no meaning: from 0, or to more than `largest_increase` times more.
double relative_increase(double from, double to);
inline constexpr double largest_increase = 10.0;

/// Outcome of a design run.
struct DesignResult {
  SolverStatus status{SolverStatus::NotRun};
  std::string message{"optimise_design() was not called"};
  std::string solver, finisher;            ///< as asked for
  std::string finished_by;                 ///< LocalRun::finished_by of the run that `status` is of
  std::string formulation;                 ///< "epigraph" (smooth, exact gradients) or "direct" (values of the true peaks)
  DesignReport before;                     ///< the task's own modifications as given
  DesignReport after;                      ///< what is to be ground: the best design met, on the variables' steps where they have any
  std::optional<DesignReport> exact;       ///< the best design before choices and steps
  std::vector<GrindingChoice> choices;     ///< what of it could not be ground, and what was done
  Optimality optimality;                   ///< of the best design before choices and steps, by the last objective
  std::vector<LexicographicStage> stages;  ///< of a list of objectives; empty for one
  std::vector<LocalRun> runs;              ///< one a start, of the first objective
  std::vector<LocalOptimum> optima;        ///< the different ones among them, best first
  int evaluations{-1};                     ///< designs analysed, in all scenes or in those that decide: all starts, stages and rounding
  int gradient_evaluations{-1};            ///< of these, with derivatives
  int failures{-1};                        ///< analyses that did not converge; survived
  int rounds{-1};                          ///< of candidate generation (1 for "direct") in the best run
  double seconds{not_given};
  std::vector<SolverStep> history;  ///< one entry per analysis of the best run and the stages after it

  /// Two optima of which the better is lower by more than this share are different [-].
  static constexpr double same_objective = 1e-3;
  bool is_multimodal() const { return optima.size() > 1; }
  /// relative_increase() of the objective from the exact optimum by choices and steps; of a list, of its first; NaN without either.
  double rounding_loss() const { return exact ? relative_increase(exact->objective, after.objective) : not_given; }
  /// That by the choices alone; of a list, of the last objective, which alternatives are judged by; 0 without choices.
  double choice_loss() const {
    if (!exact || choices.empty()) return exact ? 0.0 : not_given;
    return relative_increase(exact->last_objective(), choices.back().tried[choices.back().taken].objective);
  }
};

/// Options of a run beyond those of its solver.
struct DesignOptions {
  SolverOptions solver;  ///< budgets are those of all starts together, and of the stages and the rounding after them
  int starts{1};         ///< >= 1
  /// Analyses of the search itself, without stages and rounding, >= 1; those of `solver` where that is less.
  int most_search_analyses{std::numeric_limits<int>::max()};
  /// Begins with the design that exceeds the constraints by least, because a run before met none that keeps them. The objective is searched only where that
  /// design keeps them.
  bool nearest_first{false};
  /// Whether a design is of use that exceeds the constraints, so that the nearest one is worth a search from several starts. Otherwise, limits that are exceeded are
  /// only sought to be kept from the best design met.
  bool shows_nearest{true};
  bool to_grind{true};  ///< false: the exact optimum is left as it is, without steps and grinding limits
};

/// Chooses the modifications of a task: from all starts (run_from_starts()), or, where none meets a design that keeps the constraints, the nearest one that
/// is found (seek_least_excess()); then the later objectives of a list from the best
/// design on, each under limits on those before it, then what can be ground of it (design_to_grind()).
/// @throws InvalidInput for an unknown solver or one that cannot take the task's constraints
DesignResult optimise_design(DesignProblem& problem, const DesignOptions& options);
inline DesignResult optimise_design(DesignProblem& problem, const SolverOptions& options) { return optimise_design(problem, DesignOptions{options}); }

/// What a result says where no design keeps the constraints.
/// @param excess  of this one over the constraint that it exceeds most [-, relative to the limit]
std::string message_of_excess(double excess);

/// What the optimality of a result is about: the problem itself, or of a list the last objective's, those before it at the limits they kept.
DesignProblem last_stage(const DesignProblem& problem, const std::vector<LexicographicStage>& stages);

/// Replaces the design of a result by what can be ground of it, see design_to_grind().
/// @param last  the problem of the last objective, see last_stage()
/// @param x     the design of the result, scaled
void choose_what_to_grind(DesignProblem& problem, DesignProblem& last, const Eigen::VectorXd& x, const SolverOptions& options, DesignResult& result);

/// A design as results show it.
DesignReport report_design(const DesignProblem& problem, DesignAnalysis analysis);

}  // namespace flankwright
