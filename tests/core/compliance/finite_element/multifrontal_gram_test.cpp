#include "core/compliance/finite_element/multifrontal_gram.hpp"

#include <malloc.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <vector>

#include "core/base/taken.hpp"
#include "tests/core/compliance/finite_element/lattice.hpp"

using namespace flankwright;
using flankwright::test::Lattice;

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// Bytes that are allocated at this moment.
double bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

}  // namespace

TEST_CASE("An elimination that keeps no factor has the Gram matrix of one that does", "[core][compliance][fe]") {
  const Lattice lattice(9);
  const Eigen::SparseMatrix<double> loads = lattice.loads();
  const SparseCholesky factor(lattice.lower, lattice.node_of);
  std::vector<double> progress;
  const MultifrontalGram at_once = multifrontal_gram(Eigen::SparseMatrix<double>(lattice.lower), lattice.node_of, loads, kUnlimited,
                                                     [&](double done) { progress.push_back(done); });
  REQUIRE(at_once.status == FactorStatus::Factorised);
  const Eigen::MatrixXd kept = factor.gram(loads);
  CHECK((at_once.gram - kept).cwiseAbs().maxCoeff() < 1e-13 * kept.cwiseAbs().maxCoeff());  // round-off
  CHECK(at_once.gram == at_once.gram.transpose());
  CHECK(at_once.factor_entries == static_cast<double>(factor.factor_entries()));
  CHECK(std::ranges::is_sorted(progress));
  CHECK(progress.back() == Approx(1).epsilon(1e-12));  // round-off of the sum of all fronts
  CHECK(multifrontal_gram(Eigen::SparseMatrix<double>(lattice.lower), lattice.node_of, loads.leftCols(0), kUnlimited).gram.size() == 0);
  // An order that was made before, as where the loads are made while another matrix is ordered.
  EliminationOrder order(lattice.lower, lattice.node_of, EliminationOrder::Turn::Now);
  REQUIRE(order.is_made());
  CHECK(multifrontal_gram(Eigen::SparseMatrix<double>(lattice.lower), lattice.node_of, loads, kUnlimited, {}, {}, std::move(order)).gram ==
        at_once.gram);
}

TEST_CASE("An elimination finds a motion that nothing holds", "[core][compliance][fe]") {
  // A chain of nodes whose springs along x alone hold nothing: each row sums to zero. The other directions are held.
  const int nodes = 40;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXi node_of(3 * nodes);
  for (int node = 0; node < nodes; ++node) {
    for (int a = 0; a < 3; ++a) {
      const int row = 3 * node + a, neighbours = (node > 0) + (node + 1 < nodes);
      node_of[row] = node;
      entries.emplace_back(row, row, a == 0 ? neighbours : 3.0);
      if (node + 1 < nodes) entries.emplace_back(row + 3, row, -1.0);
    }
  }
  Eigen::SparseMatrix<double> lower(3 * nodes, 3 * nodes), loads(3 * nodes, 1);
  lower.setFromTriplets(entries.begin(), entries.end());
  loads.insert(0, 0) = 1;
  const MultifrontalGram free = multifrontal_gram(Eigen::SparseMatrix<double>(lower), node_of, loads, kUnlimited);
  CHECK(free.status == FactorStatus::NotPositiveDefinite);
  CHECK(free.gram.size() == 0);
  lower.coeffRef(0, 0) += 1;
  const MultifrontalGram held = multifrontal_gram(Eigen::SparseMatrix<double>(lower), node_of, loads, kUnlimited);
  REQUIRE(held.status == FactorStatus::Factorised);
  CHECK(held.gram(0, 0) == Approx(1).epsilon(1e-12));  // the spring to the ground carries all; round-off
}

TEST_CASE("An elimination takes the memory that it names before it begins", "[core][compliance][fe][slow]") {  // sanitizers have their own allocator
  double most = 0;
  const double before = bytes_in_use();
  Lattice lattice(20);
  Eigen::SparseMatrix<double> loads(lattice.lower.rows(), 3 * 400);  // on one side
  for (int i = 0; i < loads.cols(); ++i) loads.insert(i, i) = 1;
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = taken(loads);
  const MultifrontalGram run = multifrontal_gram(std::move(lattice.lower), lattice.node_of, by_rows, kUnlimited,
                                                 [&](double) { most = std::max(most, bytes_in_use() - before); });
  REQUIRE(run.status == FactorStatus::Factorised);
  CAPTURE(most, run.peak_bytes, 8 * run.factor_entries);
  // The allocator's own words and lists of rows come on top; between two supernodes, products of the one are gone.
  CHECK(most < 1.05 * run.peak_bytes);
  CHECK(most > 0.7 * run.peak_bytes);

  const Lattice again(20);
  const MultifrontalGram refused = multifrontal_gram(Eigen::SparseMatrix<double>(again.lower), again.node_of, by_rows, 0.99 * run.peak_bytes);
  CHECK(refused.status == FactorStatus::OutOfMemory);
  CHECK(refused.peak_bytes == run.peak_bytes);
  CHECK(refused.gram.size() == 0);
}
