#include "core/compliance/pair/interval_mean.hpp"

#include <array>
#include <cmath>

namespace flankwright {

namespace {

/// Gauss' four points on -1 .. 1 and their weights as fractions of the interval.
constexpr std::array<double, 4> gauss_node{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
constexpr std::array<double, 4> gauss_share{0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};

bool are_pair(const ContactPoint& a, const ContactPoint& b) {
  return a.interval >= 0 && a.tooth == b.tooth && a.interval == b.interval && a.clearance == 0.0 && b.clearance == 0.0;
}

double between(double a, double b, double t) { return a + t * (b - a); }

}  // namespace

IntervalMean::IntervalMean(const std::vector<ContactPoint>& points) : size_(std::ssize(points)) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactPoint& a = points[i];
    if (i + 1 == points.size() || !are_pair(a, points[i + 1])) {
      fine_.push_back(a);
      shares_.push_back({static_cast<Eigen::Index>(i), 1.0, 0.0});
      continue;
    }
    const ContactPoint& b = points[i + 1];
    const double length = a.weight + b.weight;
    for (std::size_t k = 0; k < gauss_node.size(); ++k) {
      const double t = 0.5 * (1.0 + std::sqrt(3.0) * gauss_node[k]);  // 0 and 1 at the two points
      ContactPoint point = a;
      point.z = between(a.z, b.z, t);
      point.pinion_radius = between(a.pinion_radius, b.pinion_radius, t);
      point.wheel_radius = between(a.wheel_radius, b.wheel_radius, t);
      point.weight = gauss_share[k] * length;
      fine_.push_back(point);
      shares_.push_back({static_cast<Eigen::Index>(i), point.weight / a.weight * (1.0 - t), point.weight / b.weight * t});
    }
    ++i;
  }
}

Eigen::MatrixXd IntervalMean::mean(const Eigen::MatrixXd& fine) const {
  if (std::ssize(fine_) == size_) return fine;
  const Eigen::Index m = std::ssize(fine_);
  const auto add = [&](auto&& into, const Share& share, const auto& column) {
    into.col(share.point) += share.here * column;
    if (share.next != 0.0) into.col(share.point + 1) += share.next * column;
  };
  Eigen::MatrixXd half = Eigen::MatrixXd::Zero(m, size_);  // columns taken together
  for (Eigen::Index q = 0; q < m; ++q) add(half, shares_[static_cast<std::size_t>(q)], fine.col(q));
  const Eigen::MatrixXd rows = half.transpose();
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(size_, size_);
  for (Eigen::Index p = 0; p < m; ++p) add(mean, shares_[static_cast<std::size_t>(p)], rows.col(p));
  mean.triangularView<Eigen::StrictlyUpper>() = mean.transpose();
  return mean;
}

}  // namespace flankwright
