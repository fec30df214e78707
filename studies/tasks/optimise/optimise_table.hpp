#pragma once

#include <optional>
#include <vector>

#include "optimize/design/problem/design_task.hpp"
#include "optimize/solvers/solver_options.hpp"
#include "studies/tasks/optimise/assessment_table.hpp"
#include "studies/tasks/optimise/scatter_table.hpp"

namespace flankwright::studies {

/// [optimise]
struct OptimiseTable {
  std::vector<ObjectiveTerm> objective;
  Aggregation over;
  SolverOptions solver{.name = "nlopt:slsqp", .progress = {}, .stop_when = {}};
  std::vector<DesignVariable> variables;
  std::vector<OutputConstraint> constraints;
  std::vector<LinkingConstraint> links;
  std::vector<ModificationConstraint> modification_constraints;
  std::vector<Objective> later_objectives;  ///< later objectives of a list
  double lexicographic_tolerance{0.01};
  double edge_margin{0.05};
  double step{0.0};  ///< of variables that have none of their own [mm]; amounts only
  int starts{1};
  std::vector<Objective> pareto_objectives;  ///< empty: no front
  int pareto_points{9};
  AssessmentTable assessment;
  ScatterTable scatter;
  GrindableAmounts grindable;
  std::optional<double> largest_amount;   ///< that can be ground [mm]
  std::optional<double> steepest_relief;  ///< that can be ground [um/mm]

  /// What the search changes: variables and what is tied to them.
  std::vector<DesignVariable> varied() const {
    std::vector<DesignVariable> all = variables;
    for (const LinkingConstraint& link : links) all.push_back(link.linked);
    return all;
  }
};

}  // namespace flankwright::studies
