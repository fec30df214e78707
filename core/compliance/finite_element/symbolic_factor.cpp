#include "core/compliance/finite_element/symbolic_factor.hpp"

#include <cassert>
#include <mutex>
#include <vector>

namespace flankwright {
namespace {

/// METIS' nested dissection of the node graph, as an ordering of the rows.
std::vector<int> order_rows(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXi& node_of, cholmod_common& common) {
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
  cholmod_sparse graph{};
  graph.nrow = graph.ncol = static_cast<std::size_t>(groups);
  graph.nzmax = rows.size();
  graph.p = starts.data();
  graph.i = rows.data();
  graph.stype = -1;
  graph.itype = CHOLMOD_INT;
  graph.xtype = CHOLMOD_PATTERN;
  graph.dtype = CHOLMOD_DOUBLE;
  graph.sorted = graph.packed = 1;

  // METIS draws its random numbers from the one generator of the process, seeded at every call: calls take turns.
  static std::mutex turns;
  const std::lock_guard lock(turns);
  std::vector<int> node_order(groups), order;
  if (!cholmod_metis(&graph, nullptr, 0, 0, node_order.data(), &common)) return {};
  order.reserve(n);
  for (const int g : node_order) {
    for (int i = first[g]; i < first[g + 1]; ++i) order.push_back(i);
  }
  return order;
}

}  // namespace

SymbolicFactor::SymbolicFactor(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXi& node_of) {
  assert(lower.rows() == lower.cols() && lower.isCompressed() && node_of.size() == lower.rows());
  cholmod_start(&common);
  common.print = 0;
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.final_ll = 1;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  cholmod_sparse a = view_of(lower);
  std::vector<int> order = order_rows(lower, node_of, common);
  if (!order.empty()) l = cholmod_analyze_p(&a, order.data(), nullptr, 0, &common);
}

SymbolicFactor::~SymbolicFactor() {
  cholmod_free_factor(&l, &common);
  cholmod_finish(&common);
}

cholmod_sparse view_of(const Eigen::SparseMatrix<double>& lower) {
  cholmod_sparse a{};
  a.nrow = a.ncol = static_cast<std::size_t>(lower.rows());
  a.nzmax = static_cast<std::size_t>(lower.nonZeros());
  a.p = const_cast<int*>(lower.outerIndexPtr());
  a.i = const_cast<int*>(lower.innerIndexPtr());
  a.x = const_cast<double*>(lower.valuePtr());
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  return a;
}

}  // namespace flankwright
