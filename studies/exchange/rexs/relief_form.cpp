#include "studies/exchange/rexs/relief_form.hpp"

#include <algorithm>

namespace flankwright::studies::rexs {

double ReliefForm::at(double share) const {
  if (is_blended()) {
    if (share <= blend_start) return 0.0;
    if (share >= blend_end) return share;
    const double length = blend_end - blend_start, t = (share - blend_start) / length;
    return t * t * (blend_end * (3.0 - 2.0 * t) + length * (t - 1.0));
  }
  const double within = std::max(0.0, share);
  return shape == ReliefShape::Linear ? within : within * within;
}

bool ReliefForm::can_blend() const {
  // With q = blend_end / length the cubic's second derivative is 6 q - 2 at its start and 4 - 6 q at its end: convex where both are positive.
  const double length = blend_end - blend_start;
  return is_blended() && 3.0 * blend_end >= length && 3.0 * blend_end <= 2.0 * length;
}

}  // namespace flankwright::studies::rexs
