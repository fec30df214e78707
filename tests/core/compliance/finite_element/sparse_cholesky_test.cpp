#include "core/compliance/finite_element/sparse_cholesky.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <vector>

using namespace flankwright;

namespace {

/// Springs in three directions along the edges of a block of nodes, held softly everywhere: n nodes along x, y and z.
struct Lattice {
  int along;
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
  int row(int x, int y, int z, int direction) const { return 3 * (x + along * (y + along * z)) + direction; }
};

}  // namespace

TEST_CASE("The Gram matrix of half solutions is what full solutions give", "[core][compliance][fe]") {
  const Lattice lattice(9);
  const SparseCholesky factor(lattice.lower, lattice.node_of);
  REQUIRE(factor.status() == FactorStatus::Factorised);
  // Single entries in corners, one of which comes twice, neighbours, a column without entries, and one on everything.
  std::vector<Eigen::Triplet<double>> entries{
      {lattice.row(0, 0, 0, 0), 0, 1.0},  {lattice.row(8, 8, 8, 2), 1, -2.0}, {lattice.row(8, 8, 8, 2), 2, -2.0}, {lattice.row(4, 4, 4, 1), 3, 1.0},
      {lattice.row(5, 4, 4, 1), 3, -1.0}, {lattice.row(0, 8, 3, 0), 4, 0.5},  {lattice.row(8, 0, 3, 0), 4, 0.5}};
  for (int row = 0; row < lattice.lower.rows(); ++row) entries.emplace_back(row, 6, 0.01 * (row % 17));
  Eigen::SparseMatrix<double> loads(lattice.lower.rows(), 7);
  loads.setFromTriplets(entries.begin(), entries.end());

  const Eigen::MatrixXd gram = factor.gram(loads), dense = loads;
  const Eigen::MatrixXd solved = dense.transpose() * factor.solve(dense);
  CHECK((gram - solved).cwiseAbs().maxCoeff() < 1e-13 * solved.cwiseAbs().maxCoeff());  // round-off
  CHECK(gram == gram.transpose());
  CHECK(gram(1, 1) == gram(2, 2));
  CHECK(gram(1, 1) == gram(1, 2));
  CHECK(gram.row(5).isZero(0));
  CHECK(factor.gram(loads.leftCols(0)).size() == 0);
}
