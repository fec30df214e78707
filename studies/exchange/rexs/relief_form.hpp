#pragma once

#include "core/flank/modifications/relief.hpp"

namespace flankwright::studies::rexs {

/// How the depth of a relief grows, from its start (share 0) to where its depth is reached (share 1).
struct ReliefForm {
  ReliefShape shape{ReliefShape::Linear};
  double blend_start{0.0}, blend_end{0.0};  ///< shares between which a linear relief leaves the flank smoothly; equal: it starts with a kink

  /// Depth at a share, by the depth at share 1. A smooth start is the cubic that touches the flank and the relief's line; where the relief starts in the
  /// middle of it, this is a parabola.
  double at(double share) const;
  bool is_blended() const { return blend_end > blend_start; }
  /// Whether the smooth start is convex, and thus removes material only: the relief starts in the middle third of it.
  bool can_blend() const;
  bool operator==(const ReliefForm&) const = default;
};

}  // namespace flankwright::studies::rexs
