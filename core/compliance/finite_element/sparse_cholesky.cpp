#include "core/compliance/finite_element/sparse_cholesky.hpp"

#include <algorithm>
#include <cassert>
#include <new>

#include "core/compliance/finite_element/one_core.hpp"
#include "core/compliance/finite_element/supernodal_gram.hpp"
#include "core/compliance/finite_element/symbolic_factor.hpp"

namespace flankwright {
namespace {

/// Right-hand sides that are solved together: enough for BLAS-3, few enough to keep the workspace small.
constexpr Eigen::Index kSolveBlock = 48;

}  // namespace

struct SparseCholesky::Factor : SymbolicFactor {
  using SymbolicFactor::SymbolicFactor;

  /// Solves in blocks of columns.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_sides) {
    Eigen::MatrixXd result(right_sides.rows(), right_sides.cols());
    for (Eigen::Index begin = 0; begin < right_sides.cols(); begin += kSolveBlock) {
      const Eigen::Index columns = std::min(kSolveBlock, right_sides.cols() - begin);
      cholmod_dense view{};
      view.nrow = view.d = static_cast<std::size_t>(right_sides.rows());
      view.ncol = static_cast<std::size_t>(columns);
      view.nzmax = view.nrow * view.ncol;
      view.x = const_cast<double*>(right_sides.col(begin).data());
      view.xtype = CHOLMOD_REAL;
      view.dtype = CHOLMOD_DOUBLE;
      cholmod_dense* x = cholmod_solve(CHOLMOD_A, l, &view, &common);
      if (!x) throw std::bad_alloc();
      result.middleCols(begin, columns) = Eigen::Map<const Eigen::MatrixXd>(static_cast<double*>(x->x), right_sides.rows(), columns);
      cholmod_free_dense(&x, &common);
    }
    return result;
  }
};

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXi& node_of) {
  const OneCore serial;
  factor_ = std::make_unique<Factor>(lower, EliminationOrder(lower, node_of, EliminationOrder::Turn::Wait));
  cholmod_common& common = factor_->common;
  cholmod_sparse a = view_of(lower);
  if (factor_->l) cholmod_factorize(&a, factor_->l, &common);
  if (!factor_->l || common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE) {
    status_ = FactorStatus::OutOfMemory;
  } else if (common.status == CHOLMOD_OK && factor_->l->minor == factor_->l->n && cholmod_rcond(factor_->l, &common) > smallest_pivot) {
    status_ = FactorStatus::Factorised;
  } else {
    status_ = FactorStatus::NotPositiveDefinite;
  }
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

std::size_t SparseCholesky::factor_entries() const { return factor_->l ? factor_->l->xsize : 0; }
std::size_t SparseCholesky::peak_bytes() const { return factor_->common.memory_usage; }

Eigen::MatrixXd SparseCholesky::solve(const Eigen::MatrixXd& right_sides) const {
  assert(status_ == FactorStatus::Factorised);
  const OneCore serial;
  return factor_->solve(right_sides);
}

Eigen::MatrixXd SparseCholesky::gram(const Eigen::SparseMatrix<double, Eigen::RowMajor>& right_sides) const {
  assert(status_ == FactorStatus::Factorised);
  const OneCore serial;
  const Supernodes supernodes(*factor_->l);
  const PanelProducts products({});
  SupernodalGram gram(supernodes, right_sides, products);
  for (int s = 0; s < supernodes.count(); ++s) gram.take(s, supernodes.block(s));
  return std::move(gram).result();
}

}  // namespace flankwright
