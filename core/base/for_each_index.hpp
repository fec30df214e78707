#pragma once

#include <cstddef>
#include <functional>

namespace flankwright {

/// Runs work for every index below a count, in any order or in parallel.
using ForEachIndex = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;

}  // namespace flankwright
