#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "core/compliance/fitted/influence_sample.hpp"

namespace flankwright::testing {

/// Influence values of a gear that can be had in milliseconds and know nothing of kernels: each tooth a tapered Mindlin
/// plate, clamped at its root, with ends cut obliquely (one acute, one obtuse), solved by Ritz' method with Legendre
/// polynomials; under all teeth an elastic base, k/sqrt(1 + d^2) between places a distance d apart; and a body that
/// twists and tilts. E = m_n = 1. Each part is symmetric and positive semi-definite.
class SyntheticGear {
 public:
  explicit SyntheticGear(GearProportions facts, double skew = 0.25);

  InfluenceSample sample(const std::vector<FlankStation>& points) const;

  /// Radial x axial places on teeth first .. last; axial places closer towards both ends, as Chebyshev's.
  std::vector<FlankStation> grid(int radial, int axial, int first = 0, int last = 0) const;

 private:
  GearProportions facts_;
  Eigen::LDLT<Eigen::MatrixXd> factor_;
};

}  // namespace flankwright::testing
