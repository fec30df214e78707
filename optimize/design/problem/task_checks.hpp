#pragma once

#include <vector>

#include "optimize/design/problem/design_task.hpp"

namespace flankwright {

/// Every output that is minimised or bounded.
std::vector<ObjectiveTerm> terms_of(const DesignTask& task);
/// Whether one of them is read off the roots.
bool asks_for_root_stress(const DesignTask& task);

/// @throws InvalidInput where the outputs asked for are no part of the analysis, cannot be combined, or are not resolved by the positions
void check(const DesignTask& task);

}  // namespace flankwright
