#include "studies/tasks/optimise/optimise_results.hpp"

#include <cassert>

namespace flankwright::studies {

const OptimiseResults& optimised(const StudyResults& results) {
  const OptimiseResults* found = results.found<OptimiseResults>();
  assert(found != nullptr);
  return *found;
}

}  // namespace flankwright::studies
