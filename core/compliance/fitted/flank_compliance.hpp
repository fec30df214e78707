#pragma once

#include <Eigen/Core>
#include <span>

#include "core/compliance/fitted/influence_sample.hpp"

namespace flankwright {

/// A structural compliance K(p, q) between any two points of a gear's flanks.
class FlankCompliance {
 public:
  virtual ~FlankCompliance() = default;

  /// E m_n K [-] between n points of the gear, n x n; symmetric to the last bit. Row: where it deflects; column: where
  /// the force acts.
  /// @throws InvalidInput where a point lies off the flank, or two of them further apart than the model knows
  virtual Eigen::MatrixXd evaluate(std::span<const FlankPlace> points) const = 0;

 protected:
  FlankCompliance() = default;
  FlankCompliance(const FlankCompliance&) = default;
  FlankCompliance& operator=(const FlankCompliance&) = default;
};

}  // namespace flankwright
