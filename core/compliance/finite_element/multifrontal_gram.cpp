#include "core/compliance/finite_element/multifrontal_gram.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "core/base/stopwatch.hpp"
#include "core/base/taken.hpp"
#include "core/compliance/finite_element/one_core.hpp"
#include "core/compliance/finite_element/panel_products.hpp"
#include "core/compliance/finite_element/supernodal_gram.hpp"
#include "core/compliance/finite_element/symbolic_factor.hpp"

namespace flankwright {
namespace {

/// Columns that are factorised entry by entry: fewer than a call of BLAS is worth.
constexpr int kEntryByEntry = 16;

/// L of a dense lower triangle, in place; false where a pivot is not positive.
bool factorise(const PanelProducts& products, int n, double* a, int stride) {
  if (n <= kEntryByEntry) {
    for (int j = 0; j < n; ++j) {
      double* column = a + static_cast<std::ptrdiff_t>(j) * stride;
      if (!(column[j] > 0)) return false;
      column[j] = std::sqrt(column[j]);
      for (int i = j + 1; i < n; ++i) column[i] /= column[j];
      for (int k = j + 1; k < n; ++k) {
        double* next = a + static_cast<std::ptrdiff_t>(k) * stride;
        for (int i = k; i < n; ++i) next[i] -= column[i] * column[k];
      }
    }
    return true;
  }
  const int half = n / 2, rest = n - half;
  double *below = a + half, *last = below + static_cast<std::ptrdiff_t>(half) * stride;
  if (!factorise(products, half, a, stride)) return false;
  products.solve_from_right(rest, half, a, stride, below, stride);
  products.subtract_outer(rest, half, below, stride, last, stride);
  return factorise(products, rest, last, stride);
}

/// Entries of a lower triangle by columns.
std::size_t triangle(int n) { return static_cast<std::size_t>(n) * (static_cast<std::size_t>(n) + 1) / 2; }

/// Sizes of an elimination, from the pattern alone.
struct EliminationPlan {
  std::vector<int> children;  ///< of each supernode
  std::size_t stack{0};       ///< most entries of updates that wait at one time
  std::size_t front{0};       ///< entries of the largest front
  double factor_entries{0};
  double operations{0};  ///< relative

  explicit EliminationPlan(const Supernodes& supernodes) : children(static_cast<std::size_t>(supernodes.count()), 0) {
    std::size_t waits = 0;
    std::vector<std::size_t> taken(children.size(), 0);  // entries of the children's updates
    for (int s = 0; s < supernodes.count(); ++s) {
      const int below = supernodes.below(s), parent = supernodes.parent(s);
      waits -= taken[s];
      waits += triangle(below);
      stack = std::max(stack, waits);
      front = std::max(front, static_cast<std::size_t>(supernodes.height(s)) * supernodes.size(s) + static_cast<std::size_t>(below) * below);
      factor_entries += static_cast<double>(supernodes.height(s)) * supernodes.size(s);
      operations += operations_of(supernodes, s);
      if (parent < 0) continue;
      ++children[parent];
      taken[parent] += triangle(below);
    }
  }
  static double operations_of(const Supernodes& supernodes, int s) {
    const double size = supernodes.size(s), height = supernodes.height(s);
    return size * height * height;
  }
};

/// The fronts of one elimination after the other.
class Fronts {
 public:
  Fronts(const Supernodes& supernodes, const EliminationPlan& plan, const Eigen::SparseMatrix<double>& ordered, const PanelProducts& products)
      : supernodes_(supernodes),
        plan_(plan),
        ordered_(ordered),
        products_(products),
        stack_(std::make_unique_for_overwrite<double[]>(plan.stack)),
        front_(std::make_unique_for_overwrite<double[]>(plan.front)),
        place_(static_cast<std::size_t>(supernodes.rows())) {}

  /// Block of L of the next supernode, until the next call; null where a pivot is not positive.
  const double* eliminate(int s) {
    const int size = supernodes_.size(s), height = supernodes_.height(s), below = height - size;
    double *block = front_.get(), *update = block + static_cast<std::size_t>(height) * size;
    for (int j = 0; j < size; ++j) clear_column(block, height, j);
    for (int j = 0; j < below; ++j) clear_column(update, below, j);
    for (int i = 0; i < height; ++i) place_[supernodes_.row(s, i)] = i;
    for (int j = 0; j < size; ++j) {
      double* column = block + static_cast<std::size_t>(j) * height;
      for (Eigen::SparseMatrix<double>::InnerIterator entry(ordered_, supernodes_.first_row(s) + j); entry; ++entry) {
        column[place_[entry.row()]] += entry.value();
      }
    }
    for (int child = 0; child < plan_.children[s]; ++child) take_update(s, block, update);

    if (!factorise(products_, size, block, height)) return nullptr;
    for (int j = 0; j < size; ++j) {
      const double pivot = block[static_cast<std::size_t>(j) * height + j];
      least_ = std::min(least_, pivot);
      most_ = std::max(most_, pivot);
    }
    if (below == 0) return block;
    products_.solve_from_right(below, size, block, height, block + size, height);
    products_.subtract_outer(below, size, block + size, height, update, below);
    leave_update(s, update);
    return block;
  }

  /// Smallest over largest pivot so far.
  double pivots() const { return (least_ / most_) * (least_ / most_); }

 private:
  /// In a lower triangle, the only part of a front that is read.
  static void clear_column(double* triangle, int rows, int column) {
    std::fill_n(triangle + static_cast<std::size_t>(column) * rows + column, rows - column, 0.0);
  }

  /// Adds the update on top of the stack to the front of its parent s.
  void take_update(int s, double* block, double* update) {
    const int child = waiting_.back(), size = supernodes_.size(s), height = supernodes_.height(s), below = supernodes_.below(child);
    assert(supernodes_.parent(child) == s);
    waiting_.pop_back();
    top_ -= triangle(below);
    const double* from = stack_.get() + top_;
    places_.resize(static_cast<std::size_t>(below));
    for (int i = 0; i < below; ++i) places_[i] = place_[supernodes_.row(child, supernodes_.size(child) + i)];
    for (int j = 0; j < below; ++j) {
      const int column = places_[j];
      double* to = column < size ? block + static_cast<std::size_t>(column) * height
                                 : update + static_cast<std::size_t>(column - size) * (height - size) - size;
      for (int i = j; i < below; ++i) to[places_[i]] += *from++;
    }
  }

  void leave_update(int s, const double* update) {
    const int below = supernodes_.below(s);
    double* to = stack_.get() + top_;
    for (int j = 0; j < below; ++j) to = std::copy_n(update + static_cast<std::size_t>(j) * below + j, below - j, to);
    waiting_.push_back(s);
    top_ += triangle(below);
  }

  const Supernodes& supernodes_;
  const EliminationPlan& plan_;
  const Eigen::SparseMatrix<double>& ordered_;
  const PanelProducts& products_;
  std::unique_ptr<double[]> stack_, front_;  ///< written before they are read
  std::size_t top_{0};                       ///< entries on the stack
  std::vector<int> waiting_;                 ///< supernodes whose updates are on the stack
  std::vector<int> place_;                   ///< of every row of L, in the front at work
  std::vector<int> places_;
  double least_{std::numeric_limits<double>::infinity()}, most_{0};
};

/// P A P', lower triangle.
Eigen::SparseMatrix<double> in_order(const Eigen::SparseMatrix<double>& lower, const Supernodes& supernodes) {
  Eigen::SparseMatrix<double> ordered(lower.rows(), lower.cols());
  const Eigen::PermutationMatrix<Eigen::Dynamic> order(supernodes.positions());
  ordered.selfadjointView<Eigen::Lower>() = lower.selfadjointView<Eigen::Lower>().twistedBy(order);
  return ordered;
}

template <class Matrix>
double bytes_of(const Matrix& sparse) {
  return static_cast<double>(sparse.nonZeros()) * (sizeof(double) + sizeof(int)) + static_cast<double>(sparse.outerSize()) * sizeof(int);
}

MultifrontalGram eliminate(Eigen::SparseMatrix<double> lower, const Eigen::VectorXi& node_of,
                           const Eigen::SparseMatrix<double, Eigen::RowMajor>& right_sides, double memory_limit, const EliminationProgress& progress,
                           const ForEachIndex& for_each, EliminationOrder order) {
  const Stopwatch clock;
  const OneCore serial;
  const PanelProducts products(for_each);
  MultifrontalGram result;
  if (!order.is_made()) order = EliminationOrder(lower, node_of, EliminationOrder::Turn::Wait);
  const SymbolicFactor symbolic(lower, order);
  if (symbolic.l == nullptr) throw std::bad_alloc();
  const Supernodes supernodes(*symbolic.l);
  const EliminationPlan plan(supernodes);
  SupernodalGram gram(supernodes, right_sides, products);
  const double matrix = bytes_of(lower), numbers = sizeof(double) * static_cast<double>(plan.stack + plan.front);
  result.factor_entries = plan.factor_entries;
  result.peak_bytes = bytes_of(right_sides) + static_cast<double>(symbolic.common.memory_inuse) + matrix + std::max(matrix, numbers + gram.bytes());
  result.analysis_seconds = clock.seconds();
  if (result.peak_bytes > memory_limit) {
    result.status = FactorStatus::OutOfMemory;
    return result;
  }
  const Eigen::SparseMatrix<double> ordered = in_order(taken(lower), supernodes);
  Fronts fronts(supernodes, plan, ordered, products);
  double done = 0;
  for (int s = 0; s < supernodes.count(); ++s) {
    const double* block = fronts.eliminate(s);
    if (block == nullptr) return result;
    gram.take(s, block);
    done += EliminationPlan::operations_of(supernodes, s);
    if (progress) progress(done / plan.operations);
  }
  if (!(fronts.pivots() > smallest_pivot)) return result;
  result.gram = std::move(gram).result();
  result.status = FactorStatus::Factorised;
  return result;
}

}  // namespace

MultifrontalGram multifrontal_gram(Eigen::SparseMatrix<double>&& lower, const Eigen::VectorXi& node_of,
                                   const Eigen::SparseMatrix<double, Eigen::RowMajor>& right_sides, double memory_limit,
                                   const EliminationProgress& progress, const ForEachIndex& for_each, EliminationOrder order) {
  try {
    return eliminate(taken(lower), node_of, right_sides, memory_limit, progress, for_each, std::move(order));
  } catch (const std::bad_alloc&) {
    MultifrontalGram result;
    result.status = FactorStatus::OutOfMemory;
    return result;
  }
}

}  // namespace flankwright
