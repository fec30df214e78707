#pragma once

#include <dlfcn.h>

#include <mutex>

#include "core/base/one_blas_thread.hpp"

namespace flankwright {

/// Keeps OpenMP, with which CHOLMOD assembles and solves, on the calling thread while it lives: its workers would spin
/// against those of the other gear. The switch is the calling thread's own, and looked for as OpenBLAS' is.
class SerialOpenMp {
 public:
  SerialOpenMp() {
    if (!get_ || !set_) return;
    levels_ = get_();
    set_(0);
  }
  ~SerialOpenMp() {
    if (get_ && set_) set_(levels_);
  }
  SerialOpenMp(const SerialOpenMp&) = delete;
  SerialOpenMp& operator=(const SerialOpenMp&) = delete;

 private:
  using Get = int (*)();
  using Set = void (*)(int);
  static inline const Get get_{reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "omp_get_max_active_levels"))};
  static inline const Set set_{reinterpret_cast<Set>(dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"))};
  int levels_{1};
};

/// A turn among our threads, where BLAS needs that.
class BlasTurn {
 public:
  BlasTurn() {
    if (blas_needs_turns()) turn_ = std::unique_lock(turns_);
  }

 private:
  static inline std::mutex turns_;
  std::unique_lock<std::mutex> turn_;
};

/// Keeps CHOLMOD's calls on one core and apart from each other.
struct OneCore {
  BlasTurn turn;
  OneBlasThread blas;
  SerialOpenMp open_mp;
};

}  // namespace flankwright
