#pragma once

#include <vector>

namespace flankwright {

/// Cycles of one range and mean.
struct RainflowCycle {
  double range{0.0}, mean{0.0};  ///< of the values
  double count{0.0};             ///< 1, or 0.5 of a half cycle
};

/// Rainflow count of a history by the rule of three points [ASTM E1049-85, 5.4.4; Matsuishi and Endo 1968]. What does not close counts as half cycles. The sum of
/// count times range is half the way that the values travel. Linear in the number of values.
/// @param values  in their order; finite
/// @return        in the order in which they close; empty where the values do not change
std::vector<RainflowCycle> rainflow(const std::vector<double>& values);

/// The same of a history that repeats for ever, per repetition: it is counted from its largest value on, round to that again, so that every cycle closes
/// [ASTM E1049-85, 5.4.5].
std::vector<RainflowCycle> repeating_rainflow(const std::vector<double>& values);

}  // namespace flankwright
