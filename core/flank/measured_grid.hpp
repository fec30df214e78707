#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "core/gear/deviation_field.hpp"
#include "core/gear/flank_frame.hpp"

namespace flankwright {

/// A real flank against the involute helicoid, measured or designed, at the points of a rectangular grid over radius
/// and z. Sign and unit inside are those of a measuring machine: normal to the flank, + = metal added.
struct MeasuredGrid {
  std::vector<double> radii;  ///< above the base radius [mm]
  std::vector<double> z;      ///< axial positions from mid face [mm]
  Eigen::MatrixXd deviation;  ///< delta_n(i, j) at radii[i], z[j] [mm], |delta_n| <= largest_grid_deviation
};

/// Number of radii and of axial positions: at least 2, at most this; work grows with its cube.
inline constexpr int most_grid_lines = 500;
/// |radius| and |z| <= this [mm].
inline constexpr double largest_grid_length = 1e4;
/// Least distance between neighbouring radii or axial positions [mm]; closer ones are the same point, measured twice.
inline constexpr double smallest_grid_step = 1e-3;
/// [mm]; beyond a millimetre it is no micro-geometry.
inline constexpr double largest_grid_deviation = 1.0;

/// Throws InvalidInput, field "grid", where the grid breaks one of these bounds.
void validate(const MeasuredGrid& grid, double base_radius);

/// The part of the active flank (start of active profile to tip, all of the face) that a grid spans. Contact elsewhere
/// sees the extension of BicubicSpline.
struct GridCoverage {
  double profile{not_given};  ///< share of the active roll length, 0 .. 1
  double face{not_given};     ///< share of the face width, 0 .. 1
};

/// Each border of a grid may be short of that of the active flank by this share of the flank's extent (roll length,
/// face width).
inline constexpr double widest_grid_margin = 0.25;

/// Coverage of a valid grid. Throws InvalidInput, field "grid", where a margin is wider than widest_grid_margin: an
/// axial position counted from a face end, or a diameter instead of a radius, would otherwise leave the flank to
/// extrapolation.
GridCoverage check_coverage(const MeasuredGrid& grid, const FlankFrame& frame);

/// Options of the surface through a grid.
struct GridFitOptions {
  /// Number of polynomial pieces along the profile and along the face, 1 .. most_spline_pieces(points); the fewer, the
  /// smoother, see fit_spline(). Empty: the surface passes through every point, noise included. The extension magnifies
  /// noise: at the borders of the flank, half an interval or more beyond a 9 x 15 grid, three to eight times and at the
  /// corners up to 46 times where it interpolates, two to four and at most eight times with three pieces.
  std::optional<int> profile_pieces, face_pieces;
};

/// A grid as a flank wants it, and the distances between its points and the surface, normal to the flank.
struct GridFit {
  std::shared_ptr<const DeviationField> field;
  double rms{not_given};      ///< root of the mean square [mm]
  double largest{not_given};  ///< [mm]
};

/// The field D(rho, z) = -delta_n/cos(beta_b), a bicubic spline in roll length and z. "TCA of real helical gears" has
/// it in radius and z; in roll length the derivatives come without a chain rule, and the involute's own length grows
/// evenly near the base circle.
///
/// D keeps roll length and z of a point while delta_n moves it along its normal. The two points differ by delta_n
/// tan(beta_b) along the flank, and D by that times its slope, which is left out: 0.05 um where 50 um change over 20 mm
/// at 23 deg.
///
/// @param base_radius       r_b of the gear [mm]
/// @param base_helix_angle  |beta_b| [rad], below pi/2
/// @throws InvalidInput with field "grid" as validate() does, or where the flank folds over itself (between two
/// neighbouring radii D changes by at least as much as rho); with field "grid.profile_pieces" or "grid.face_pieces"
/// where these are out of range
GridFit make_grid_field(const MeasuredGrid& grid, double base_radius, double base_helix_angle, const GridFitOptions& options = {});

}  // namespace flankwright
