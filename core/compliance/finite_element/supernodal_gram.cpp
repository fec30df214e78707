#include "core/compliance/finite_element/supernodal_gram.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

namespace flankwright {
namespace {

/// Rows below a supernode that are multiplied together: enough for BLAS-3, few enough that their product is a small part of the memory.
constexpr int kRowsAtOnce = 512;

using RowSparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// For every supernode the columns of B that reach it, ascending.
std::vector<std::vector<int>> reach(const Supernodes& supernodes, const RowSparse& right_sides) {
  std::vector<std::vector<int>> columns(static_cast<std::size_t>(supernodes.count()));
  for (int row = 0; row < right_sides.rows(); ++row) {
    std::vector<int>& here = columns[supernodes.of_row(supernodes.positions()[row])];
    for (RowSparse::InnerIterator entry(right_sides, row); entry; ++entry) here.push_back(static_cast<int>(entry.col()));
  }
  for (std::vector<int>& here : columns) {
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

SupernodalGram::SupernodalGram(const Supernodes& supernodes, const RowSparse& right_sides, const PanelProducts& products)
    : supernodes_(supernodes),
      right_sides_(right_sides),
      products_(products),
      columns_(reach(supernodes, right_sides)),
      waiting_(columns_.size()),
      gram_(Eigen::MatrixXd::Zero(right_sides.cols(), right_sides.cols())) {
  assert(right_sides.rows() == supernodes.rows());
}

double SupernodalGram::bytes() const {
  double held = 0, most = 0, product = 0, lists = 0;
  std::vector<char> waits(columns_.size(), 0);
  const auto wait = [&](int s) {
    const double entries = static_cast<double>(supernodes_.size(s)) * static_cast<double>(columns_[s].size());
    if (!std::exchange(waits[s], 1)) held += entries;
    return entries;
  };
  for (int s = 0; s < supernodes_.count(); ++s) {
    if (columns_[s].empty()) continue;
    const double own = wait(s);
    lists += static_cast<double>(columns_[s].size());
    const auto count = static_cast<double>(columns_[s].size());
    product =
        std::max({product, count == static_cast<double>(gram_.cols()) ? 0.0 : count * count, count * std::min(kRowsAtOnce, supernodes_.below(s))});
    for (int i = supernodes_.size(s), above = -1; i < supernodes_.height(s); ++i) {
      if (const int next = supernodes_.of_row(supernodes_.row(s, i)); next != above) wait(above = next);
    }
    most = std::max(most, held);
    held -= own;
  }
  return sizeof(double) * (static_cast<double>(gram_.size()) + product + most) + sizeof(int) * lists;
}

Eigen::MatrixXd& SupernodalGram::waiting_at(int s) {
  if (waiting_[s].size() == 0) waiting_[s].setZero(supernodes_.size(s), std::ssize(columns_[s]));
  return waiting_[s];
}

void SupernodalGram::take(int s, const double* block) {
  const std::vector<int>& columns = columns_[s];
  if (columns.empty()) return;
  Eigen::MatrixXd y = std::move(waiting_at(s));
  const int size = supernodes_.size(s);
  for (int i = 0; i < size; ++i) {
    for (RowSparse::InnerIterator entry(right_sides_, supernodes_.original(supernodes_.first_row(s) + i)); entry; ++entry) {
      y(i, std::ranges::lower_bound(columns, entry.col()) - columns.begin()) += entry.value();
    }
  }
  products_.solve_from_left(size, static_cast<int>(y.cols()), block, supernodes_.height(s), y.data(), size);
  add_products(s, y);
  pass_upwards(s, block, y);
}

void SupernodalGram::add_products(int s, const Eigen::MatrixXd& y) {
  const std::vector<int>& columns = columns_[s];
  const auto size = static_cast<int>(y.rows()), count = static_cast<int>(y.cols());
  if (count == gram_.cols()) {  // all columns, in their order
    products_.add_inner(count, size, y.data(), size, 1.0, gram_.data(), count);
    return;
  }
  product_.resize(count, count);
  products_.add_inner(count, size, y.data(), size, 0.0, product_.data(), count);
  for (int j = 0; j < count; ++j) {
    for (int i = j; i < count; ++i) gram_(columns[i], columns[j]) += product_(i, j);
  }
}

void SupernodalGram::pass_upwards(int s, const double* block, const Eigen::MatrixXd& y) {
  const int size = supernodes_.size(s), height = supernodes_.height(s), below = height - size, count = static_cast<int>(y.cols());
  for (int begin = 0; begin < below; begin += kRowsAtOnce) {
    const int rows = std::min(kRowsAtOnce, below - begin);
    product_.resize(rows, count);
    products_.multiply(rows, count, size, block + size + begin, height, y.data(), size, product_.data(), rows);
    for (int i = 0; i < rows;) {
      const auto row = [&](int r) { return supernodes_.row(s, size + begin + r); };
      const int above = supernodes_.of_row(row(i));
      const std::vector<int> there = places_in(columns_[above], columns_[s]);
      Eigen::MatrixXd& w = waiting_at(above);
      int end = i;
      while (end < rows && supernodes_.of_row(row(end)) == above) ++end;
      for (int j = 0; j < count; ++j) {
        for (int r = i; r < end; ++r) w(row(r) - supernodes_.first_row(above), there[j]) -= product_(r, j);
      }
      i = end;
    }
  }
}

Eigen::MatrixXd SupernodalGram::result() && {
  gram_.triangularView<Eigen::StrictlyUpper>() = gram_.transpose();
  return std::move(gram_);
}

}  // namespace flankwright
