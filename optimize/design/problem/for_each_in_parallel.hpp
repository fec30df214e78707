#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/base/for_each_index.hpp"

namespace flankwright {

/// Runs work for every index on all threads. A thread that waits for the others takes up nothing else meanwhile: what is large and made at one time
/// stays at one a thread, and whoever holds a lock around it waits for no one who wants that lock.
inline void for_each_in_parallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, count, work); });
}

}  // namespace flankwright
