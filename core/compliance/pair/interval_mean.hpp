#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/contact/path/contact_points.hpp"

namespace flankwright {

/// Influence between intervals of contact lines instead of between their points.
///
/// A tooth deflects most within about a module of its load. Points further apart miss most of this, and a sum over them
/// gives a compliance that is too large or too small by some per cent. Here the line load w is linear on each interval,
/// through its two Gauss points, and the work of the structure under it is summed over four points an interval:
///
///     (a w)' K (a w) := (A P w)' K_4 (A P w),
///
/// where P interpolates the loads at the two points to the four, A has the lengths of line that belong to the four, and
/// K_4 is the influence between them. K is symmetric to the last bit, and positive semi-definite as K_4 is, whatever
/// the intervals. It tends to the influence between points as the intervals shrink. Points that belong to no pair of an
/// interval (ContactPoint::interval) stay as they are, and so do those of the extended region, which are close to each
/// other where they carry load.
class IntervalMean {
 public:
  explicit IntervalMean(const std::vector<ContactPoint>& points);

  /// The points that K_4 is wanted between. Radii and z are interpolated between an interval's two points: they are nearly linear there.
  const std::vector<ContactPoint>& points() const { return fine_; }
  /// K between the given points from K_4, n x n [unit of the argument].
  Eigen::MatrixXd mean(const Eigen::MatrixXd& fine) const;

 private:
  /// Fractions of the forces at a coarse point and at the next that act at a fine point, A P a^-1 [-].
  struct Share {
    Eigen::Index point;
    double here, next;
  };

  Eigen::Index size_;  ///< n
  std::vector<ContactPoint> fine_;
  std::vector<Share> shares_;  ///< one a fine point
};

}  // namespace flankwright
