#include "optimize/design/scatter/screening.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "optimize/design/two_level.hpp"

namespace flankwright {

namespace {

/// Positions of a cycle that screens: a peak at fewer lies within a per cent of that of twice as many, and the order of draws is kept.
constexpr int most_screening_positions = 12;

}  // namespace

double least_deciding(const std::vector<double>& measures, const std::vector<double>& weights) {
  double least = INFINITY;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] != 0.0) least = std::min(least, measures[i]);
  }
  return least;
}

DesignTask screening_task(DesignTask task) {
  task = coarser(std::move(task));
  std::vector<double>& phases = task.resolution.phases;
  const int positions = static_cast<int>(phases.size());
  const auto has_orders = [](const ObjectiveTerm& term) { return design_output(term.output).has_orders; };
  const bool needs_all = std::ranges::any_of(task.objective, has_orders) || std::ranges::any_of(task.objective_bounds, [&](const ObjectiveBound& b) {
                           return std::ranges::any_of(b.objective.terms, has_orders);
                         });
  if (!needs_all && positions > most_screening_positions && phases == equally_spaced_phases(positions))
    phases = equally_spaced_phases(most_screening_positions);
  return task;
}

std::vector<int> screen(std::vector<double>& guess, std::size_t first, const std::function<std::vector<double>(const std::vector<double>&)>& weights,
                        const std::function<std::vector<double>(const std::vector<int>&)>& analyse) {
  std::vector<int> order(guess.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](int a, int b) { return guess[static_cast<std::size_t>(a)] > guess[static_cast<std::size_t>(b)]; });
  const auto unknown = static_cast<std::size_t>(std::ranges::count(guess, INFINITY));
  std::size_t known = 0, next = first + screening_batch;
  next = std::max(next, unknown);
  while (known < guess.size()) {
    next = std::min(next, guess.size());
    const std::vector<int> batch(order.begin() + static_cast<std::ptrdiff_t>(known), order.begin() + static_cast<std::ptrdiff_t>(next));
    const std::vector<double> measures = analyse(batch);
    for (std::size_t i = 0; i < batch.size(); ++i) guess[static_cast<std::size_t>(batch[i])] = measures[i];
    known = next;
    const double least = least_deciding(guess, weights(guess));
    const auto last = order.begin() + static_cast<std::ptrdiff_t>(known);
    if (std::all_of(last - static_cast<std::ptrdiff_t>(std::min(known, screening_batch)), last,
                    [&](int draw) { return guess[static_cast<std::size_t>(draw)] < least; })) {
      break;
    }
    next = known + screening_batch;
  }
  order.resize(known);
  std::ranges::sort(order);
  return order;
}

}  // namespace flankwright
