#include "core/compliance/finite_element/symbolic_factor.hpp"

#include <cassert>

#include "core/compliance/finite_element/cholmod_view.hpp"

namespace flankwright {

SymbolicFactor::SymbolicFactor(const Eigen::SparseMatrix<double>& lower, const EliminationOrder& order) {
  assert(order.is_made());
  cholmod_start(&common);
  common.print = 0;
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.final_ll = 1;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  cholmod_sparse a = view_of(lower);
  if (!order.rows().empty()) l = cholmod_analyze_p(&a, const_cast<int*>(order.rows().data()), nullptr, 0, &common);
}

SymbolicFactor::~SymbolicFactor() {
  cholmod_free_factor(&l, &common);
  cholmod_finish(&common);
}

cholmod_sparse view_of(const Eigen::SparseMatrix<double>& lower) {
  return lower_view(static_cast<std::size_t>(lower.rows()), static_cast<std::size_t>(lower.nonZeros()), lower.outerIndexPtr(), lower.innerIndexPtr(),
                    lower.valuePtr());
}

}  // namespace flankwright
