#pragma once

#include <Eigen/Core>
#include <span>

namespace flankwright {

/// A point on a flank of one gear, in coordinates that mean the same on every gear.
struct FlankStation {
  int tooth{0};      ///< m, counted counter-clockwise as in GearToMesh; only differences matter
  double u{0.0};     ///< 2 (r - r_j)/(r_a - r_j) - 1 [-]: -1 where the involute starts, +1 at the tip
  double zeta{0.0};  ///< z/m_n [-] from the acute end of the face, 0 .. B

  bool operator==(const FlankStation&) const = default;
};

/// A structural compliance K(p, q) between any two points of one gear's flanks.
class FlankCompliance {
 public:
  virtual ~FlankCompliance() = default;

  /// E m_n K [-] between n points of the gear, n x n; symmetric to the last bit, positive semi-definite to round-off.
  /// Row: where it deflects; column: where the force acts; both along the inward normals.
  /// @throws InvalidInput where a point lies off the flank, or two of them further apart than the model covers
  virtual Eigen::MatrixXd evaluate(std::span<const FlankStation> points) const = 0;

 protected:
  FlankCompliance() = default;
  FlankCompliance(const FlankCompliance&) = default;
  FlankCompliance& operator=(const FlankCompliance&) = default;
};

}  // namespace flankwright
