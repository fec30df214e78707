#pragma once

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

/// One design over fresh draws.
struct FreshDesign {
  ValidatedDesign design;
  double statistic{not_given};  ///< over the draws that could be analysed, outside units
};

/// The right design of one tolerance class, and what the class costs. Statistics are over the draws of that class. It does not depend on which other classes
/// are asked for, and that of the study's own class is the study's.
struct ClassDesign {
  int tolerance_class{0};
  ScatterDesign design;
  double without_scatter{not_given};  ///< statistic of the objective of the design without scatter
  double contact_stress{not_given};   ///< statistic of the peak contact stress of `design` [MPa]; where that is the objective, `design.value`
  double te{not_given};               ///< of the transmission error, peak to peak, likewise [um]
};

/// [optimise.scatter], run.
struct ScatterResult {
  ScatterDesign design;
  double search_seconds{not_given};             ///< of the search without scatter, over the listed scenes, that came before
  std::vector<double> without;                  ///< variables of the design without scatter [mm; parabolic_te 1/rad]
  double without_value{not_given};              ///< its statistic over the draws
  std::vector<std::vector<DesignScene>> draws;  ///< of each drawn pair of gears in its housing the load cases of all operating states
  std::vector<OperatingState> states;           ///< each of which every draw runs through
  PredictedStatistic predicted;                 ///< of `design`, from draws that its search has not seen; NaN where none were asked for
  std::vector<FreshDesign> fresh;               ///< "before", "without scatter", "after"; empty: not asked for
  std::vector<ClassDesign> classes;
  double fresh_seconds{not_given}, classes_seconds{not_given};

  /// What was predicted of `after` beside its statistic over the fresh draws, and what it is over the draws searched beside it, relative [-]; NaN without
  /// fresh draws.
  double prediction_error() const { return fresh.empty() ? not_given : predicted.value / fresh.back().statistic - 1.0; }
  double search_error() const { return fresh.empty() ? not_given : design.value / fresh.back().statistic - 1.0; }
};

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
