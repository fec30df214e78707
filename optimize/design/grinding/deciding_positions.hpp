#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "optimize/design/problem/design_task.hpp"
#include "optimize/design/outputs/output_row.hpp"

namespace flankwright {

/// The few mesh positions that decide an objective in one scene: where its peaks are largest, and both extremes of the transmission error. Rising; none
/// where an output takes every position, as a harmonic does, or is the least over them.
std::vector<std::size_t> deciding_positions(const Objective& objective, const LoadedScene& scene);

/// The objective from some positions of a cycle alone, outside units: by all of them it is at least that.
/// @param objective  one with deciding_positions()
/// @param scene      whose cycle is usable() and has loads at these positions
double least_measure(const Objective& objective, const LoadedScene& scene, std::span<const std::size_t> positions);

}  // namespace flankwright
