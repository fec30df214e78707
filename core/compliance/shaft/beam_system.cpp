#include "core/compliance/shaft/beam_system.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace flankwright {

namespace {

Eigen::Vector3d about_origin(const BeamLoad& load) { return load.moment + load.z * Eigen::Vector3d(-load.force.y(), load.force.x(), 0.0); }

/// A support's load on its own beam, and the opposite one on the other.
std::vector<BeamLoad> both_ends(const BeamSupport& support) {
  std::vector<BeamLoad> ends{support.direction};
  if (support.against) ends.push_back(support.against->times(-1.0));
  return ends;
}

}  // namespace

/// The wrench times the integrals up to a section, see C(a, b).
BeamSystem::Wrench BeamSystem::strained(const Wrench& wrench, const Moments& lower) {
  const auto M = wrench.segment<2>(4), g = wrench.tail<2>();
  Wrench result;
  result << lower.shear * wrench.head<2>(), lower.axial * wrench[2], lower.torsion * wrench[3], lower.bending * M - lower.bending_1 * g,
      lower.bending_2 * g - lower.bending_1 * M;
  return result;
}

BeamSystem::ReducedLoad BeamSystem::reduce(const BeamLoad& load) const {
  assert(load.beam >= 0 && load.beam < std::ssize(beams_));
  const Eigen::Vector3d M = about_origin(load);
  ReducedLoad reduced{load.z, load.beam, {}, {}};
  reduced.wrench << load.force, M.z(), M.head<2>(), -load.force.y(), load.force.x();
  reduced.strained = strained(reduced.wrench, beams_[static_cast<std::size_t>(load.beam)].to(load.z));
  return reduced;
}

BeamSystem::Moments BeamSystem::Beam::to(double z) const {
  const auto piece = static_cast<std::size_t>(std::min(std::lower_bound(ends.begin(), ends.end(), z) - ends.begin(), std::ssize(ends) - 1));
  const BeamPiece& rates = pieces[piece];
  const double from = ends[piece] - rates.length, d = z - from;
  Moments m = until[piece];
  m.shear += rates.shear * d;
  m.axial += rates.axial * d;
  m.torsion += rates.torsion * d;
  m.bending += rates.bending * d;
  m.bending_1 += rates.bending * d * (from + 0.5 * d);
  m.bending_2 += rates.bending * d * (from * from + from * d + d * d / 3.0);
  return m;
}

BeamSystem::BeamSystem(std::vector<std::vector<BeamPiece>> beams, std::vector<BeamSupport> supports, const Eigen::MatrixXd& further)
    : supports_(std::move(supports)) {
  assert(!beams.empty());
  length_scale_ = compliance_scale_ = 0.0;
  for (std::vector<BeamPiece>& pieces : beams) {
    assert(!pieces.empty());
    Beam& beam = beams_.emplace_back(Beam{std::move(pieces), {}, {Moments{}}});
    double end = 0.0;
    for (const BeamPiece& piece : beam.pieces) {
      beam.ends.push_back(end += piece.length);
      beam.until.push_back(beam.to(end));
    }
    length_scale_ = std::max(length_scale_, end);
    compliance_scale_ = std::max(compliance_scale_, beam.until.back().bending_2);
  }
  if (!(compliance_scale_ > 0.0)) compliance_scale_ = 1.0;  // rigid beams

  const auto n = static_cast<Eigen::Index>(supports_.size()), rigid = static_cast<Eigen::Index>(6 * beams_.size());
  assert(further.size() == 0 || (further.rows() == n && further.cols() == n));
  for (const BeamSupport& support : supports_) {
    std::vector<ReducedLoad>& ends = directions_.emplace_back();
    for (const BeamLoad& end : both_ends(support)) ends.push_back(reduce(end));
  }
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n, n + rigid);
  for (Eigen::Index i = 0; i < n; ++i) rows.row(i) = coupling(directions_[static_cast<std::size_t>(i)]).colwise().sum();
  for (Eigen::Index i = 0; i < n; ++i) {
    const BeamSupport& support = supports_[static_cast<std::size_t>(i)];
    rows.row(i) /= arm(support);
    rows(i, i) += support.compliance / compliance_scale_ / (arm(support) * arm(support));
    for (Eigen::Index j = 0; further.size() > 0 && j < n; ++j) {
      rows(i, j) += further(i, j) / compliance_scale_ / (arm(support) * arm(supports_[static_cast<std::size_t>(j)]));
    }
  }
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + rigid, n + rigid);
  matrix.topRows(n) = rows;
  matrix.bottomLeftCorner(rigid, n) = rows.rightCols(rigid).transpose();
  // A very soft support has a very large pivot. The others are small beside it, but they are not zero.
  released_.setThreshold(0.0);
  released_.compute(matrix);
  assert(released_.isInvertible());
}

/// The scale that makes a support's work a force times a length of 1 [mm or 1].
double BeamSystem::arm(const BeamSupport& support) const { return support.direction.moment.isZero() ? 1.0 : 1.0 / length_scale_; }

/// Rows [C_ac, W_a] without dimensions: compliances in compliance_scale_, moments in length_scale_ times a force.
Eigen::MatrixXd BeamSystem::coupling(const std::vector<ReducedLoad>& loads) const {
  const auto n = static_cast<Eigen::Index>(supports_.size());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(std::ssize(loads), n + static_cast<Eigen::Index>(6 * beams_.size()));
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto support = static_cast<std::size_t>(j);
    const double scale = 1.0 / (compliance_scale_ * arm(supports_[support]));
    for (const ReducedLoad& end : directions_[support]) {
      for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        const ReducedLoad& load = loads[static_cast<std::size_t>(i)];
        if (load.beam == end.beam) rows(i, j) += scale * clamped(load, end);
      }
    }
  }
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const ReducedLoad& load = loads[static_cast<std::size_t>(i)];
    rows.row(i).segment<3>(n + 6 * load.beam) = load.force();
    rows.row(i).segment<3>(n + 6 * load.beam + 3) = load.moment() / length_scale_;
  }
  return rows;
}

namespace {

Eigen::MatrixXd summed(const Eigen::MatrixXd& each, int parts) {
  assert(parts >= 1 && each.rows() % parts == 0);
  if (parts == 1) return each;
  Eigen::MatrixXd sum(each.rows() / parts, each.cols());
  for (Eigen::Index i = 0; i < sum.rows(); ++i) sum.row(i) = each.middleRows(i * parts, parts).colwise().sum();
  return sum;
}

}  // namespace

Eigen::MatrixXd BeamSystem::combined_coupling(std::span<const BeamLoad> loads, int parts) const { return summed(coupling(reduce(loads)), parts); }

std::vector<BeamSystem::ReducedLoad> BeamSystem::reduce(std::span<const BeamLoad> loads) const {
  std::vector<ReducedLoad> reduced;
  reduced.reserve(loads.size());
  for (const BeamLoad& load : loads) reduced.push_back(reduce(load));
  return reduced;
}

std::vector<bool> BeamSystem::at_one_section(const std::vector<ReducedLoad>& loads, int parts) {
  std::vector<bool> shared;
  const auto step = static_cast<std::size_t>(parts);
  for (std::size_t first = 0; first < step; ++first) {
    bool same = true;
    for (std::size_t i = first; i < loads.size(); i += step) same = same && loads[i].z == loads[first].z && loads[i].beam == loads[first].beam;
    shared.push_back(same);
  }
  return shared;
}

Eigen::MatrixXd BeamSystem::clamped_at(const ReducedLoad& section, const std::vector<ReducedLoad>& loads, int parts,
                                       const std::vector<bool>& counts) const {
  const Moments lower = beams_[static_cast<std::size_t>(section.beam)].to(section.z);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(Wrench::RowsAtCompileTime, std::ssize(loads) / parts);
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const ReducedLoad& load = loads[i];
    if (load.beam != section.beam || !counts[i % static_cast<std::size_t>(parts)]) continue;
    sum.col(static_cast<Eigen::Index>(i) / parts) += load.z < section.z ? load.strained : strained(load.wrench, lower);
  }
  return sum;
}

Eigen::MatrixXd BeamSystem::wrenches_of(const std::vector<ReducedLoad>& loads, std::size_t part, int parts) {
  Eigen::MatrixXd wrenches(Wrench::RowsAtCompileTime, std::ssize(loads) / parts);
  for (Eigen::Index i = 0; i < wrenches.cols(); ++i) wrenches.col(i) = loads[part + static_cast<std::size_t>(i * parts)].wrench;
  return wrenches;
}

void BeamSystem::add_clamped(const std::vector<ReducedLoad>& rows, const std::vector<ReducedLoad>& columns, int row_parts, int column_parts,
                             Eigen::MatrixXd& result) const {
  const std::vector<bool> rows_shared = at_one_section(rows, row_parts), columns_shared = at_one_section(columns, column_parts);
  std::vector<bool> wandering = columns_shared;
  wandering.flip();
  const std::vector<bool> all(rows_shared.size(), true);
  for (std::size_t c = 0; c < columns_shared.size(); ++c) {
    if (columns_shared[c]) result += clamped_at(columns[c], rows, row_parts, all).transpose() * wrenches_of(columns, c, column_parts);
  }
  for (std::size_t r = 0; r < rows_shared.size(); ++r) {
    if (rows_shared[r]) result += wrenches_of(rows, r, row_parts).transpose() * clamped_at(rows[r], columns, column_parts, wandering);
  }
  for (std::size_t j = 0; j < columns.size(); ++j) {
    if (!wandering[j % wandering.size()]) continue;
    const ReducedLoad& column = columns[j];
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows_shared[i % rows_shared.size()] || rows[i].beam != column.beam) continue;
      result(static_cast<Eigen::Index>(i) / row_parts, static_cast<Eigen::Index>(j) / column_parts) += clamped(rows[i], column);
    }
  }
}

Eigen::MatrixXd BeamSystem::flexibility(std::span<const BeamLoad> rows, std::span<const BeamLoad> columns, int row_parts, int column_parts) const {
  const std::vector<ReducedLoad> of_rows = reduce(rows), of_columns = reduce(columns);
  Eigen::MatrixXd result =
      -compliance_scale_ * (summed(coupling(of_rows), row_parts) * released_.solve(summed(coupling(of_columns), column_parts).transpose()));
  add_clamped(of_rows, of_columns, row_parts, column_parts, result);
  return result;
}

Eigen::MatrixXd BeamSystem::flexibility(std::span<const BeamLoad> loads, int parts) const {
  const Eigen::MatrixXd raw = flexibility(loads, loads, parts);
  return 0.5 * (raw + raw.transpose());
}

Eigen::MatrixXd BeamSystem::reactions(std::span<const BeamLoad> loads, int parts) const {
  const auto n = static_cast<Eigen::Index>(supports_.size());
  Eigen::MatrixXd forces = -released_.solve(combined_coupling(loads, parts).transpose()).topRows(n);
  for (Eigen::Index i = 0; i < n; ++i) forces.row(i) /= arm(supports_[static_cast<std::size_t>(i)]);
  return forces;
}

Eigen::MatrixXd BeamSystem::prestrain_stiffness() const {
  const auto n = static_cast<Eigen::Index>(supports_.size());
  Eigen::MatrixXd forced = Eigen::MatrixXd::Zero(released_.rows(), n);
  Eigen::VectorXd per_arm(n);
  for (Eigen::Index i = 0; i < n; ++i) per_arm[i] = 1.0 / arm(supports_[static_cast<std::size_t>(i)]);
  forced.topRows(n) = (per_arm / compliance_scale_).asDiagonal();
  const Eigen::MatrixXd raw = per_arm.asDiagonal() * released_.solve(forced).topRows(n);
  return 0.5 * (raw + raw.transpose());
}

std::optional<LooseMotion> find_loose_motion(const std::vector<double>& lengths, const std::vector<BeamSupport>& supports) {
  const auto rigid = static_cast<Eigen::Index>(6 * lengths.size());
  const double scale = *std::ranges::max_element(lengths);
  Eigen::MatrixXd wrenches = Eigen::MatrixXd::Zero(std::ssize(supports), rigid);
  for (Eigen::Index i = 0; i < wrenches.rows(); ++i) {
    const BeamSupport& support = supports[static_cast<std::size_t>(i)];
    const double factor = support.direction.moment.isZero() ? 1.0 : scale;
    for (const BeamLoad& end : both_ends(support)) {
      wrenches.row(i).segment<3>(6 * end.beam) += factor * end.force;
      wrenches.row(i).segment<3>(6 * end.beam + 3) += factor * about_origin(end) / scale;
    }
  }
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(rigid);
  if (wrenches.rows() == 0) {
    motion[2] = 1.0;
  } else {
    Eigen::FullPivLU<Eigen::MatrixXd> factored(wrenches);
    // Two bearings closer than this part of the longest shaft do not hold against tilting.
    constexpr double same_place = 1e-9;
    factored.setThreshold(same_place);
    if (factored.rank() == rigid) return std::nullopt;
    motion = factored.kernel().col(0);
  }
  Eigen::Index largest = 0;
  motion.cwiseAbs().maxCoeff(&largest);
  motion /= motion[largest];
  const Eigen::Index beam = largest / 6;
  return LooseMotion{static_cast<int>(beam), motion.segment<3>(6 * beam), motion.segment<3>(6 * beam + 3)};
}

}  // namespace flankwright
