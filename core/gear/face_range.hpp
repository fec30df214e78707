#pragma once

#include <limits>

namespace flankwright {

/// The part of a face width on which a flank may touch, in the frame of its gear: z = 0 at mid face.
struct FaceRange {
  double begin{std::numeric_limits<double>::quiet_NaN()}, end{std::numeric_limits<double>::quiet_NaN()};  ///< z [mm], begin < end

  double width() const { return end - begin; }
  double half() const { return 0.5 * (end - begin); }
  double middle() const { return 0.5 * (begin + end); }
  /// Inside, or outside by at most `round_off` half widths.
  bool holds(double z, double round_off = 0.0) const { return z >= begin - round_off * half() && z <= end + round_off * half(); }
  /// The end on whose side of the middle z lies.
  double end_near(double z) const { return z < middle() ? begin : end; }
};

}  // namespace flankwright
