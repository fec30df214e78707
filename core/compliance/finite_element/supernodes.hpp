#pragma once

#include <cholmod.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstddef>
#include <vector>

namespace flankwright {

/// The supernodes of CHOLMOD's factor P A P' = L L', whose numbers need not be there: columns of L that share a pattern
/// below their diagonal block, a dense matrix by columns. Numbered upwards: children come before their parent.
class Supernodes {
 public:
  /// @param factor  supernodal, must live as long as this
  explicit Supernodes(const cholmod_factor& factor);

  int count() const { return count_; }
  Eigen::Index rows() const { return std::ssize(of_row_); }
  int of_row(int row) const { return of_row_[static_cast<std::size_t>(row)]; }
  int first_row(int s) const { return first_[s]; }
  int size(int s) const { return first_[s + 1] - first_[s]; }
  /// Rows of the dense matrix: those of the supernode itself, then those below, ascending.
  int height(int s) const { return pattern_[s + 1] - pattern_[s]; }
  int below(int s) const { return height(s) - size(s); }
  int row(int s, int i) const { return rows_[pattern_[s] + i]; }
  /// height x size, from L_ss on; only where the factor has its numbers.
  const double* block(int s) const { return entries_ + values_[s]; }
  /// The next one up the elimination tree, -1 of a root.
  int parent(int s) const { return below(s) == 0 ? -1 : of_row(row(s, size(s))); }
  /// The row of A that is row i of L.
  int original(int i) const { return order_[i]; }
  /// The row of L that each row of A is.
  const Eigen::VectorXi& positions() const { return positions_; }

 private:
  const int *first_, *pattern_, *values_, *rows_, *order_;
  const double* entries_;
  int count_;
  std::vector<int> of_row_;
  Eigen::VectorXi positions_;
};

}  // namespace flankwright
