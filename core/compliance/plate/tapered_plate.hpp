#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "core/compliance/plate/legendre.hpp"

namespace flankwright {

/// Foundation of a plate's edge: deflection and rotation of every piece of the edge under the shear force Q and the
/// moment M that act there per unit length, independent of its neighbours (Winkler), times Young's modulus:
///
///     E w_0 = force Q + cross M,     E phi = cross Q + moment M;     force moment > cross^2.
struct EdgeCompliance {
  double force{0.0};   ///< [-], > 0
  double cross{0.0};   ///< [1/length]
  double moment{0.0};  ///< [1/length^2], > 0
};

/// A rectangular plate supported along one long edge. Its thickness is a function of the height above this edge alone;
/// any unit of length, E = 1.
struct PlateShape {
  std::function<double(double)> thickness;  ///< s(y) > 0; may leave the lowest height as a square root does
  std::vector<double> heights;              ///< ascending: foot, heights where s(y) is not smooth, top; at least two
  double length{0.0};                       ///< of the edge, > 0
  double poissons_ratio{0.3};               ///< nu, 0 <= nu < 0.5
  double shear_factor{5.0 / 6.0};           ///< share of G s that carries shear, > 0
  EdgeCompliance edge;
};

/// Position of a unit load, and the piece of the plate over which it is spread: weights (1 - t^2)^2 each way, t = -1 ..
/// 1 being the distance from the load over half_length and half_height. The part beyond an end of the plate is
/// compensated by a factor on the rest; over the height the load stays inside, so that its moment about the foot is
/// exact.
struct PlateLoad {
  double along{0.0};        ///< x, 0 .. length
  double height{0.0};       ///< y, between foot and top
  double half_length{0.0};  ///< > 0: right under a true point load the deflection of a plate with shear has no limit
  double half_height{0.0};  ///< >= 0; shortened to the distance from foot and top
};

/// Deflections of a moderately thick plate [Reissner 1945; Mindlin 1951] by Ritz' method: w and both rotations are
/// polynomials in x and y that minimise
///
///     1/2 int D [ a_x'^2 + b_y'^2 + 2 nu a_x' b_y' + (1 - nu)/2 (a_y' + b_x')^2 ]
///             + k G s [ (w_x' - a)^2 + (w_y' - b)^2 ] dA  +  1/2 int (w, b) [edge]^-1 (w, b)' dx  -  loads,
///     D = s^3 / (12 (1 - nu^2)),     G = 1 / (2 (1 + nu)),
///
/// a and b being the slopes of the normal along x and y. The other three edges are free. As load and deflection are the
/// same functional, K = phi' A^-1 phi is symmetric and positive semi-definite by construction, and grows towards its
/// limit with the number of polynomials.
class TaperedPlate {
 public:
  /// @param along, up  numbers of polynomials in x and y, >= 2
  /// @throws InvalidInput naming what is out of range
  TaperedPlate(const PlateShape& shape, int along, int up);

  /// E K between the loads, n x n [1/length]: deflection at p under a unit load at q.
  Eigen::MatrixXd influence(std::span<const PlateLoad> loads) const;

  int unknowns() const { return 3 * along_.count() * up_.count(); }

 private:
  /// Coefficients of w under the load's weights, along by up, row by row.
  Eigen::VectorXd functional(const PlateLoad& load) const;

  /// The plate is the same from both of its ends: bending with w and b even along the edge, and a odd, knows nothing of the opposite.
  struct Symmetry {
    std::vector<Eigen::Index> unknowns;  ///< of w, a, b, each along by up
    Eigen::LLT<Eigen::MatrixXd> factor;  ///< of A between these
  };

  LegendreBasis along_, up_;
  GaussRule along_rule_, up_rule_;  ///< exact for weights times polynomials
  std::array<Symmetry, 2> symmetries_;
};

}  // namespace flankwright
