#include "studies/tasks/refine_resolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flankwright::studies {

bool refine_resolution(StudyResults& results) {
  const LoadedResult* worst = nullptr;
  double largest = 0.0;
  for (const LoadedResult& loaded : results.loaded) {
    const double error = headline_error(loaded.resolved.errors, loaded.summary, loaded.cycle);
    if (!std::isgreater(error, largest)) continue;  // quiet where none was estimated
    largest = error;
    worst = &loaded;
  }
  if (worst == nullptr || largest <= headline_accuracy) return false;
  Quadrature& quadrature = results.study.fidelity.quadrature;
  Cycle& cycle = results.study.cycle;
  const bool more_intervals = results.study.fidelity.automatic_intervals && 2 * quadrature.intervals <= most_intervals;
  const bool more_positions = cycle.automatic_positions && cycle.phases.empty() && 2 * cycle.positions <= most_positions;
  const auto part = [&](const CycleErrors& errors) { return headline_error(errors, worst->summary, worst->cycle); };
  const bool by_points = part(worst->resolved.error_parts.points) >= part(worst->resolved.error_parts.positions);
  if (more_intervals && (by_points || !more_positions)) {
    quadrature.intervals *= 2;
    return true;
  }
  if (more_positions) {
    cycle.positions *= 2;
    return true;
  }
  const bool is_given = by_points ? !results.study.fidelity.automatic_intervals : !cycle.automatic_positions;
  if (is_given) return false;
  results.notes.push_back(fmt::format("the figures of scene \"{}\" are known to {:.2g} % only, with {} intervals along a contact line and {} mesh positions",
                                      worst->scene, 100.0 * largest, quadrature.intervals, results.phases.size()));
  return false;
}

}  // namespace flankwright::studies
