#include "core/base/wide_sum.hpp"

#include <algorithm>
#include <cassert>

#include "core/base/vector_registers.hpp"

namespace flankwright {

namespace {

/// Rows of a product that are summed together, so that four columns of it stay in the fastest memory.
constexpr Eigen::Index rows_at_once = 256;

/// Adds four columns to four sums. b holds the factors of the first sum, and those of the next ones `stride` further on.
FLANKWRIGHT_WIDE_REGISTERS void add_to_four_sums(const std::array<const double*, 4>& columns, const double* b, Eigen::Index stride, Eigen::Index n,
                                                 const std::array<double*, 4>& sums) {
  const double *a0 = columns[0], *a1 = columns[1], *a2 = columns[2], *a3 = columns[3];
  double *s0 = sums[0], *s1 = sums[1], *s2 = sums[2], *s3 = sums[3];
  const double *f = b, *g = b + stride, *h = b + 2 * stride, *k = b + 3 * stride;
  const double f0 = f[0], f1 = f[1], f2 = f[2], f3 = f[3], g0 = g[0], g1 = g[1], g2 = g[2], g3 = g[3];
  const double h0 = h[0], h1 = h[1], h2 = h[2], h3 = h[3], k0 = k[0], k1 = k[1], k2 = k[2], k3 = k[3];
#pragma GCC ivdep
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x0 = a0[i], x1 = a1[i], x2 = a2[i], x3 = a3[i];
    s0[i] += (x0 * f0 + x1 * f1) + (x2 * f2 + x3 * f3);
    s1[i] += (x0 * g0 + x1 * g1) + (x2 * g2 + x3 * g3);
    s2[i] += (x0 * h0 + x1 * h1) + (x2 * h2 + x3 * h3);
    s3[i] += (x0 * k0 + x1 * k1) + (x2 * k2 + x3 * k3);
  }
}

}  // namespace

FLANKWRIGHT_WIDE_REGISTERS void add_four_columns(const std::array<const double*, 4>& columns, const std::array<double, 4>& factors, Eigen::Index n,
                                                 double* sum) {
  const double *c0 = columns[0], *c1 = columns[1], *c2 = columns[2], *c3 = columns[3];
  const double f0 = factors[0], f1 = factors[1], f2 = factors[2], f3 = factors[3];
#pragma GCC ivdep
  for (Eigen::Index i = 0; i < n; ++i) sum[i] += (c0[i] * f0 + c1[i] * f1) + (c2[i] * f2 + c3[i] * f3);
}

Eigen::MatrixXd wide_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  assert(A.cols() == B.rows());
  const Eigen::Index n = A.rows(), terms = A.cols(), columns = B.cols(), in_fours = terms - terms % 4;
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(n, columns);
  for (Eigen::Index first = 0; first < n; first += rows_at_once) {
    const Eigen::Index rows = std::min(rows_at_once, n - first);
    const auto of_A = [&](Eigen::Index k) -> std::array<const double*, 4> {
      const double* a = A.data() + k * n + first;
      return {a, a + n, a + 2 * n, a + 3 * n};
    };
    Eigen::Index j = 0;
    for (; j + 4 <= columns; j += 4) {
      double* s = product.data() + j * n + first;
      const std::array<double*, 4> sums{s, s + n, s + 2 * n, s + 3 * n};
      for (Eigen::Index k = 0; k < in_fours; k += 4) add_to_four_sums(of_A(k), B.data() + j * terms + k, terms, rows, sums);
    }
    for (; j < columns; ++j) {
      const double* b = B.data() + j * terms;
      for (Eigen::Index k = 0; k < in_fours; k += 4)
        add_four_columns(of_A(k), {b[k], b[k + 1], b[k + 2], b[k + 3]}, rows, product.data() + j * n + first);
    }
  }
  if (in_fours < terms) product.noalias() += A.rightCols(terms - in_fours).lazyProduct(B.bottomRows(terms - in_fours));
  return product;
}

}  // namespace flankwright
