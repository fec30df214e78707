#pragma once

#include <Eigen/Core>

namespace flankwright {

/// Values or slopes of the first polynomials of a LegendreBasis at one point.
struct LegendreValues {
  Eigen::VectorXd value, slope;
};

/// Legendre polynomials on an interval, normalised so that the integral of p_i p_j over it is 1 where i = j, else 0.
class LegendreBasis {
 public:
  /// @param low, high  ends of the interval, low < high
  /// @param count      polynomials, of degree 0 .. count - 1, >= 1
  LegendreBasis(double low, double high, int count) : low_(low), high_(high), count_(count) {}

  int count() const { return count_; }
  double low() const { return low_; }
  double high() const { return high_; }

  LegendreValues at(double x) const;

  /// C(i, j) = integral of p_i' p_j, exact; as p_i' = sum_j C(i, j) p_j, C C' is the integral of p_i' p_j'.
  Eigen::MatrixXd slope_products() const;

 private:
  double low_, high_;
  int count_;
};

/// Gauss-Legendre rule on [-1, 1]: exact for polynomials of degree 2 n - 1.
struct GaussRule {
  Eigen::VectorXd nodes, weights;
  /// @param n  points, >= 1
  explicit GaussRule(int n);
};

}  // namespace flankwright
