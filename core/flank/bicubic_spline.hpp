#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "core/base/jet.hpp"

namespace flankwright {

/// Samples of a function f(u, v) on a rectangular grid, not necessarily equidistant.
struct GridSamples {
  std::vector<double> u, v;  ///< finite, strictly increasing, at least 2 each
  Eigen::MatrixXd values;    ///< values(i, j) = f(u[i], v[j]), finite
};

/// Number of polynomial pieces of a spline along u and along v.
struct SplinePieces {
  int u{1}, v{1};
};

/// Degree of a spline along a direction with that many points, >= 2: 1 with two points, 2 with three, else 3.
int spline_degree(int points);

/// Most pieces that many points, >= 2, along a direction determine: points - 3, at least 1.
int most_spline_pieces(int points);

struct SplineFit;

/// The pieces of a spline along one direction: piece k lies between joints[k - 1] and joints[k], the first and the last
/// are unbounded. Its polynomials are in the distance from origins[k].
struct SplineNet {
  std::vector<double> joints;
  std::vector<double> origins{0.0};

  std::size_t piece_at(double x) const;
};

/// A function of (u, v) that is a bicubic polynomial on each patch of a rectangular net and twice continuously
/// differentiable in the whole plane.
///
/// Beyond the grid it starts with the value, slope and curvature it has at the border; the curvature fades linearly to
/// zero over L, the outermost interval of the grid on that side, and a straight line follows. At distance d from the
/// border, with f, f' and f'' taken there,
///
///     f + f' d + f'' d^2 (3 L - d)/(6 L)   for d <= L,      f + f' d + f'' L (3 d - L)/6   beyond,
///
/// along u and v alike, at a corner along both. A line from the border on would break the curvature and leave a
/// parabola at once; this leaves it by d/(3 L) of its curvature term. Unlike a continued cubic it grows linearly and
/// its slope stays between f' and f' + f'' L/2, so that it is monotone where these two agree in sign.
class BicubicSpline {
 public:
  /// Zero everywhere.
  BicubicSpline() : patches_(1, Eigen::Matrix4d::Zero()) {}

  /// f and its first and second derivatives, exact up to round-off, anywhere in the plane.
  Jet at(double u, double v) const;

 private:
  friend SplineFit fit_spline(const GridSamples& samples, SplinePieces pieces);

  SplineNet u_, v_;
  std::vector<Eigen::Matrix4d> patches_;  ///< v runs fastest; entry (a, b) multiplies the powers a and b of the distances along u and v
};

/// A spline and how far it passes from the samples it was made from, in their unit.
struct SplineFit {
  BicubicSpline spline;
  double rms{std::numeric_limits<double>::quiet_NaN()};      ///< root of the mean square distance
  double largest{std::numeric_limits<double>::quiet_NaN()};  ///< largest distance
};

/// The tensor-product B-spline with so many pieces that is nearest to the samples by least squares.
///
/// Its breaks are at 1 + k (n - 3)/pieces, k = 1 .. pieces - 1, counted in points from 0 and linear in between, which
/// keeps the fit unique for every allowed number (there is a point inside the support of each B-spline: Schoenberg and
/// Whitney). With most_spline_pieces() the breaks are the third to the third last point: the not-a-knot spline through
/// all samples. With one piece it is a single polynomial. Any bicubic polynomial is reproduced exactly, by any number
/// of pieces. "TCA of real helical gears" writes a patch as M V M^T/36, which this is where knots are equidistant.
///
/// Through scattered samples whose steps differ by more than about ten to one along a direction the spline swings far
/// beyond them; round-off is that of the swing.
///
/// Work grows with the cube of the number of points along a direction.
///
/// @param samples  as described at its fields (asserted)
/// @param pieces   1 .. most_spline_pieces() along each direction (asserted)
SplineFit fit_spline(const GridSamples& samples, SplinePieces pieces);

}  // namespace flankwright
