#pragma once

#include <vector>

#include "optimize/design/outputs/aggregate.hpp"

/// [optimise.scatter]: a design chosen by a statistic over gears and assemblies that are drawn from the study's tolerances. Read by scatter_reading.hpp.
namespace flankwright::studies {

struct ScatterTable {
  int draws{0};           ///< 0: no scatter in the search
  unsigned long seed{1};  ///< of the draws; the same for every design
  Aggregation statistic{Aggregate::Quantile, 2.0, 0.95};
  std::vector<int> classes;         ///< for each of which the right design is sought as well
  int predicted_from{2000};         ///< draws that the search has not seen, from which its statistic is predicted
  unsigned long predicted_seed{3};  ///< of them
  int fresh{0};                     ///< draws that the designs are tried on
  unsigned long fresh_seed{2};

  bool asked() const { return draws > 0; }
};

}  // namespace flankwright::studies
