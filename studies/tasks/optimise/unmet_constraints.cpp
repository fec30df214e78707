#include "studies/tasks/optimise/unmet_constraints.hpp"

#include <fmt/format.h>

#include "optimize/design/search/design_log.hpp"
#include "studies/base/plain_names.hpp"
#include "studies/tasks/optimise/scatter_json.hpp"

namespace flankwright::studies {

std::vector<std::string> violated_constraints(const DesignProblem& problem, const OptimiseTable& asked, const DesignReport& design) {
  std::vector<std::string> unmet;
  for (std::size_t c = 0; c < asked.constraints.size(); ++c) {
    const OutputConstraint& constraint = asked.constraints[c];
    const double value = design.constraint_values[c];
    if (!(constraint.excess(value) > DesignLog::tolerance)) continue;
    const double factor = constraint.output.outside_factor();
    unmet.push_back(fmt::format("the constraint {} {} {:.4g} is violated: {:.4g}{}", constraint.output.name, constraint.is_least() ? ">=" : "<=",
                                constraint.limit() * factor, value * factor, behind_number(constraint.output.unit())));
  }
  for (std::size_t c = 0; c < asked.modification_constraints.size(); ++c) {
    const ModificationConstraint& constraint = asked.modification_constraints[c];
    const double value = design.modification_values[c];
    const double slack = DesignLog::tolerance * problem.modification_scale(constraint);
    if (value <= constraint.maximum + slack && value >= constraint.minimum - slack) continue;
    const bool is_above = value > constraint.maximum;
    const double limit = is_above ? constraint.maximum : constraint.minimum, factor = constraint.outside_factor();
    if (constraint.grinding == GrindingLimit::Slope) {
      unmet.push_back(fmt::format("the constraint on {} is violated: for its extent the amount is {:.4g} {} too large", constraint.name,
                                  (value - limit) * factor, constraint.unit()));
      continue;
    }
    unmet.push_back(fmt::format("the constraint on {} {} {:.4g} is violated: {:.4g} {}", constraint.name, is_above ? "<=" : ">=", limit * factor,
                                value * factor, constraint.unit()));
  }
  return unmet;
}

void add_unmet_by_design(const DesignProblem& problem, const OptimiseTable& asked, const DesignResult& design, std::vector<std::string>& unmet) {
  if (design.status != SolverStatus::Converged && design.status != SolverStatus::Stalled) {
    unmet.push_back(fmt::format("the optimisation ended early ({}): {}", to_string(design.status), design.message));
  }
  for (std::string& constraint : violated_constraints(problem, asked, design.after)) unmet.push_back(std::move(constraint));
}

std::vector<std::string> limits_exceeded_over_draws(const ScatterResult& result, const DesignTask& task, const Aggregation& statistic) {
  std::vector<std::string> exceeded;
  for (std::size_t c = 0; c < result.predicted_limits.size(); ++c) {
    const OutputConstraint& limit = task.constraints[c];
    const PredictedStatistic& predicted = result.predicted_limits[c];
    const double bound = bound_on(limit, statistic).limit;
    if (!(predicted.value > (1.0 + told_apart) * bound)) continue;
    exceeded.push_back(fmt::format("{} of {} over drawn gears does not keep {} {:.4g}{}: {:.4g} is predicted from draws that the search has not seen",
                                   statistic_in_words(statistic, limit), plain_name(limit.output.name), limit.is_least() ? ">=" : "<=",
                                   of_output(limit, bound), behind_number(limit.output.unit()), of_output(limit, predicted.value)));
  }
  return exceeded;
}

}  // namespace flankwright::studies
