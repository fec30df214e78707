#include "core/compliance/finite_element/supernodal_gram.hpp"

extern "C" {  // which some vendors' header leaves to us
#include <cblas.h>
}

#include <algorithm>
#include <cassert>
#include <iterator>
#include <vector>

namespace flankwright {
namespace {

/// Rows below a supernode that are multiplied together: enough for BLAS-3, few enough that their product is a small part of the memory.
constexpr int kRowsAtOnce = 512;

using RowSparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Columns of L that share a pattern below their diagonal block, as CHOLMOD stores them: a dense matrix by columns.
class Supernodes {
 public:
  explicit Supernodes(const cholmod_factor& factor)
      : first_(static_cast<const int*>(factor.super)),
        pattern_(static_cast<const int*>(factor.pi)),
        values_(static_cast<const int*>(factor.px)),
        rows_(static_cast<const int*>(factor.s)),
        entries_(static_cast<const double*>(factor.x)),
        count_(static_cast<int>(factor.nsuper)),
        of_row_(factor.n) {
    assert(factor.is_super && factor.is_ll && factor.itype == CHOLMOD_INT);
    for (int s = 0; s < count_; ++s) std::fill(of_row_.begin() + first_[s], of_row_.begin() + first_[s + 1], s);
  }

  int count() const { return count_; }
  int of_row(int row) const { return of_row_[static_cast<std::size_t>(row)]; }
  int first_row(int s) const { return first_[s]; }
  int size(int s) const { return first_[s + 1] - first_[s]; }
  /// Rows of the dense matrix: those of the supernode itself, then those below, ascending.
  int height(int s) const { return pattern_[s + 1] - pattern_[s]; }
  int row(int s, int i) const { return rows_[pattern_[s] + i]; }
  /// height x size, from L_ss on.
  const double* block(int s) const { return entries_ + values_[s]; }
  /// The next one up the elimination tree, -1 of a root.
  int parent(int s) const { return height(s) == size(s) ? -1 : of_row(row(s, size(s))); }

 private:
  const int *first_, *pattern_, *values_, *rows_;
  const double* entries_;
  int count_;
  std::vector<int> of_row_;
};

/// For every supernode the columns of B that reach it, ascending.
/// @param position  of a row of A in L
std::vector<std::vector<int>> reach(const Supernodes& supernodes, const RowSparse& right_sides, const std::vector<int>& position) {
  std::vector<std::vector<int>> columns(static_cast<std::size_t>(supernodes.count()));
  for (int row = 0; row < right_sides.rows(); ++row) {
    std::vector<int>& here = columns[supernodes.of_row(position[row])];
    for (RowSparse::InnerIterator entry(right_sides, row); entry; ++entry) here.push_back(static_cast<int>(entry.col()));
    std::ranges::sort(here);
    here.erase(std::unique(here.begin(), here.end()), here.end());
  }
  std::vector<int> both;
  for (int s = 0; s < supernodes.count(); ++s) {
    const int parent = supernodes.parent(s);
    if (parent < 0 || columns[s].empty()) continue;
    both.clear();
    std::ranges::set_union(columns[s], columns[parent], std::back_inserter(both));
    columns[parent] = both;
  }
  return columns;
}

/// Positions in one list of the columns of another; the first has them all.
std::vector<int> places_in(const std::vector<int>& list, const std::vector<int>& columns) {
  std::vector<int> positions;
  auto at = list.begin();
  for (const int c : columns) {
    at = std::lower_bound(at, list.end(), c);
    positions.push_back(static_cast<int>(at - list.begin()));
  }
  return positions;
}

}  // namespace

Eigen::MatrixXd supernodal_gram(const cholmod_factor& factor, const Eigen::SparseMatrix<double, Eigen::RowMajor>& right_sides) {
  const Supernodes supernodes(factor);
  const auto n = static_cast<Eigen::Index>(factor.n), k = right_sides.cols();
  assert(right_sides.rows() == n);
  const auto* order = static_cast<const int*>(factor.Perm);  // of a row of L in A
  std::vector<int> position(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) position[order[i]] = static_cast<int>(i);
  const std::vector<std::vector<int>> columns = reach(supernodes, right_sides, position);

  std::vector<Eigen::MatrixXd> waiting(columns.size());  // what those below leave of W_s, by the columns that reach it
  const auto waiting_at = [&](int s) -> Eigen::MatrixXd& {
    if (waiting[s].size() == 0) waiting[s].setZero(supernodes.size(s), std::ssize(columns[s]));
    return waiting[s];
  };

  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(k, k), product;
  for (int s = 0; s < supernodes.count(); ++s) {
    if (columns[s].empty()) continue;
    Eigen::MatrixXd y = std::move(waiting_at(s));
    for (int i = 0; i < supernodes.size(s); ++i) {
      for (RowSparse::InnerIterator entry(right_sides, order[supernodes.first_row(s) + i]); entry; ++entry) {
        y(i, std::ranges::lower_bound(columns[s], entry.col()) - columns[s].begin()) += entry.value();
      }
    }
    const int size = supernodes.size(s), height = supernodes.height(s), below = height - size, count = static_cast<int>(y.cols());
    const double* l = supernodes.block(s);
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, size, count, 1.0, l, height, y.data(), size);

    if (count == k) {  // all columns, in their order
      cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, count, size, 1.0, y.data(), size, 1.0, gram.data(), count);
    } else {
      product.resize(count, count);
      cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, count, size, 1.0, y.data(), size, 0.0, product.data(), count);
      for (int j = 0; j < count; ++j) {
        for (int i = j; i < count; ++i) gram(columns[s][i], columns[s][j]) += product(i, j);
      }
    }

    for (int begin = 0; begin < below; begin += kRowsAtOnce) {
      const int rows = std::min(kRowsAtOnce, below - begin);
      product.resize(rows, count);
      cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, rows, count, size, 1.0, l + size + begin, height, y.data(), size, 0.0, product.data(),
                  rows);
      for (int i = 0; i < rows;) {
        const auto row = [&](int r) { return supernodes.row(s, size + begin + r); };
        const int above = supernodes.of_row(row(i));
        const std::vector<int> there = places_in(columns[above], columns[s]);
        Eigen::MatrixXd& w = waiting_at(above);
        int end = i;
        while (end < rows && supernodes.of_row(row(end)) == above) ++end;
        for (int j = 0; j < count; ++j) {
          for (int r = i; r < end; ++r) w(row(r) - supernodes.first_row(above), there[j]) -= product(r, j);
        }
        i = end;
      }
    }
  }
  gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();
  return gram;
}

}  // namespace flankwright
