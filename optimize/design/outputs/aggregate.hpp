#pragma once

#include <string>
#include <vector>

namespace flankwright {

/// How the scenes are combined into one number.
enum class Aggregate { Nominal, Worst, Mean, MeanPlusSigmas, Cvar, Quantile };

/// An aggregate with its parameter.
struct Aggregation {
  Aggregate kind{Aggregate::Worst};
  double sigmas{2.0};  ///< k of mean + k sigma, > 0
  double level{0.9};   ///< of Cvar, the mean over the worst 1 - level of the weights, and of Quantile; 0 <= level < 1

  Aggregation() = default;
  Aggregation(Aggregate aggregate, double parameter_sigmas = 2.0, double parameter_level = 0.9)  // NOLINT: stands for it
      : kind(aggregate), sigmas(parameter_sigmas), level(parameter_level) {}
  bool operator==(Aggregate other) const { return kind == other; }
};

/// As results name it: "nominal", "worst", "mean", "mean+2sigma", "cvar 0.9", "quantile 0.95".
std::string to_string(const Aggregation& over);

/// Combines scene measures: the first, the largest, the weighted mean (plus k times the weighted standard deviation), or the
/// conditional value at risk [Rockafellar, Uryasev, Optimization of conditional value-at-risk, J. Risk 2 (2000)],
///
///     min over t of   t + sum_s p_s max(0, m_s - t) / (1 - level),    p_s = weight_s / sum of weights
///
/// or the quantile, the least t with sum of p_s over m_s <= t of at least `level`: itself one of the measures.
double aggregate(const Aggregation& over, const std::vector<double>& measures, const std::vector<double>& weights);

/// Scenes beyond the quantile: from the largest measure down as long as their weight together is at most 1 - level (of equals the first scene
/// first), never all. The quantile is the largest measure of the others.
std::vector<bool> beyond_quantile(double level, const std::vector<double>& measures, const std::vector<double>& weights);

/// d(aggregate)/d(measure); of equal largest measures the first carries it all; at sigma = 0 the spread counts nothing.
std::vector<double> aggregate_weights(const Aggregation& over, const std::vector<double>& measures, const std::vector<double>& weights);

}  // namespace flankwright
