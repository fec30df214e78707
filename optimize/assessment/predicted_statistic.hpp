#pragma once

#include <cstdint>
#include <utility>

#include "optimize/design/problem/design_task.hpp"

namespace flankwright {

/// A statistic of one design over draws that its search has not seen, with its sampling error. That over the draws searched is the least of many and
/// therefore too low; this one is not.
struct PredictedStatistic {
  static constexpr double confidence = 0.95;

  double value{not_given};                      ///< outside units
  double low{not_given}, high{not_given};       ///< interval that holds the true one with `confidence`; NaN where the draws are too few for a limit
  int failed{0};                                ///< draws that could not be analysed; left out
  std::int64_t cycles{0}, screening_cycles{0};  ///< mesh cycles analysed: all, and those of the screening
  double seconds{not_given};
};

/// Of a quantile or CVaR the draws are screened first (screening_task()), and those that decide it and its interval are analysed by the task's resolution.
///
/// @param task          scenes are the load cases of the draws, task.over is the statistic
/// @param modification  the design
PredictedStatistic predict_statistic(const DesignTask& task, const PerGear<Modification>& modification);

/// Levels of the order statistics between which the quantile of a level lies with at least this probability, whatever the distribution: with the number B
/// of n draws below the quantile, which is binomial, P(l <= B < u) >= confidence, and the l-th and u-th smallest draws have the levels l/n and u/n
/// [Conover, Practical Nonparametric Statistics (1999), sec. 3.2]. NaN instead of a limit that no draw is.
std::pair<double, double> quantile_interval(double level, int draws, double confidence);

}  // namespace flankwright
