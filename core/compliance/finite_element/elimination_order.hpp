#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

namespace flankwright {

/// An order of elimination of a sparse matrix of node blocks: the rows of A, one after the other. METIS' nested dissection of the graph of the nodes.
class EliminationOrder {
 public:
  /// METIS draws its random numbers from the one generator of the process, so that matrices take turns.
  enum class Turn {
    Wait,
    Now,  ///< not made where another matrix has its turn: there may be other work meanwhile
  };
  EliminationOrder() = default;
  /// @param lower, node_of  as SparseCholesky
  EliminationOrder(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXi& node_of, Turn turn);

  bool is_made() const { return is_made_; }
  /// Empty where memory did not suffice.
  const std::vector<int>& rows() const { return rows_; }

 private:
  bool is_made_{false};
  std::vector<int> rows_;
};

}  // namespace flankwright
