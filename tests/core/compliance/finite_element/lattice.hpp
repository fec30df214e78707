#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

namespace flankwright::test {

/// Springs in three directions along the edges of a block of nodes, held softly everywhere: n nodes along x, y and z.
struct Lattice {
  int along;  ///< at least 4
  Eigen::SparseMatrix<double> lower;
  Eigen::VectorXi node_of;

  explicit Lattice(int nodes_along) : along(nodes_along) {
    const int nodes = along * along * along;
    std::vector<Eigen::Triplet<double>> entries;
    node_of.resize(3 * nodes);
    for (int node = 0; node < nodes; ++node) {
      for (int a = 0; a < 3; ++a) {
        const int row = 3 * node + a;
        node_of[row] = node;
        entries.emplace_back(row, row, 7.0 + 0.1 * a);
        for (int b = 0; b < a; ++b) entries.emplace_back(row, 3 * node + b, 0.2);
        int step = 1;
        for (int direction = 0; direction < 3; ++direction, step *= along) {
          if (node / step % along + 1 < along) entries.emplace_back(row + 3 * step, row, a == direction ? -1.5 : -0.7);
        }
      }
    }
    lower.resize(3 * nodes, 3 * nodes);
    lower.setFromTriplets(entries.begin(), entries.end());
  }
  /// Single entries in corners, one of which comes twice, neighbours, a column without entries, and one on everything.
  Eigen::SparseMatrix<double> loads() const {
    const int last = along - 1, mid = along / 2;
    std::vector<Eigen::Triplet<double>> entries{
        {row(0, 0, 0, 0), 0, 1.0},       {row(last, last, last, 2), 1, -2.0},  {row(last, last, last, 2), 2, -2.0},
        {row(mid, mid, mid, 1), 3, 1.0}, {row(mid + 1, mid, mid, 1), 3, -1.0}, {row(0, last, 3, 0), 4, 0.5},
        {row(last, 0, 3, 0), 4, 0.5}};
    for (int i = 0; i < lower.rows(); ++i) entries.emplace_back(i, 6, 0.01 * (i % 17));
    Eigen::SparseMatrix<double> result(lower.rows(), 7);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
  }
  int row(int x, int y, int z, int direction) const { return 3 * (x + along * (y + along * z)) + direction; }
};

}  // namespace flankwright::test
