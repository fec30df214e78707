#include "core/compliance/finite_element/supernodes.hpp"

#include <algorithm>
#include <cassert>

namespace flankwright {

Supernodes::Supernodes(const cholmod_factor& factor)
    : first_(static_cast<const int*>(factor.super)),
      pattern_(static_cast<const int*>(factor.pi)),
      values_(static_cast<const int*>(factor.px)),
      rows_(static_cast<const int*>(factor.s)),
      order_(static_cast<const int*>(factor.Perm)),
      entries_(static_cast<const double*>(factor.x)),
      count_(static_cast<int>(factor.nsuper)),
      of_row_(factor.n),
      positions_(static_cast<Eigen::Index>(factor.n)) {
  assert(factor.is_super && factor.itype == CHOLMOD_INT);
  for (int s = 0; s < count_; ++s) std::fill(of_row_.begin() + first_[s], of_row_.begin() + first_[s + 1], s);
  for (Eigen::Index i = 0; i < positions_.size(); ++i) positions_[order_[i]] = static_cast<int>(i);
}

}  // namespace flankwright
