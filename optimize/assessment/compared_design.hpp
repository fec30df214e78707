#pragma once

#include <string>
#include <vector>

#include "optimize/design/problem/design_problem.hpp"

namespace flankwright {

/// A design to be held against the optimum.
struct NamedDesign {
  std::string name;
  std::string basis;  ///< the rule it follows, with its source, or where it comes from
  PerGear<Modification> modification;
};

/// The result of a design over the scenes of a task.
struct ComparedDesign {
  NamedDesign design;
  double objective{not_given};               ///< outside units
  double constraint_violation{not_given};    ///< DesignProblem::violation() [-]
  double modification_violation{not_given};  ///< its part by limits on modifications [-]
  std::vector<double> scene_measures;        ///< per scene, outside units
  int intervals{0};                          ///< of a full contact line, which it was analysed with
  std::string failure;                       ///< why it could not be analysed; empty: it was

  /// Analysed, and no bound exceeded by more than DesignLog::tolerance.
  bool feasible() const;
};

/// Analyses designs over the scenes of a task, many at a time; the same bits whatever the number of threads. A design whose load
/// distribution does not converge is kept with its failure.
std::vector<ComparedDesign> compare_designs(const DesignProblem& problem, const std::vector<NamedDesign>& designs);

/// The same with the coarse resolution of a search, see coarser(), where the task allows one. The best design, or the one nearest to keeping the constraints,
/// is analysed again at the task's own resolution. This is repeated until the best design is one that was. The others keep their coarse figures.
std::vector<ComparedDesign> compare_designs_by_two_levels(const DesignProblem& problem, const std::vector<NamedDesign>& designs);

/// The feasible design of least objective, the first of equals; null where none is feasible.
const ComparedDesign* best_of(const std::vector<ComparedDesign>& designs);

}  // namespace flankwright
