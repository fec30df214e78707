#include "core/base/one_blas_thread.hpp"

#include <dlfcn.h>

#include <mutex>

namespace flankwright {
namespace {

using Get = int (*)();
using Set = void (*)(int);

/// A function of the BLAS that is loaded; null where it has none of that name.
template <class Function>
Function of_blas(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
}

struct Switch {
  const Get threads{of_blas<Get>("openblas_get_num_threads")};
  const Set set_threads{of_blas<Set>("openblas_set_num_threads")};
  std::mutex mutex{};
  int users{0}, before{0};

  explicit operator bool() const { return threads && set_threads; }
};

Switch& the_switch() {
  static Switch one;
  return one;
}

}  // namespace

OneBlasThread::OneBlasThread() {
  Switch& blas = the_switch();
  const std::lock_guard lock(blas.mutex);
  if (blas.users++ > 0 || !blas) return;
  blas.before = blas.threads();
  blas.set_threads(1);
}

OneBlasThread::~OneBlasThread() {
  Switch& blas = the_switch();
  const std::lock_guard lock(blas.mutex);
  if (--blas.users == 0 && blas) blas.set_threads(blas.before);
}

bool blas_needs_turns() {
  static const Get parallel = of_blas<Get>("openblas_get_parallel");
  return parallel && parallel() == 0;
}

}  // namespace flankwright
