#pragma once

#include <malloc.h>

namespace flankwright::studies {

/// Lets the allocator of the process keep what is freed. What goes back to the system is asked for again page by page, which was a tenth of a
/// run's time. Blocks of 32 MiB and more, the fronts and factors of finite elements among them, still go back at once.
inline void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int mebibyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * mebibyte);
  mallopt(M_TRIM_THRESHOLD, 1024 * mebibyte);
  mallopt(M_TOP_PAD, 32 * mebibyte);
#endif
}

}  // namespace flankwright::studies
