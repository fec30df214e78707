#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace flankwright {

/// The spline of SplineAxis by its B-splines: s(x) = sum over i of B_i(x) c_i, of which four are not 0 anywhere, with c
/// = coefficients() f for values f at the nodes. For evaluating one table at many stations.
class LocalSpline {
 public:
  struct Weights {
    Eigen::Index first{0};           ///< of the four B-splines
    std::array<double, 4> values{};  ///< sum 1
  };

  /// @param nodes  strictly increasing, at least 4; not-a-knot: all but the second and the second last are knots
  explicit LocalSpline(const std::vector<double>& nodes);

  /// @param x  clamped to the range of the nodes
  Weights at(double x) const;

  const Eigen::MatrixXd& coefficients() const { return coefficients_; }  ///< n x n

 private:
  std::vector<double> knots_;  ///< n + 4, both ends four times
  Eigen::MatrixXd coefficients_;
};

}  // namespace flankwright
