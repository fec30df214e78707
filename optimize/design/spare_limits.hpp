#pragma once

#include <vector>

#include "optimize/design/problem/design_task.hpp"

namespace flankwright {

/// Tightens limits of a search by what a finer look adds to its constraints, so that the design that it goes on to keeps them there too. A limit that would reach 0
/// stays as it is, and none gets wider.
/// @param constraints  of the search
/// @param asked        those of the task, in the same order: what is asked for in the end
/// @param values       as the search sees them, inside units
/// @param excesses     OutputConstraint::excess as the finer look sees them [-]
/// @returns whether any limit has become tighter
bool spare_limits(std::vector<OutputConstraint>& constraints, const std::vector<OutputConstraint>& asked, const std::vector<double>& values,
                  const std::vector<double>& excesses);

}  // namespace flankwright
