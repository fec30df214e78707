#include "core/compliance/finite_element/elimination_order.hpp"

#include <cassert>
#include <mutex>

#include "core/compliance/finite_element/cholmod_view.hpp"

namespace flankwright {
namespace {

std::vector<int> order_rows(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXi& node_of) {
  const auto n = static_cast<int>(lower.rows());
  std::vector<int> group(n), first;  // consecutive numbers of the nodes that have rows
  for (int i = 0; i < n; ++i) {
    if (i == 0 || node_of[i] != node_of[i - 1]) first.push_back(i);
    group[i] = static_cast<int>(first.size()) - 1;
  }
  const auto groups = static_cast<int>(first.size());
  first.push_back(n);

  // Lower triangle of the graph: one column of the matrix represents its node.
  std::vector<int> starts{0}, rows;
  for (int g = 0; g < groups; ++g) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, first[g]); entry; ++entry) {
      const int other = group[entry.row()];
      if (rows.size() == static_cast<std::size_t>(starts.back()) || rows.back() != other) rows.push_back(other);
    }
    starts.push_back(static_cast<int>(rows.size()));
  }
  cholmod_sparse graph = lower_view(static_cast<std::size_t>(groups), rows.size(), starts.data(), rows.data(), nullptr);

  cholmod_common common;
  cholmod_start(&common);
  common.print = 0;
  std::vector<int> node_order(groups), order;
  const bool is_ordered = cholmod_metis(&graph, nullptr, 0, 0, node_order.data(), &common);
  cholmod_finish(&common);
  if (!is_ordered) return {};
  order.reserve(n);
  for (const int g : node_order) {
    for (int i = first[g]; i < first[g + 1]; ++i) order.push_back(i);
  }
  return order;
}

std::mutex turns;  // METIS seeds the one generator at every call

}  // namespace

EliminationOrder::EliminationOrder(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXi& node_of, Turn turn) {
  assert(lower.rows() == lower.cols() && lower.isCompressed() && node_of.size() == lower.rows());
  std::unique_lock lock(turns, std::defer_lock);
  if (turn == Turn::Wait) {
    lock.lock();
  } else if (!lock.try_lock()) {
    return;
  }
  rows_ = order_rows(lower, node_of);
  is_made_ = true;
}

}  // namespace flankwright
