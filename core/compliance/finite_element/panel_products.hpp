#pragma once

#include "core/base/for_each_index.hpp"

namespace flankwright {

/// Products and solutions with dense blocks, by columns, in panels of a fixed width. Panels may run side by side. Which thread takes a panel
/// changes none of its numbers: same input, same bits, whatever the number of threads.
///
/// Keep OneCore while these run. Where calls of BLAS have to take turns, panels run one after the other.
class PanelProducts {
 public:
  explicit PanelProducts(const ForEachIndex& for_each);

  /// B <- B L^-T, B: rows x n.
  /// @param l  lower triangle, n x n
  void solve_from_right(int rows, int n, const double* l, int l_stride, double* b, int b_stride) const;
  /// B <- L^-1 B, B: n x columns.
  void solve_from_left(int n, int columns, const double* l, int l_stride, double* b, int b_stride) const;
  /// C <- C - A A', lower triangle, A: n x k.
  void subtract_outer(int n, int k, const double* a, int a_stride, double* c, int c_stride) const;
  /// C <- beta C + A' A, lower triangle, A: k x n.
  void add_inner(int n, int k, const double* a, int a_stride, double beta, double* c, int c_stride) const;
  /// C <- A B, A: rows x k, B: k x columns.
  void multiply(int rows, int columns, int k, const double* a, int a_stride, const double* b, int b_stride, double* c, int c_stride) const;

 private:
  ForEachIndex for_each_;  ///< empty: on the calling thread
};

}  // namespace flankwright
