#include "core/compliance/finite_element/influence_table.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <string>

#include "core/base/error.hpp"

namespace flankwright {
namespace {

/// Lowest eigenvalue of the block Toeplitz matrix of the tables, every place scaled to the own value 1.
double lowest_eigenvalue(const std::vector<Eigen::MatrixXd>& tables) {
  const Eigen::Index n = tables.front().rows(), teeth = std::ssize(tables);
  const Eigen::VectorXd scale = tables.front().diagonal().cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd lower(teeth * n, teeth * n);
  for (Eigen::Index i = 0; i < teeth; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      lower.block(i * n, j * n, n, n) =
          scale.asDiagonal() * tables[static_cast<std::size_t>(i - j)].transpose() * scale.asDiagonal();
    }
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(lower, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

}  // namespace

InfluenceTable::InfluenceTable(FlankGrid grid, std::vector<Eigen::MatrixXd> tables, TableProjection projection)
    : grid_(std::move(grid)), tables_(std::move(tables)), projection_(projection) {
  const auto fits = [&](const Eigen::MatrixXd& t) {
    return t.rows() == grid_.size() && t.cols() == grid_.size() && t.allFinite();
  };
  if (tables_.empty() || !std::ranges::all_of(tables_, fits) || !(tables_.front().diagonal().minCoeff() > 0)) {
    throw InvalidInput("tables", std::to_string(tables_.size()) + " tables",
                       "finite square ones of the grid's size, the first with a positive diagonal");
  }
}

InfluenceTable::InfluenceTable(FlankGrid grid, std::vector<Eigen::MatrixXd> tables)
    : InfluenceTable(std::move(grid), std::move(tables), {}) {
  Eigen::MatrixXd& own = tables_.front();
  own = (0.5 * (own + own.transpose())).eval();
  projection_.lowest_eigenvalue = lowest_eigenvalue(tables_);
  projection_.added = std::max(0.0, -projection_.lowest_eigenvalue);
  own.diagonal() *= 1 + projection_.added;
}

Eigen::MatrixXd InfluenceTable::evaluate(std::span<const FlankPlace> points) const {
  std::map<int, std::vector<Eigen::Index>> of_tooth;
  Eigen::MatrixXd weights(grid_.size(), std::ssize(points));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    weights.col(column) = grid_.weights(points[i]);
    of_tooth[points[i].tooth].push_back(column);
  }
  Eigen::MatrixXd result(std::ssize(points), std::ssize(points));
  for (const auto& [loaded, columns] : of_tooth) {
    const Eigen::MatrixXd forces = weights(Eigen::all, columns);
    for (const auto& [tooth, rows] : of_tooth) {
      if (tooth > loaded) break;
      if (loaded - tooth > teeth_apart()) {
        throw InvalidInput("place.tooth", std::to_string(loaded - tooth) + " pitches apart",
                           "at most " + std::to_string(teeth_apart()));
      }
      const Eigen::MatrixXd& table = tables_[static_cast<std::size_t>(loaded - tooth)];
      Eigen::MatrixXd block = weights(Eigen::all, rows).transpose() * (table * forces);
      if (tooth == loaded) block = (0.5 * (block + block.transpose())).eval();
      result(rows, columns) = block;
      result(columns, rows) = block.transpose();
    }
  }
  return result;
}

}  // namespace flankwright
