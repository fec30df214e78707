#include "core/compliance/finite_element/sparse_cholesky.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <vector>

#include "tests/core/compliance/finite_element/lattice.hpp"

using namespace flankwright;
using flankwright::test::Lattice;

TEST_CASE("The Gram matrix of half solutions is what full solutions give", "[core][compliance][fe]") {
  const Lattice lattice(9);
  const SparseCholesky factor(lattice.lower, lattice.node_of);
  REQUIRE(factor.status() == FactorStatus::Factorised);
  const Eigen::SparseMatrix<double> loads = lattice.loads();
  const Eigen::MatrixXd gram = factor.gram(loads), dense = loads;
  const Eigen::MatrixXd solved = dense.transpose() * factor.solve(dense);
  CHECK((gram - solved).cwiseAbs().maxCoeff() < 1e-13 * solved.cwiseAbs().maxCoeff());  // round-off
  CHECK(gram == gram.transpose());
  CHECK(gram(1, 1) == gram(2, 2));
  CHECK(gram(1, 1) == gram(1, 2));
  CHECK(gram.row(5).isZero(0));
  CHECK(factor.gram(loads.leftCols(0)).size() == 0);
}
