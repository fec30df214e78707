#pragma once

#include <cmath>

#include "core/compliance/tooth/flank_compliance.hpp"

namespace flankwright::testing {

/// A compliance with a distinct value for each pair of stations: (2 + u_p + u_q) / (1 + distance), 1/4 of it for every pitch.
class DistanceCompliance final : public FlankCompliance {
 public:
  static double between(const FlankStation& a, const FlankStation& b) {
    return (2 + a.u + b.u) / (1 + std::abs(a.zeta - b.zeta)) * std::pow(0.25, std::abs(a.tooth - b.tooth));
  }
  Eigen::MatrixXd evaluate(std::span<const FlankStation> points) const override {
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd K(n, n);
    for (Eigen::Index p = 0; p < n; ++p) {
      for (Eigen::Index q = 0; q < n; ++q) {
        K(p, q) = between(points[static_cast<std::size_t>(p)], points[static_cast<std::size_t>(q)]);
      }
    }
    return K;
  }
};

}  // namespace flankwright::testing
