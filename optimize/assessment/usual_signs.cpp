#include "optimize/assessment/usual_signs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "optimize/design/search/design_log.hpp"
#include "optimize/design/two_level.hpp"

namespace flankwright {

namespace {

/// Amounts that are removed at a border, measured from the middle.
constexpr std::array<std::string_view, 8> never_negative{"lead_crowning",
                                                         "end_relief.amount",
                                                         "addendum_crowning",
                                                         "dedendum_crowning",
                                                         "tip_relief.amount",
                                                         "root_relief.amount",
                                                         "triangular_tip_relief.amount",
                                                         "triangular_root_relief.amount"};

/// What a slope raises, and the parameters that lower the same border.
struct RaisedBorder {
  std::string_view slope;
  double sense;  ///< sign of the slope that raises it
  std::array<std::string_view, 2> lowered_by;
};
constexpr std::array<RaisedBorder, 4> borders{{{"lead_slope", 1.0, {"lead_crowning", "end_relief.amount"}},
                                               {"lead_slope", -1.0, {"lead_crowning", "end_relief.amount"}},
                                               {"profile_slope", -1.0, {"addendum_crowning", "tip_relief.amount"}},
                                               {"profile_slope", 1.0, {"dedendum_crowning", "root_relief.amount"}}}};

/// The parameter by which the task varies or links that of a key: itself, or the one that sets both halves; null where it does not.
const ParameterDescription* varied(const DesignTask& task, Member member, std::string_view key) {
  const ParameterDescription* found = nullptr;
  const auto look_at = [&](const DesignVariable& v) {
    const ParameterDescription& of_variable = describe(v.parameter);
    if (v.member == member && (of_variable.key == key || of_variable.half == key || of_variable.other_half == key)) found = &of_variable;
  };
  for (const DesignVariable& v : task.variables) look_at(v);
  for (const LinkingConstraint& link : task.links) look_at(link.linked);
  return found;
}

std::string name_in_words(Member member, const ParameterDescription& parameter) {
  return std::string(name_of(member)) + " " + std::string(parameter.name);
}

}  // namespace

std::vector<ModificationConstraint> usual_sign_limits(const DesignTask& task) {
  std::vector<ModificationConstraint> limits;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const ParameterDescription* last = nullptr;
    for (const std::string_view key : never_negative) {
      const ParameterDescription* parameter = varied(task, member, key);
      if (parameter == nullptr || parameter == last) continue;  // both halves at once
      ModificationConstraint limit{"a negative " + name_in_words(member, *parameter), {{member, parameter->parameter, 1.0}}};
      limit.minimum = 0.0;
      limits.push_back(limit);
      last = parameter;
    }
    for (const RaisedBorder& border : borders) {
      const ParameterDescription* slope = varied(task, member, border.slope);
      const bool has_other = std::ranges::any_of(border.lowered_by, [&](std::string_view key) { return varied(task, member, key) != nullptr; });
      if (slope == nullptr || !has_other) continue;
      ModificationConstraint limit{"a " + name_in_words(member, *slope) + " of more than twice the crowning and relief at the border that it raises",
                                   {{member, slope->parameter, 0.5 * border.sense}}};
      for (const std::string_view key : border.lowered_by) {
        const ParameterDescription* parameter = varied(task, member, key);
        limit.terms.push_back({member, parameter != nullptr ? parameter->parameter : find_parameter(key)->parameter, -1.0});
      }
      limit.maximum = 0.0;
      limits.push_back(limit);
    }
  }
  return limits;
}

std::optional<UsualSigns> find_usual_signs(const DesignProblem& problem, const DesignReport& best, double max_seconds) {
  const std::vector<ModificationConstraint> limits = usual_sign_limits(problem.task());
  UsualSigns found;
  for (const ModificationConstraint& limit : limits) {
    const double value = limit.value(best.analysis.modification);
    const bool exceeds = value > limit.maximum + UsualSigns::noticed || value < limit.minimum - UsualSigns::noticed;
    if (exceeds && std::ranges::find(found.unusual, limit.name) == found.unusual.end()) found.unusual.push_back(limit.name);
  }
  if (found.unusual.empty()) return std::nullopt;
  DesignTask task = problem.task();
  task.modification_constraints.insert(task.modification_constraints.end(), limits.begin(), limits.end());
  for (DesignVariable& variable : task.variables) variable.step = 0.0;
  task.grindable = {};
  DesignProblem limited(std::move(task));
  limited.set_start(limited.nearest_design(best.variables));
  DesignOptions options;
  options.to_grind = false;
  options.shows_nearest = false;
  options.solver.max_seconds = max_seconds;
  DesignResult result = optimise_by_two_levels(limited, options).design;
  found.is_out_of_time = result.status == SolverStatus::TimeLimit;
  if (found.is_out_of_time || !result.after.analysis.usable() || limited.violation(result.after.analysis) > DesignLog::tolerance) return found;
  found.price = relative_increase(best.last_objective(), result.after.objective);
  found.design = std::move(result.after);
  return found;
}

}  // namespace flankwright
