#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "core/compliance/tooth/flank_compliance.hpp"

namespace flankwright {

/// The parameters that influence values of different gears are compared by.
struct GearProportions {
  int teeth{0};                                                    ///< Z, >= 5
  double helix_angle{std::numeric_limits<double>::quiet_NaN()};    ///< beta [rad]; its sign says which end of the face is acute
  double relative_face{std::numeric_limits<double>::quiet_NaN()};  ///< B = b/m_n [-], > 0
  double profile_shift{0.0};                                       ///< x [-]

  /// @throws InvalidInput naming the parameter out of range
  void validate() const;

  bool operator==(const GearProportions&) const = default;
};

/// Influence values between points of one gear: row p, column q is the deflection at p along the flank normal under a
/// unit force at q along its normal, times E m_n. It is dimensionless and does not depend on the size of the gear.
struct InfluenceSample {
  GearProportions gear;
  std::vector<FlankStation> points;  ///< n
  Eigen::MatrixXd compliance;        ///< E m_n K [-], n x n; NaN where it was not computed
  /// The part of it that is known otherwise, n x n, symmetric; empty: none. The rest is fitted, with errors relative to
  /// the whole.
  Eigen::MatrixXd given{};

  /// `given` of a pair, 0 where there is none.
  double given_at(Eigen::Index p, Eigen::Index q) const { return given.size() == 0 ? 0.0 : given(p, q); }

  /// Reciprocal value of a pair: the mean of both directions, the only one where just one is known, NaN where none is.
  double at(Eigen::Index p, Eigen::Index q) const;

  /// @throws InvalidInput where the matrix does not fit the points, a point is off the flank (|u| <= 1.05, zeta in
  ///         0 .. B), a value on the diagonal is known and not positive, a value is infinite, or `given` is neither
  ///         empty nor finite and as large as the matrix
  void validate() const;
};

}  // namespace flankwright
