#include "core/compliance/shaft/shaft_beam.hpp"

#include <algorithm>
#include <cassert>

namespace flankwright {

/// A load with its moment about the origin, and g = e_z x f.
struct ShaftBeam::ReducedLoad {
  double z;
  Eigen::Vector3d force, moment;
  Eigen::Vector2d turned_force;
};

ShaftBeam::ReducedLoad ShaftBeam::reduce(const BeamLoad& load) {
  const Eigen::Vector2d g(-load.force.y(), load.force.x());
  return {load.z, load.force, load.moment + load.z * Eigen::Vector3d(g.x(), g.y(), 0.0), g};
}

double ShaftBeam::clamped(const ReducedLoad& a, const ReducedLoad& b, const Moments& lower) {
  const auto across = [](const Eigen::Vector3d& v) { return v.head<2>(); };
  return lower.shear * across(a.force).dot(across(b.force)) + lower.axial * a.force.z() * b.force.z() + lower.torsion * a.moment.z() * b.moment.z() +
         lower.bending * across(a.moment).dot(across(b.moment)) -
         lower.bending_1 * (across(a.moment).dot(b.turned_force) + a.turned_force.dot(across(b.moment))) +
         lower.bending_2 * a.turned_force.dot(b.turned_force);
}

ShaftBeam::Moments ShaftBeam::moments_to(double z) const {
  const auto piece = static_cast<std::size_t>(std::min(std::lower_bound(ends_.begin(), ends_.end(), z) - ends_.begin(), std::ssize(ends_) - 1));
  const BeamPiece& rates = pieces_[piece];
  const double from = ends_[piece] - rates.length, d = z - from;
  Moments m = until_[piece];
  m.shear += rates.shear * d;
  m.axial += rates.axial * d;
  m.torsion += rates.torsion * d;
  m.bending += rates.bending * d;
  m.bending_1 += rates.bending * d * (from + 0.5 * d);
  m.bending_2 += rates.bending * d * (from * from + from * d + d * d / 3.0);
  return m;
}

ShaftBeam::ShaftBeam(const std::vector<BeamPiece>& pieces, const std::vector<BeamSupport>& supports) : pieces_(pieces), supports_(supports) {
  assert(!pieces.empty());
  double end = 0.0;
  until_.emplace_back();
  for (const BeamPiece& piece : pieces_) {
    ends_.push_back(end += piece.length);
    until_.push_back(moments_to(end));
  }
  length_scale_ = end;
  compliance_scale_ = until_.back().bending_2;
  if (!(compliance_scale_ > 0.0)) compliance_scale_ = 1.0;  // a rigid beam

  const auto n = static_cast<Eigen::Index>(supports_.size());
  std::vector<ReducedLoad> directions;
  std::vector<Moments> moments;
  for (const BeamSupport& support : supports_) {
    directions.push_back(reduce(support.direction));
    moments.push_back(moments_to(support.direction.z));
  }
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + 6, n + 6);
  Eigen::MatrixXd rows = coupling(directions, moments);
  for (Eigen::Index i = 0; i < n; ++i) {
    const BeamSupport& support = supports_[static_cast<std::size_t>(i)];
    rows.row(i) /= arm(support);
    rows(i, i) += support.compliance / compliance_scale_ / (arm(support) * arm(support));
  }
  matrix.topRows(n) = rows;
  matrix.bottomLeftCorner(6, n) = rows.rightCols(6).transpose();
  released_.compute(matrix);
  assert(released_.isInvertible());
}

/// The scale that makes a support's work a force times a length of 1 [mm or 1].
double ShaftBeam::arm(const BeamSupport& support) const { return support.direction.moment.isZero() ? 1.0 : length_scale_; }

/// Rows [C_ac, W_a] without dimensions: compliances in compliance_scale_, moments in length_scale_ times a force.
Eigen::MatrixXd ShaftBeam::coupling(const std::vector<ReducedLoad>& loads, const std::vector<Moments>& moments) const {
  const auto n = static_cast<Eigen::Index>(supports_.size());
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(loads.size()), n + 6);
  for (Eigen::Index j = 0; j < n; ++j) {
    const BeamLoad& direction = supports_[static_cast<std::size_t>(j)].direction;
    const ReducedLoad support = reduce(direction);
    const Moments at_support = moments_to(direction.z);
    const double support_arm = arm(supports_[static_cast<std::size_t>(j)]);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Moments& lower = loads[k].z < direction.z ? moments[k] : at_support;
      rows(i, j) = clamped(loads[k], support, lower) / compliance_scale_ / support_arm;
    }
  }
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const ReducedLoad& load = loads[static_cast<std::size_t>(i)];
    rows.row(i).segment<3>(n) = load.force;
    rows.row(i).segment<3>(n + 3) = load.moment / length_scale_;
  }
  return rows;
}

Eigen::MatrixXd ShaftBeam::flexibility(std::span<const BeamLoad> rows, std::span<const BeamLoad> columns, int parts) const {
  const auto prepared = [this](std::span<const BeamLoad> loads) {
    std::pair<std::vector<ReducedLoad>, std::vector<Moments>> result;
    for (const BeamLoad& load : loads) {
      result.first.push_back(reduce(load));
      result.second.push_back(moments_to(load.z));
    }
    return result;
  };
  const auto summed = [parts](const Eigen::MatrixXd& each) {
    Eigen::MatrixXd sum(each.rows() / parts, each.cols());
    for (Eigen::Index i = 0; i < sum.rows(); ++i) sum.row(i) = each.middleRows(i * parts, parts).colwise().sum();
    return sum;
  };
  assert(parts >= 1 && std::ssize(rows) % parts == 0 && std::ssize(columns) % parts == 0);
  const auto [row_loads, row_moments] = prepared(rows);
  const auto [column_loads, column_moments] = prepared(columns);
  const Eigen::MatrixXd of_rows = summed(coupling(row_loads, row_moments));
  const Eigen::MatrixXd of_columns = summed(coupling(column_loads, column_moments));
  Eigen::MatrixXd result = -compliance_scale_ * (of_rows * released_.solve(of_columns.transpose()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const Moments& lower = rows[i].z < columns[j].z ? row_moments[i] : column_moments[j];
      result(static_cast<Eigen::Index>(i) / parts, static_cast<Eigen::Index>(j) / parts) += clamped(row_loads[i], column_loads[j], lower);
    }
  }
  return result;
}

Eigen::MatrixXd ShaftBeam::flexibility(std::span<const BeamLoad> loads, int parts) const {
  const Eigen::MatrixXd raw = flexibility(loads, loads, parts);
  return 0.5 * (raw + raw.transpose());
}

}  // namespace flankwright
