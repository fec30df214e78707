#pragma once

namespace flankwright {

/// Keeps OpenBLAS on one thread while any of them lives, in whatever thread of ours: its results would otherwise depend on how many cores
/// there are. Other implementations are left as they are. Which BLAS runs is known only when the program is loaded, so its
/// switches are looked for there.
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
