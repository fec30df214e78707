#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "optimize/assessment/compared_design.hpp"

namespace flankwright {

/// Positions of the levels of a full-factorial search between the bounds of a variable.
enum class LevelPlacement {
  BoundToBound,  ///< lower, ..., upper in equal steps
  Middles        ///< the middles of equal parts
};
const char* to_string(LevelPlacement placement);

/// Levels per variable whose product stays within a budget of analyses: as many for all as fit, then one more for each variable from
/// the first on while it fits. 1 level: the middle.
/// @param budget  >= 1
std::vector<int> levels_for(int variables, std::int64_t budget);

/// Scaled value 0 .. 1 of level k of n.
double level_value(LevelPlacement placement, int k, int n);

/// Outcome of a full-factorial search: every combination of the levels analysed over the scenes, as commercial gear software does.
struct VariantSearch {
  LevelPlacement placement{LevelPlacement::BoundToBound};
  std::vector<int> levels;   ///< per variable
  std::int64_t tried{0};     ///< analyses of the whole scene set
  std::int64_t feasible{0};  ///< that met the constraints
  std::int64_t failed{0};    ///< that could not be analysed
  Eigen::VectorXd x;         ///< scaled best design; empty where none is feasible
  ComparedDesign best;       ///< poisoned where none is feasible
  double seconds{not_given};
};

/// Combinations are analysed in parallel; of equals the first in order counts, whatever the number of threads.
/// @param done  called after each batch of combinations with (analysed, of), from one thread; may be empty
VariantSearch search_variants(const DesignProblem& problem, LevelPlacement placement, std::int64_t budget,
                              const std::function<void(int, int)>& done = {});

}  // namespace flankwright
