#include "core/compliance/pair/interval_mean.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>

using namespace flankwright;

namespace {

/// A line of intervals with two Gauss points each, of the given ends.
std::vector<ContactPoint> line(const std::vector<double>& ends) {
  std::vector<ContactPoint> points;
  for (std::size_t j = 0; j + 1 < ends.size(); ++j) {
    const double middle = 0.5 * (ends[j] + ends[j + 1]), half = 0.5 * (ends[j + 1] - ends[j]);
    for (const double side : {-1.0, 1.0}) {
      ContactPoint point;
      point.z = middle + side * half / std::sqrt(3.0);
      point.weight = half;
      point.interval = static_cast<int>(j);
      point.pinion_radius = 20 + 0.1 * point.z;
      point.wheel_radius = 40 - 0.1 * point.z;
      points.push_back(point);
    }
  }
  return points;
}

/// A tooth that deflects within `reach` of its load.
Eigen::MatrixXd kernel(const std::vector<ContactPoint>& points, double reach) {
  const Eigen::Index n = std::ssize(points);
  Eigen::MatrixXd K(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      K(i, j) = std::exp(-std::abs(points[static_cast<std::size_t>(i)].z - points[static_cast<std::size_t>(j)].z) / reach);
    }
  }
  return K;
}

/// Work of an even load by a structure that is seen between intervals, and between points alone.
double work(const std::vector<ContactPoint>& points, const Eigen::MatrixXd& K) {
  Eigen::VectorXd a(std::ssize(points));
  for (Eigen::Index i = 0; i < a.size(); ++i) a[i] = points[static_cast<std::size_t>(i)].weight;
  return 0.5 * a.dot(K * a);
}

}  // namespace

TEST_CASE("Influence between intervals gives the work that a load does on a structure narrower than they are", "[core][compliance][interval-mean]") {
  const double reach = 1.0, length = 12.0;
  const std::vector<ContactPoint> points = line({0, 1, 3, 6, 9, 11, 12});
  const IntervalMean intervals(points);
  // Closed form: the double integral of exp(-|x - y|/r) over 0 .. L is 2 r (L - r (1 - e^(-L/r))).
  const double exact = reach * (length - reach * (1 - std::exp(-length / reach)));
  const double by_intervals = work(points, intervals.mean(kernel(intervals.points(), reach))), by_points = work(points, kernel(points, reach));
  CAPTURE(exact, by_intervals, by_points);
  constexpr double kDiscretisation = 0.05;  // four points on intervals of three reaches: of the kernel's cusp
  CHECK(by_intervals == Approx(exact).epsilon(kDiscretisation));
  CHECK(std::abs(by_intervals - exact) < 0.4 * std::abs(by_points - exact));
}

TEST_CASE("Influence between intervals stays symmetric and positive semi-definite", "[core][compliance][interval-mean]") {
  const std::vector<ContactPoint> points = line({0, 0.3, 1, 4, 8, 9.5, 10});
  const IntervalMean intervals(points);
  const Eigen::MatrixXd K = intervals.mean(kernel(intervals.points(), 0.7));
  CHECK(K == K.transpose());
  constexpr double kRoundOff = 1e-14;
  CHECK(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues()[0] > -kRoundOff);
}

TEST_CASE("A structure as smooth as the intervals are long is the same between points and intervals", "[core][compliance][interval-mean]") {
  // A rigid motion under the load: K constant and linear in z, which two Gauss points integrate exactly.
  const std::vector<ContactPoint> points = line({0, 1, 3, 6, 8, 9});
  const auto rigid = [](const std::vector<ContactPoint>& at) {
    Eigen::MatrixXd K(std::ssize(at), std::ssize(at));
    for (Eigen::Index i = 0; i < K.rows(); ++i) {
      for (Eigen::Index j = 0; j < K.cols(); ++j) K(i, j) = 1 + 0.1 * at[static_cast<std::size_t>(i)].z * at[static_cast<std::size_t>(j)].z;
    }
    return K;
  };
  const IntervalMean intervals(points);
  constexpr double kRoundOff = 1e-13;
  CHECK((intervals.mean(rigid(intervals.points())) - rigid(points)).lpNorm<Eigen::Infinity>() < kRoundOff * 10);
}

TEST_CASE("Points without a partner in their interval stay as they are", "[core][compliance][interval-mean]") {
  std::vector<ContactPoint> points = line({0, 1, 2, 3});
  points.erase(points.begin() + 2);  // one of a pair is gone
  for (ContactPoint& point : points) {
    if (point.interval == 2) point.clearance = 0.01;  // the extended region
  }
  const IntervalMean intervals(points);
  CHECK(intervals.points().size() == 4 + 1 + 2);
  std::vector<ContactPoint> none = line({0, 1, 2});
  for (ContactPoint& point : none) point.interval = -1;
  const IntervalMean apart(none);
  const Eigen::MatrixXd K = kernel(none, 1.0);
  CHECK(apart.points().size() == none.size());
  CHECK(apart.mean(K) == K);
}
