#include "studies/analysis/refine_resolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/fidelity/resolved_analysis.hpp"

namespace flankwright::studies {

bool refine_resolution(StudyResults& results) {
  const LoadedResult* worst = nullptr;
  double largest = 0.0;
  for (const LoadedResult& loaded : results.loaded) {
    const double error = headline_error(loaded.resolved.errors, loaded.resolved.summary, loaded.cycle);
    if (!std::isgreater(error, largest)) continue;  // quiet where none was estimated
    largest = error;
    worst = &loaded;
  }
  Quadrature& quadrature = results.study.fidelity.quadrature;
  Cycle& cycle = results.study.cycle;
  AutomaticResolution resolution{.intervals = quadrature.intervals,
                                 .positions = cycle.positions,
                                 .choose_intervals = results.study.fidelity.automatic_intervals,
                                 .choose_positions = cycle.automatic_positions && cycle.phases.empty()};
  if (worst == nullptr || largest <= resolution.accuracy) return false;
  if (refine(resolution, worst->resolved, worst->cycle)) {
    quadrature.intervals = resolution.intervals;
    cycle.positions = resolution.positions;
    return true;
  }
  const bool is_given = mostly_by_points(worst->resolved, worst->cycle) ? !results.study.fidelity.automatic_intervals : !cycle.automatic_positions;
  if (is_given) return false;
  results.notes.push_back(
      fmt::format("the figures of scene \"{}\" are known to {:.3g} % only, with {} intervals along a contact line and {} mesh positions",
                  worst->scene, 100.0 * largest, quadrature.intervals, results.phases.size()));
  return false;
}

}  // namespace flankwright::studies
