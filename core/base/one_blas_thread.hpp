#pragma once

namespace flankwright {

/// Keeps OpenBLAS on one thread while any instance lives, in any of our threads: its results would otherwise depend on
/// the number of cores. Other implementations are left as they are. Which BLAS runs is known only when the program is
/// loaded, so its switches are sought then.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;
};

/// Whether calls from several threads have to take turns: OpenBLAS built without threads (Debian's libopenblas0-serial) has no locks on
/// its work space either, and two factorisations side by side then spoil each other.
bool blas_needs_turns();

}  // namespace flankwright
