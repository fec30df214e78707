#pragma once

#include "studies/base/json_format.hpp"

/// Made-up results in the shape of results.json, plausible enough to look at, for testing what reads results.
/// The gears are a real 18:54 helical pair; loads, stresses and errors are smooth formulas, not an analysis.
namespace flankwright::studies::sample {

Json unloaded_results();

/// @param scenes  load cases of the given design, >= 1
Json loaded_results(int scenes);

/// @param scenes  scenes, each before and after, >= 1
/// @param positions  mesh positions of each cycle, >= 1
Json optimise_results(int scenes, int positions);

}  // namespace flankwright::studies::sample
