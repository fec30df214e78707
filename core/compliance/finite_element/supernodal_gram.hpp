#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "core/compliance/finite_element/panel_products.hpp"
#include "core/compliance/finite_element/supernodes.hpp"

namespace flankwright {

/// B' A^-1 B of a sparse B, n x k, by a supernodal factor P A P' = L L' of A: the Gram matrix of Y = L^-1 P B, k x k, exactly
/// symmetric, and positive semi-definite to round-off.
///
/// Y is never there as a whole. A column of B reaches the supernodes of its entries and those between them and the root
/// of the elimination tree, a small part of L where its entries are close together. Supernodes are processed upwards
/// once, each with all columns that reach it:
///
///     Y_s = L_ss^-1 W_s,    G += Y_s' Y_s,    W_t -= L_ts Y_s  for the supernodes t above.
///
/// Only what waits above the supernode at work, W_t, is held: at most k times the rows of the largest separators. A block
/// of L is needed once, so that it may go when it was taken.
class SupernodalGram {
 public:
  /// @param supernodes, right_sides, products  must live as long as this; B by rows of A
  SupernodalGram(const Supernodes& supernodes, const Eigen::SparseMatrix<double, Eigen::RowMajor>& right_sides, const PanelProducts& products);

  /// The most that take() and result() hold at one time [bytes].
  double bytes() const;
  /// Takes the supernodes 0, 1, 2 ..., each once.
  /// @param block  its height x size numbers of L, by columns
  void take(int s, const double* block);
  /// After the last of them.
  Eigen::MatrixXd result() &&;

 private:
  Eigen::MatrixXd& waiting_at(int s);
  void add_products(int s, const Eigen::MatrixXd& y);
  void pass_upwards(int s, const double* block, const Eigen::MatrixXd& y);

  const Supernodes& supernodes_;
  const Eigen::SparseMatrix<double, Eigen::RowMajor>& right_sides_;
  const PanelProducts& products_;
  std::vector<std::vector<int>> columns_;  ///< for every supernode the columns of B that reach it, ascending
  std::vector<Eigen::MatrixXd> waiting_;   ///< what those below leave of W_s, by the columns that reach it
  Eigen::MatrixXd gram_, product_;
};

}  // namespace flankwright
