#include "core/load/solve/cholesky.hpp"

#include <cmath>

#include "core/base/vector_registers.hpp"

namespace flankwright {

namespace {

/// Replaces an infinite pivot: a number divided by it is 0 beside any other, and its square is still finite.
constexpr double held_pivot = 1e150;

}  // namespace

Eigen::MatrixXd& Cholesky::prepare(Eigen::Index n, Eigen::Index carried) {
  rows_.resize(n + carried, n);
  return rows_;
}

double Cholesky::pivot(double left, Eigen::Index column) {
  if (left > least_pivot * diagonal_[column]) return std::sqrt(left);
  ++singular_;
  return held_pivot;
}

FLANKWRIGHT_WIDE_REGISTERS void Cholesky::factorise() {
  const Eigen::Index n = size(), rows = rows_.rows();
  diagonal_ = rows_.diagonal();
  singular_ = 0;
  double* const start = rows_.data();
  Eigen::Index k = 0;
  for (; k + 4 <= n; k += 4) {
    double *c0 = start + k * rows, *c1 = c0 + rows, *c2 = c1 + rows, *c3 = c2 + rows;
    // The block on the diagonal, by hand.
    const double d0 = c0[k] = pivot(c0[k], k), i0 = 1.0 / d0;
    const double l10 = c0[k + 1] *= i0, l20 = c0[k + 2] *= i0, l30 = c0[k + 3] *= i0;
    const double d1 = c1[k + 1] = pivot(c1[k + 1] - l10 * l10, k + 1), i1 = 1.0 / d1;
    const double l21 = c1[k + 2] = (c1[k + 2] - l20 * l10) * i1, l31 = c1[k + 3] = (c1[k + 3] - l30 * l10) * i1;
    const double d2 = c2[k + 2] = pivot(c2[k + 2] - l20 * l20 - l21 * l21, k + 2), i2 = 1.0 / d2;
    const double l32 = c2[k + 3] = (c2[k + 3] - l30 * l20 - l31 * l21) * i2;
    const double d3 = c3[k + 3] = pivot(c3[k + 3] - l30 * l30 - l31 * l31 - l32 * l32, k + 3), i3 = 1.0 / d3;
    for (Eigen::Index i = k + 4; i < rows; ++i) {
      const double x0 = c0[i] * i0, x1 = (c1[i] - x0 * l10) * i1;
      const double x2 = (c2[i] - x0 * l20 - x1 * l21) * i2, x3 = (c3[i] - x0 * l30 - x1 * l31 - x2 * l32) * i3;
      c0[i] = x0, c1[i] = x1, c2[i] = x2, c3[i] = x3;
    }
    // Subtracts these four from the rest, two columns at a time so that each is read once for both.
    Eigen::Index j = k + 4;
    for (; j + 2 <= n; j += 2) {
      double *p = start + j * rows, *q = p + rows;
      const double u0 = c0[j], u1 = c1[j], u2 = c2[j], u3 = c3[j];
      const double v0 = c0[j + 1], v1 = c1[j + 1], v2 = c2[j + 1], v3 = c3[j + 1];
      p[j] -= (u0 * u0 + u1 * u1) + (u2 * u2 + u3 * u3);  // above the second column's diagonal nothing is read
      for (Eigen::Index i = j + 1; i < rows; ++i) {
        const double x0 = c0[i], x1 = c1[i], x2 = c2[i], x3 = c3[i];
        p[i] -= (x0 * u0 + x1 * u1) + (x2 * u2 + x3 * u3);
        q[i] -= (x0 * v0 + x1 * v1) + (x2 * v2 + x3 * v3);
      }
    }
    if (j == n) continue;
    double* p = start + j * rows;
    const double u0 = c0[j], u1 = c1[j], u2 = c2[j], u3 = c3[j];
    for (Eigen::Index i = j; i < rows; ++i) p[i] -= (c0[i] * u0 + c1[i] * u1) + (c2[i] * u2 + c3[i] * u3);
  }
  for (; k < n; ++k) {
    double* c = start + k * rows;
    const double inverse = 1.0 / (c[k] = pivot(c[k], k));
    for (Eigen::Index i = k + 1; i < rows; ++i) c[i] *= inverse;
    for (Eigen::Index j = k + 1; j < n; ++j) {
      double* p = start + j * rows;
      for (Eigen::Index i = j; i < rows; ++i) p[i] -= c[i] * c[j];
    }
  }
}

double Cholesky::inverse_norm() const {
  const Eigen::Index n = size();
  constexpr int rounds = 5;
  const auto signs_of = [](const Eigen::VectorXd& v) { return Eigen::VectorXd((v.array() < 0.0).select(-Eigen::VectorXd::Ones(v.size()), 1.0)); };
  Eigen::VectorXd v = Eigen::VectorXd::Constant(n, 1.0 / static_cast<double>(n));
  solve(v);
  double norm = v.lpNorm<1>();
  if (n == 1) return norm;
  Eigen::VectorXd signs = signs_of(v);
  Eigen::Index column = -1;
  for (int round = 1; round < rounds; ++round) {
    Eigen::VectorXd gain = signs;
    solve(gain);
    Eigen::Index steepest = 0;
    gain.cwiseAbs().maxCoeff(&steepest);
    if (steepest == column) break;
    column = steepest;
    v.setZero();
    v[column] = 1.0;
    solve(v);
    const double reached = v.lpNorm<1>();
    if (reached <= norm) break;
    norm = reached;
    const Eigen::VectorXd next = signs_of(v);
    if (next == signs) break;
    signs = next;
  }
  // For matrices where cancellation hides the norm from all these.
  for (Eigen::Index i = 0; i < n; ++i) v[i] = (i % 2 == 0 ? 1.0 : -1.0) * (1.0 + static_cast<double>(i) / static_cast<double>(n - 1));
  solve(v);
  return std::max(norm, 2.0 * v.lpNorm<1>() / (3.0 * static_cast<double>(n)));
}

}  // namespace flankwright
