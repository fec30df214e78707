#pragma once

#include <vector>

namespace flankwright {

/// The natural cubic spline through points of rising x: continuous second derivative, 0 at both ends. Beyond these the first and last
/// cubics go on. Two points give a straight line, one a constant.
class NaturalSpline {
 public:
  /// @param x, y  of the same size, at least 1, x strictly rising
  NaturalSpline(std::vector<double> x, std::vector<double> y);

  double operator()(double x) const;

 private:
  std::vector<double> x_, y_, second_;
};

}  // namespace flankwright
