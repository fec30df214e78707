#pragma once

#include <functional>
#include <vector>

#include "optimize/design/problem/design_task.hpp"

namespace flankwright {

/// Which draws decide a statistic, at the price of few analyses: in the order of a guess, the largest first, draws are analysed until `batch` of them in
/// succession turn out below all that the statistic hangs on. A statistic that hangs on all draws has all of them analysed.
///
/// @param guess    per draw, infinite where there is none; replaced by what the analyses say
/// @param weights  of the statistic, by measures, see aggregate_weights()
/// @param analyse  measures of these draws
/// @returns        the draws analysed, in ascending order
std::vector<int> screen(std::vector<double>& guess, std::size_t first, const std::function<std::vector<double>(const std::vector<double>&)>& weights,
                        const std::function<std::vector<double>(const std::vector<int>&)>& analyse);

/// The least measure of a draw that the statistic hangs on.
double least_deciding(const std::vector<double>& measures, const std::vector<double>& weights);

/// The task by the cheapest resolution that keeps the order of draws; only where can_be_coarser().
DesignTask screening_task(DesignTask task);

/// Draws in succession that end screen().
inline constexpr std::size_t screening_batch = 16;

/// Only the worst draws decide.
inline bool is_of_tail(const Aggregation& over) { return over == Aggregate::Cvar || over == Aggregate::Quantile || over == Aggregate::Worst; }

}  // namespace flankwright
