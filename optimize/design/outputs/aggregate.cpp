#include "optimize/design/outputs/aggregate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace flankwright {

namespace {

struct Moments {
  double total_weight{0.0}, mean{0.0};
  double sigma{0.0};  ///< 0 where the spread is round-off
};

Moments moments_of(const std::vector<double>& measures, const std::vector<double>& weights) {
  Moments m;
  double variance = 0.0;
  for (double w : weights) m.total_weight += w;
  for (std::size_t s = 0; s < measures.size(); ++s) m.mean += weights[s] / m.total_weight * measures[s];
  for (std::size_t s = 0; s < measures.size(); ++s) {
    variance += weights[s] / m.total_weight * std::pow(measures[s] - m.mean, 2);
  }
  // Scenes that mirror each other differ by round-off only, which has no direction to descend: sigma <= 1e-12 |mean| is none.
  const double sigma = std::sqrt(variance);
  m.sigma = sigma > 1e-12 * std::abs(m.mean) ? sigma : 0.0;
  return m;
}

/// Scenes from the largest measure down, of equals the first scene first.
std::vector<std::size_t> worst_first(const std::vector<double>& measures) {
  std::vector<std::size_t> order(measures.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return measures[a] > measures[b]; });
  return order;
}

/// The worst 1 - level of all weight, distributed from the largest measure down (of equals the first scene first).
std::vector<double> tail_weights(double level, const std::vector<double>& measures, const std::vector<double>& weights) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<double> result(measures.size(), 0.0);
  double left = 1.0;
  for (std::size_t s : worst_first(measures)) {
    result[s] = std::min(left, weights[s] / total / (1.0 - level));
    left -= result[s];
  }
  return result;
}

/// The scene whose measure is the quantile.
std::size_t at_quantile(double level, const std::vector<double>& measures, const std::vector<double>& weights) {
  const std::vector<bool> beyond = beyond_quantile(level, measures, weights);
  const std::vector<std::size_t> order = worst_first(measures);
  return *std::ranges::find_if(order, [&](std::size_t s) { return !beyond[s]; });
}

}  // namespace

std::vector<bool> beyond_quantile(double level, const std::vector<double>& measures, const std::vector<double>& weights) {
  constexpr double round_off = 1e-12;  // weight beyond <= 1 - level + round_off, so that 5 of 100 equal weights are beyond 0.95
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<bool> beyond(measures.size(), false);
  double weight = 0.0;
  std::size_t count = 0;
  for (std::size_t s : worst_first(measures)) {
    weight += weights[s] / total;
    if (weight > 1.0 - level + round_off || ++count == measures.size()) break;
    beyond[s] = true;
  }
  return beyond;
}

std::string to_string(const Aggregation& over) {
  std::ostringstream text;
  switch (over.kind) {
    case Aggregate::Nominal:
      return "nominal";
    case Aggregate::Worst:
      return "worst";
    case Aggregate::Mean:
      return "mean";
    case Aggregate::MeanPlusSigmas:
      text << "mean+" << over.sigmas << "sigma";
      break;
    case Aggregate::Cvar:
      text << "cvar " << over.level;
      break;
    case Aggregate::Quantile:
      text << "quantile " << over.level;
      break;
  }
  return text.str();
}

std::vector<double> aggregate_weights(const Aggregation& over, const std::vector<double>& measures, const std::vector<double>& weights) {
  if (over == Aggregate::Cvar) return tail_weights(over.level, measures, weights);
  std::vector<double> result(measures.size(), 0.0);
  if (over == Aggregate::Nominal) {
    result.front() = 1.0;
    return result;
  }
  if (over == Aggregate::Quantile) {
    result[at_quantile(over.level, measures, weights)] = 1.0;
    return result;
  }
  if (over == Aggregate::Worst) {
    result[static_cast<std::size_t>(std::max_element(measures.begin(), measures.end()) - measures.begin())] = 1.0;
    return result;
  }
  const Moments moments = moments_of(measures, weights);
  for (std::size_t s = 0; s < measures.size(); ++s) {
    result[s] = weights[s] / moments.total_weight;
    if (over == Aggregate::MeanPlusSigmas && moments.sigma > 0.0) {
      result[s] *= 1.0 + over.sigmas * (measures[s] - moments.mean) / moments.sigma;
    }
  }
  return result;
}

double aggregate(const Aggregation& over, const std::vector<double>& measures, const std::vector<double>& weights) {
  if (over == Aggregate::Nominal) return measures.front();
  if (over == Aggregate::Worst) return *std::max_element(measures.begin(), measures.end());
  if (over == Aggregate::Quantile) return measures[at_quantile(over.level, measures, weights)];
  if (over == Aggregate::Cvar) {
    const std::vector<double> shares = tail_weights(over.level, measures, weights);
    return std::inner_product(measures.begin(), measures.end(), shares.begin(), 0.0);
  }
  const Moments moments = moments_of(measures, weights);
  return over == Aggregate::Mean ? moments.mean : moments.mean + over.sigmas * moments.sigma;
}

}  // namespace flankwright
