#include "optimize/design/grinding/deciding_positions.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include "optimize/design/outputs/design_output.hpp"

namespace flankwright {

namespace {

/// Positions that an output with values at points adds: at most so many, those of its highest values first, >= 1. Beside the highest peak there are
/// those that follow, as another design may raise them more. least_measure() <= objective holds for any number. More positions bring the two closer,
/// so that fewer designs need whole cycles, but each design tried costs more: 3 of the cycle's positions a scene. With 3, rounding in
/// studies/examples/robust-18-54.toml takes a third of the time that it takes without; other numbers were not measured.
constexpr std::size_t most_peaks = 3;

bool has_deciding_positions(const DesignOutput& row) { return row.smooth == nullptr && row.candidates == nullptr && !row.is_least; }

double at(const ObjectiveTerm& term, const LoadedScene& scene, std::size_t position) {
  const DesignOutput& row = design_output(term.output);
  if (row.at_points == nullptr) return scene.cycle.positions[position].load.transmission_error;
  return row.at_points(term, scene.model, scene.cycle, static_cast<int>(position)).maxCoeff();
}

}  // namespace

std::vector<std::size_t> deciding_positions(const Objective& objective, const LoadedScene& scene) {
  std::set<std::size_t> found;
  for (const ObjectiveTerm& term : objective.terms) {
    const DesignOutput& row = design_output(term.output);
    if (!has_deciding_positions(row)) return {};
    std::vector<std::size_t> order(scene.cycle.positions.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t position) { return at(term, scene, position); });
    if (row.at_points == nullptr) {
      found.insert({order.front(), order.back()});
    } else {
      found.insert(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(std::min(most_peaks, order.size())));
    }
  }
  return {found.begin(), found.end()};
}

double least_measure(const Objective& objective, const LoadedScene& scene, std::span<const std::size_t> positions) {
  double sum = 0.0;
  for (const ObjectiveTerm& term : objective.terms) {
    double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
    for (const std::size_t position : positions) {
      const double value = at(term, scene, position);
      highest = std::max(highest, value);
      lowest = std::min(lowest, value);
    }
    const double value = design_output(term.output).at_points == nullptr ? highest - lowest : highest;
    sum += term.weight * term.outside_factor() * value;
  }
  return sum;
}

}  // namespace flankwright
