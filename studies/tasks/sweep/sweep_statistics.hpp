#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "optimize/sampling/sobol_indices.hpp"
#include "studies/tasks/sweep/sweep_design.hpp"
#include "studies/tasks/sweep/sweep_store.hpp"

namespace flankwright::studies {

/// Probabilities of the quantiles that are reported.
inline constexpr std::array<double, 7> quantile_shares{0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99};

/// Counts over equal parts of low .. high, or of each of a few levels.
struct Histogram {
  double low{not_given}, high{not_given};
  std::vector<long long> counts;
  std::vector<double> levels{};  ///< rising, one a part; empty: parts are equal
  /// Which part a value falls to, of levels the nearest; the ends belong to the first and the last.
  std::size_t part(double value) const;
};

/// Statistics of one output over the samples that have it; NaN where none does.
struct OutputStatistics {
  SweepOutput output;
  long long count{0};
  double mean{not_given};
  double deviation{not_given};  ///< standard deviation, n - 1 below the root; NaN of fewer than two
  double smallest{not_given}, largest{not_given};
  std::array<double, quantile_shares.size()> quantiles{};  ///< the value of rank share (n - 1), between two ranks linearly
  long long worst{-1};                                     ///< number of the sample with the worst value, the first of equal ones
  Histogram histogram;
  std::vector<SobolIndex> indices;  ///< one a parameter; empty where the design has no blocks
};

/// Mean of an output over parts of two parameters' ranges.
struct ResponseMap {
  std::size_t output{0}, x{0}, y{0};  ///< indices; x < y
  std::size_t columns{0};             ///< parts of x
  std::vector<double> sums;           ///< row by row of y, x fastest
  std::vector<long long> counts;
  double mean(std::size_t ix, std::size_t iy) const;  ///< NaN of an empty part
};

/// Number of samples that failed for a reason.
struct FailureCount {
  std::string reason;
  long long count{0}, first{-1};  ///< first: a sample that did
};

struct SweepStatistics {
  long long samples{0}, failed{0};
  double seconds{not_given};        ///< of computing the samples, over all runs that did
  long long blocks{0};              ///< that the Sobol indices are from: none of their samples failed
  std::vector<StoredSample> worst;  ///< of each output; an id of -1 where there is none
  std::vector<OutputStatistics> outputs;
  /// How the samples lie over each parameter's range; the parts are those of the maps, and where there are few levels the levels.
  std::vector<Histogram> parameters;
  std::vector<ResponseMap> maps;       ///< of every output over every two parameters that are not draws
  std::vector<FailureCount> failures;  ///< most frequent first, at most 20
};

/// A sentence where the Sobol indices of some output are uncertain by more than 0.1 either way (95 % confidence), or are from fewer than
/// fewest_index_blocks blocks, whose standard errors are themselves uncertain; empty: neither.
std::string index_warning(const SweepStatistics& statistics);
inline constexpr long long fewest_index_blocks = 30;

/// Half of the interval that holds an index with 95 % confidence, by its standard error [-].
inline double index_confidence(double error) { return 1.96 * error; }

/// Reads the samples below design.samples() three times in their order and once sorted for each output; memory does not grow with
/// their number.
SweepStatistics sweep_statistics(SweepStore& store, const SweepDesign& design, const std::vector<SweepOutput>& outputs);

}  // namespace flankwright::studies
