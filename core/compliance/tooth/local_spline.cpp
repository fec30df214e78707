#include "core/compliance/tooth/local_spline.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>

namespace flankwright {

LocalSpline::LocalSpline(const std::vector<double>& nodes) {
  assert(nodes.size() >= 4);
  knots_.assign(4, nodes.front());
  knots_.insert(knots_.end(), nodes.begin() + 2, nodes.end() - 2);
  knots_.insert(knots_.end(), 4, nodes.back());
  const auto n = static_cast<Eigen::Index>(nodes.size());
  Eigen::MatrixXd at_nodes = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Weights weights = at(nodes[static_cast<std::size_t>(i)]);
    for (int k = 0; k < 4; ++k) at_nodes(i, weights.first + k) = weights.values[static_cast<std::size_t>(k)];
  }
  coefficients_ = at_nodes.partialPivLu().inverse();
}

LocalSpline::Weights LocalSpline::at(double x) const {
  x = std::clamp(x, knots_.front(), knots_.back());
  // The interval between knots that x lies in, the last one's end included.
  const auto above = std::upper_bound(knots_.begin() + 4, knots_.end() - 4, x);
  const double* t = knots_.data() + (above - knots_.begin()) - 1;  // t[0] <= x <= t[1]
  Weights result;
  result.first = above - knots_.begin() - 4;
  // Degree by degree, from the one constant that is 1 here (Cox and de Boor).
  std::array<double, 4>& b = result.values;
  b = {1, 0, 0, 0};
  for (int degree = 1; degree <= 3; ++degree) {
    double carried = 0;
    for (int i = 0; i < degree; ++i) {
      const double upper = t[i + 1], lower = t[i + 1 - degree];
      const double share = b[static_cast<std::size_t>(i)] / (upper - lower);
      b[static_cast<std::size_t>(i)] = carried + (upper - x) * share;
      carried = (x - lower) * share;
    }
    b[static_cast<std::size_t>(degree)] = carried;
  }
  return result;
}

}  // namespace flankwright
