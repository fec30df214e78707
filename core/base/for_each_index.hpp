#pragma once

#include <cstddef>
#include <functional>

namespace flankwright {

/// Runs work for every index below a count, in any order or in parallel.
using ForEachIndex = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;

/// Runs work for every index below a count, by `for_each`; where that is empty one after the other.
inline void run_for_each(const ForEachIndex& for_each, std::size_t count, const std::function<void(std::size_t)>& work) {
  if (for_each) return for_each(count, work);
  for (std::size_t i = 0; i < count; ++i) work(i);
}

}  // namespace flankwright
