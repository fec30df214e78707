#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "optimize/assessment/predicted_statistic.hpp"
#include "optimize/assessment/validation.hpp"
#include "optimize/design/design_optimiser.hpp"
#include "optimize/design/scatter/scatter_search.hpp"
#include "studies/base/progress.hpp"
#include "studies/study/study.hpp"
#include "studies/tasks/optimise/drawn_scenes.hpp"

namespace flankwright::studies {

/// A part of the 1 % that thousands of draws do not tell apart [-]: what a search that begins again has to gain, and by how much a prediction may exceed a limit
/// before the search goes on, and in the end.
inline constexpr double told_apart = 2.5e-3;

/// One design over fresh draws.
struct FreshDesign {
  ValidatedDesign design;
  double statistic{not_given};  ///< over the draws that could be analysed, outside units
};

/// A design found over draws, and what further draws that its search has not seen predict of it. Over the draws searched a design is the best of many: its own
/// statistic is too low there, and so is that of a limit it was led up to. Where the prediction exceeds a limit, the search went on with that limit lower by as much.
struct PredictedDesign {
  ScatterDesign design;
  PredictedStatistic predicted{};  ///< of the objective; NaN where no prediction was asked for
  std::vector<PredictedStatistic>
      predicted_limits{};                 ///< of the output of each constraint, of a lower limit of the reciprocal; empty where none was asked for
  std::vector<double> searched_limits{};  ///< which the search kept to, of each constraint, outside units; of a lower limit of the reciprocal

  /// The best known statistic of the objective, outside units: what is predicted, or that over the draws searched where nothing is.
  double statistic() const { return std::isnan(predicted.value) ? design.value : predicted.value; }
};

/// The right design of one tolerance class, and what the class costs. Statistics are over draws of that class, those of the prediction where there is one. It does not depend on which other
/// classes are asked for, and that of the study's own class is the study's.
struct ClassDesign : PredictedDesign {
  int tolerance_class{0};
  double without_scatter{not_given};  ///< statistic of the objective of the design without scatter
  double contact_stress{not_given};   ///< statistic of the peak contact stress of `design` [MPa]
  double te{not_given};               ///< of the transmission error, peak to peak, likewise [um]
};

/// [optimise.scatter], run.
struct ScatterResult : PredictedDesign {
  double search_seconds{not_given};             ///< of the search without scatter, over the listed scenes, that came before
  std::vector<double> without;                  ///< variables of the design without scatter [mm; parabolic_te 1/rad]
  double without_value{not_given};              ///< its statistic over the draws of the search
  PredictedStatistic without_predicted{};       ///< of it, from the draws of the prediction
  std::vector<std::vector<DesignScene>> draws;  ///< of each drawn pair of gears in its housing the load cases of all operating states
  std::vector<OperatingState> states;           ///< each of which every draw runs through
  std::vector<FreshDesign> fresh;               ///< "before", "without scatter", "after"; empty: not asked for
  std::vector<ClassDesign> classes;
  double prediction_seconds{not_given}, fresh_seconds{not_given}, classes_seconds{not_given};

  /// What was predicted of `after` beside its statistic over the fresh draws, and what it is over the draws searched beside it, relative [-]; NaN without
  /// fresh draws.
  double prediction_error() const { return fresh.empty() ? not_given : predicted.value / fresh.back().statistic - 1.0; }
  double search_error() const { return fresh.empty() ? not_given : design.value / fresh.back().statistic - 1.0; }
};

/// What a statistic that bound_on() bounds says of the output itself: of a lower limit it is the reciprocal.
inline double of_output(const OutputConstraint& constraint, double statistic) { return constraint.is_least() ? 1.0 / statistic : statistic; }

/// Whether an output is the objective by itself.
bool is_objective(const DesignTask& task, Output output);

/// Variables [mm; parabolic_te 1/rad] of what a search had scaled.
std::vector<double> unscaled(const Eigen::VectorXd& x, const DesignTask& task);

/// Load cases of drawn scenes, as StudyRun::loaded().
using LoadCases = std::function<std::vector<DesignScene>(const std::vector<Scene>&)>;

/// Searches over draws from the design that the listed scenes gave.
/// @param task   of the listed scenes
/// @param found  its result
ScatterResult run_scatter(const Study& study, const DesignTask& task, const DesignResult& found, const LoadCases& load_cases,
                          const ProgressReport& progress);

}  // namespace flankwright::studies
