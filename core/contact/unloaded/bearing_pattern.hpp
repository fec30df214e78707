#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/contact/unloaded/transmission_error.hpp"

namespace flankwright {

/// Least distance of the flanks over a run through the mesh, at every point of a grid on one flank: the pattern of a
/// marking compound. The pattern for a thickness t is where the separation is at most t.
struct BearingPattern {
  std::vector<double> radius;  ///< ascending, form circle .. tip, equally spaced [mm]
  std::vector<double> z;       ///< ascending, face end .. face end, own frame, equally spaced [mm]
  /// Smallest separation along the flank normal over a run through the mesh [mm], radius x z, >= 0; infinite where the
  /// point never faces the mate.
  Eigen::MatrixXd separation;

  /// Share of the flank's area (profile arc length x face width) with a separation of at most `thickness` [mm], 0 .. 1.
  /// Each grid cell counts by the fraction of its corners within the thickness.
  double covered(double thickness) const;
};

/// Pattern on one flank.
///
/// The leading pair determines the wheel's angle. At each pinion angle the separation of a flank's point is
///
///     (phi2 of the mesh - phi2 that puts the wheel's flank through the point) r_b2 cos(beta_b)            (pinion)
///
/// and with 1 and 2 exchanged for the wheel, the further turn of the pinion until it touches. It is minimised over phi1
/// while the point lies between form circle, tip circle and face ends of the mate (the ends as on parallel axes: a tilt
/// moves them by some 0.01 mm, less than the grid resolves). For the leading pair it is the distance of the two flanks.
/// Before and after, the lag behind the leading pair is added, so that a pair that lags by less than the thickness
/// marks too, as it does on the test rig. Aligned flanks, without a leading pair, need no special case. Tooth pairs
/// other than 0 take their turn in the pitch analysed and are overlaid, with their own pitch deviations.
///
/// Accuracy: first order in misalignment and modification slope for the factor r_b cos(beta_b), some 1e-3 of the
/// separation. Between the positions and transfer points of the mesh its error is taken as linear: n positions miss at
/// most 1/n^2 of a parabola's peak to peak, and a quarter of spacing x slope jump where the kind of contact changes;
/// separations that are negative by this error are 0. A point faces the mate only within a pitch of the angle at which
/// the undisturbed flanks touch in it.
/// @param mesh       of the same assembly; where it has positions without contact (missing > 0) the separation is
///                   infinite throughout
/// @param rows, columns  grid over radius and z, each >= 2
/// @throws InvalidInput "rows" or "columns"
BearingPattern bearing_pattern(const FlankAssembly& assembly, const UnloadedMesh& mesh, Member member, int rows, int columns);

}  // namespace flankwright
