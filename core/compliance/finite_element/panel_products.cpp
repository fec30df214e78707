#include "core/compliance/finite_element/panel_products.hpp"

extern "C" {  // which some vendors' header leaves to us
#include <cblas.h>
}

#include <algorithm>
#include <cstddef>

#include "core/base/one_blas_thread.hpp"
#include "core/compliance/finite_element/one_core.hpp"

namespace flankwright {
namespace {

/// Rows or columns of a panel: enough that packing the other operand anew for every panel is a small part of its product.
constexpr int kPanel = 384;

template <class T>
T* at(T* a, int stride, int row, int column) {
  return a + row + static_cast<std::ptrdiff_t>(column) * stride;
}

/// Calls panel(first, size) for all panels of n rows or columns.
template <class Panel>
void for_panels(const ForEachIndex& for_each, int n, const Panel& panel) {
  if (n <= kPanel) return panel(0, n);
  const auto count = static_cast<std::size_t>((n + kPanel - 1) / kPanel);
  run_for_each(for_each, count, [&](std::size_t i) {
    const SerialOpenMp serial;  // of the thread that takes the panel
    const int first = static_cast<int>(i) * kPanel;
    panel(first, std::min(kPanel, n - first));
  });
}

}  // namespace

PanelProducts::PanelProducts(const ForEachIndex& for_each) : for_each_(blas_needs_turns() ? ForEachIndex{} : for_each) {}

void PanelProducts::solve_from_right(int rows, int n, const double* l, int l_stride, double* b, int b_stride) const {
  for_panels(for_each_, rows, [&](int first, int size) {
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, size, n, 1.0, l, l_stride, at(b, b_stride, first, 0), b_stride);
  });
}

void PanelProducts::solve_from_left(int n, int columns, const double* l, int l_stride, double* b, int b_stride) const {
  for_panels(for_each_, columns, [&](int first, int size) {
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, n, size, 1.0, l, l_stride, at(b, b_stride, 0, first), b_stride);
  });
}

void PanelProducts::subtract_outer(int n, int k, const double* a, int a_stride, double* c, int c_stride) const {
  for_panels(for_each_, n, [&](int first, int size) {
    const double* own = at(a, a_stride, first, 0);
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, size, k, -1.0, own, a_stride, 1.0, at(c, c_stride, first, first), c_stride);
    const int below = first + size;
    if (below < n) {
      cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, n - below, size, k, -1.0, at(a, a_stride, below, 0), a_stride, own, a_stride, 1.0,
                  at(c, c_stride, below, first), c_stride);
    }
  });
}

void PanelProducts::add_inner(int n, int k, const double* a, int a_stride, double beta, double* c, int c_stride) const {
  for_panels(for_each_, n, [&](int first, int size) {
    const double* own = at(a, a_stride, 0, first);
    cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, size, k, 1.0, own, a_stride, beta, at(c, c_stride, first, first), c_stride);
    const int below = first + size;
    if (below < n) {
      cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, n - below, size, k, 1.0, at(a, a_stride, 0, below), a_stride, own, a_stride, beta,
                  at(c, c_stride, below, first), c_stride);
    }
  });
}

void PanelProducts::multiply(int rows, int columns, int k, const double* a, int a_stride, const double* b, int b_stride, double* c,
                             int c_stride) const {
  for_panels(for_each_, columns, [&](int first, int size) {
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, rows, size, k, 1.0, a, a_stride, at(b, b_stride, 0, first), b_stride, 0.0,
                at(c, c_stride, 0, first), c_stride);
  });
}

}  // namespace flankwright
