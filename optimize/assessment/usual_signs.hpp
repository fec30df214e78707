#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "optimize/design/design_optimiser.hpp"

namespace flankwright {

/// Limits of the flanks that are ground as a rule, for the parameters that a task varies or links:
///
/// - no crowning and no relief is negative: nothing is left standing at a border of the flank;
/// - each border lies behind the middle: half a slope is at most the crowning and relief at the border that it raises.
///
/// A slope is free, a correction of the helix or the pressure angle, where the task varies neither crowning nor relief at the border
/// that it raises.
std::vector<ModificationConstraint> usual_sign_limits(const DesignTask& task);

/// An optimum that exceeds these limits, and the best design within them.
struct UsualSigns {
  /// Less than this is not said to be unusual: no drawing states it [mm].
  static constexpr double noticed = 5e-4;
  std::vector<std::string> unusual;    ///< what the optimum has that is seldom ground: "a negative pinion lead crowning"
  std::optional<DesignReport> design;  ///< optimum of the same task under the limits as well; none where it was not found
  bool is_out_of_time{false};          ///< the search for it did not end within its time
  double price{not_given};             ///< relative_increase() of the objective from the optimum, of a list of the last one [-]
};

/// @param problem  of a single objective: last_stage()
/// @param best     the optimum before rounding
/// @param max_seconds  after which the search for that design ends without one, because a longer search may find a better
/// @return  none where the optimum keeps the limits
std::optional<UsualSigns> find_usual_signs(const DesignProblem& problem, const DesignReport& best,
                                           double max_seconds = std::numeric_limits<double>::infinity());

}  // namespace flankwright
