#pragma once

#include <cstddef>
#include <functional>

namespace flankwright {

/// Does one thing for every index below a count, in any order or side by side.
using ForEachIndex = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;

}  // namespace flankwright
