#include "core/compliance/finite_element/sparse_cholesky.hpp"

#include <cholmod.h>
#include <dlfcn.h>

#include <algorithm>
#include <cassert>
#include <mutex>
#include <new>
#include <vector>

#include "core/base/one_blas_thread.hpp"
#include "core/compliance/finite_element/supernodal_gram.hpp"

namespace flankwright {
namespace {

/// Right-hand sides that are solved together: enough for BLAS-3, few enough to keep the workspace small.
constexpr Eigen::Index kSolveBlock = 48;

/// Keeps OpenMP, with which CHOLMOD assembles and solves, on the calling thread while it lives: its workers would spin
/// against those of the other gear. The switch is the calling thread's own, and looked for as OpenBLAS' is.
class SerialOpenMp {
 public:
  SerialOpenMp() {
    if (!get_ || !set_) return;
    levels_ = get_();
    set_(0);
  }
  ~SerialOpenMp() {
    if (get_ && set_) set_(levels_);
  }
  SerialOpenMp(const SerialOpenMp&) = delete;
  SerialOpenMp& operator=(const SerialOpenMp&) = delete;

 private:
  using Get = int (*)();
  using Set = void (*)(int);
  static inline const Get get_{reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "omp_get_max_active_levels"))};
  static inline const Set set_{reinterpret_cast<Set>(dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"))};
  int levels_{1};
};

/// A turn among our threads, where BLAS needs that.
class BlasTurn {
 public:
  BlasTurn() {
    if (blas_needs_turns()) turn_ = std::unique_lock(turns_);
  }

 private:
  static inline std::mutex turns_;
  std::unique_lock<std::mutex> turn_;
};

/// Keeps CHOLMOD's calls on one core and apart from each other.
struct OneCore {
  BlasTurn turn;
  OneBlasThread blas;
  SerialOpenMp open_mp;
};

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

struct SparseCholesky::Factor {
  mutable cholmod_common common;
  cholmod_factor* l{nullptr};

  Factor() { cholmod_start(&common); }
  ~Factor() {
    cholmod_free_factor(&l, &common);
    cholmod_finish(&common);
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  /// Solves in blocks of columns.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_sides) const {
    const OneCore serial;
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

// Pivots left by the elimination of a rigid motion are round-off, 1e-16 of the largest one times a few powers of ten;
// those of a gear that is held stay above 1e-9.
constexpr double kSmallestPivot = 1e-13;

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double>& lower, const Eigen::VectorXi& node_of) : factor_(std::make_unique<Factor>()) {
  assert(lower.rows() == lower.cols() && lower.isCompressed() && node_of.size() == lower.rows());
  cholmod_common& common = factor_->common;
  common.print = 0;
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.final_ll = 1;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;

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

  const OneCore serial;
  std::vector<int> order = order_rows(lower, node_of, common);
  if (!order.empty()) factor_->l = cholmod_analyze_p(&a, order.data(), nullptr, 0, &common);
  if (factor_->l) cholmod_factorize(&a, factor_->l, &common);
  if (!factor_->l || common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE) {
    status_ = FactorStatus::OutOfMemory;
  } else if (common.status == CHOLMOD_OK && factor_->l->minor == factor_->l->n && cholmod_rcond(factor_->l, &common) > kSmallestPivot) {
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
double SparseCholesky::flops() const { return factor_->common.fl; }

Eigen::MatrixXd SparseCholesky::solve(const Eigen::MatrixXd& right_sides) const {
  assert(status_ == FactorStatus::Factorised);
  return factor_->solve(right_sides);
}

Eigen::MatrixXd SparseCholesky::gram(const Eigen::SparseMatrix<double, Eigen::RowMajor>& right_sides) const {
  assert(status_ == FactorStatus::Factorised);
  const OneCore serial;
  return supernodal_gram(*factor_->l, right_sides);
}

}  // namespace flankwright
