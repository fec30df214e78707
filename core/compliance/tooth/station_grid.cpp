#include "core/compliance/tooth/station_grid.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.hpp"

namespace flankwright {
namespace {

constexpr double kRoundOff = 1e-9;  // of stations that were computed from radii and axial positions

double within(const char* field, double value, double low, double high) {
  if (!(value >= low - kRoundOff && value <= high + kRoundOff)) {
    throw InvalidInput(field, std::to_string(value), std::to_string(low) + " to " + std::to_string(high));
  }
  return std::clamp(value, low, high);
}

void check_axis(const char* field, const std::vector<double>& nodes) {
  const bool increasing = std::ranges::adjacent_find(nodes, [](double a, double b) { return !(a < b); }) == nodes.end();
  const bool finite = std::ranges::all_of(nodes, [](double x) { return std::isfinite(x); });
  if (nodes.size() < 4 || !increasing || !finite) {
    throw InvalidInput(field, std::to_string(nodes.size()) + " values", "at least 4, finite, strictly increasing");
  }
}

/// s'' at the nodes of the not-a-knot spline, as a linear map of the values.
Eigen::MatrixXd spline_curvatures(const std::vector<double>& x) {
  const auto n = static_cast<Eigen::Index>(x.size());
  const auto step = [&](Eigen::Index i) { return x[static_cast<std::size_t>(i + 1)] - x[static_cast<std::size_t>(i)]; };
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(n, n), right = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 1; i + 1 < n; ++i) {  // s' is continuous
    const double a = step(i - 1), b = step(i);
    left.row(i).segment<3>(i - 1) << a, 2 * (a + b), b;
    right.row(i).segment<3>(i - 1) << 6 / a, -6 / a - 6 / b, 6 / b;
  }
  for (const Eigen::Index i : {Eigen::Index{1}, n - 2}) {  // s''' is continuous
    const double a = step(i - 1), b = step(i);
    left.row(i == 1 ? 0 : n - 1).segment<3>(i - 1) << -b, a + b, -a;
  }
  return left.partialPivLu().solve(right);
}

}  // namespace

SplineAxis::SplineAxis(std::vector<double> nodes) : nodes_(std::move(nodes)) {
  check_axis("nodes", nodes_);
  curvatures_ = spline_curvatures(nodes_);
}

Eigen::VectorXd SplineAxis::weights(double x) const {
  x = std::clamp(x, nodes_.front(), nodes_.back());
  const auto above = std::upper_bound(nodes_.begin(), nodes_.end() - 1, x) - nodes_.begin();
  const auto i = static_cast<std::size_t>(above - 1);
  const double h = nodes_[i + 1] - nodes_[i], t = (x - nodes_[i]) / h, s = 1 - t;
  const auto row = static_cast<Eigen::Index>(i);
  Eigen::VectorXd result = h * h / 6 * ((s * s * s - s) * curvatures_.row(row) + (t * t * t - t) * curvatures_.row(row + 1)).transpose();
  result[row] += s;
  result[row + 1] += t;
  return result;
}

StationGrid::StationGrid(std::vector<double> us, std::vector<double> zetas) : u_(std::move(us)), zeta_(std::move(zetas)) {
  const auto check_end = [](const char* field, double value, double allowed) {
    if (value != allowed) throw InvalidInput(field, std::to_string(value) + " at an end", std::to_string(allowed));
  };
  check_end("us", u_.nodes().front(), -1);
  check_end("us", u_.nodes().back(), 1);
  check_end("zetas", zeta_.nodes().front(), 0);
}

std::vector<FlankStation> StationGrid::stations(int tooth) const {
  std::vector<FlankStation> result;
  for (const double u : us()) {
    for (const double zeta : zetas()) result.push_back({tooth, u, zeta});
  }
  return result;
}

void StationGrid::require_on_flank(const FlankStation& station) const {
  within("place.u", station.u, -1, 1);
  within("place.zeta", station.zeta, 0, face_width());
}

StationGrid::Factors StationGrid::weight_factors(const FlankStation& station) const {
  return {u_.weights(within("place.u", station.u, -1, 1)), zeta_.weights(within("place.zeta", station.zeta, 0, face_width()))};
}

Eigen::VectorXd StationGrid::weights(const FlankStation& station) const {
  const auto [along_u, along_zeta] = weight_factors(station);
  return (along_zeta * along_u.transpose()).reshaped();
}

std::vector<double> axial_stations(double face_width, const AxialSteps& steps) {
  if (!(face_width > 0) || !std::isfinite(face_width)) {
    throw InvalidInput("face_width", std::to_string(face_width), "more than 0 modules");
  }
  // Steps counted from an end, the integral of dd / h(d), and its inverse.
  const double first = steps.first, growth = steps.growth, largest = steps.largest;
  const double graded = (largest - first) / growth;  // modules over which steps grow
  const double graded_steps = std::log(largest / first) / growth;
  const auto steps_to = [&](double d) { return d < graded ? std::log1p(growth * d / first) / growth : graded_steps + (d - graded) / largest; };
  const auto distance_at = [&](double count) {
    return count < graded_steps ? first / growth * std::expm1(growth * count) : graded + (count - graded_steps) * largest;
  };
  const double half = steps_to(0.5 * face_width);
  const int intervals = std::max(3, static_cast<int>(std::ceil(2 * half)));
  std::vector<double> zetas(static_cast<std::size_t>(intervals) + 1);
  for (int i = 0; 2 * i <= intervals; ++i) {
    const double d = 2 * i == intervals ? 0.5 * face_width : distance_at(2 * half * i / intervals);
    zetas[static_cast<std::size_t>(i)] = d;
    zetas[static_cast<std::size_t>(intervals - i)] = face_width - d;
  }
  return zetas;
}

StationGrid station_grid(double face_width, int radii) {
  if (radii < 4) throw InvalidInput("radii", std::to_string(radii), "at least 4");
  std::vector<double> us(static_cast<std::size_t>(radii));
  for (int i = 0; i < radii; ++i) us[static_cast<std::size_t>(i)] = (2.0 * i - (radii - 1)) / (radii - 1);
  return {std::move(us), axial_stations(face_width)};
}

StationGrid neighbour_grid(double face_width) {
  constexpr double longer = 1.5;
  constexpr AxialSteps own;
  return {station_grid(face_width, 5).us(), axial_stations(face_width, {longer * own.first, own.growth, longer * own.largest})};
}

}  // namespace flankwright
