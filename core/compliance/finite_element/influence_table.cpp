#include "core/compliance/finite_element/influence_table.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "core/base/error.hpp"
#include "core/base/wide_sum.hpp"

namespace flankwright {
namespace {

/// Lowest eigenvalue of the block Toeplitz matrix of the tables, scaled so that the diagonal is 1.
double lowest_eigenvalue(const std::vector<Eigen::MatrixXd>& tables) {
  const Eigen::Index n = tables.front().rows(), teeth = std::ssize(tables);
  const Eigen::VectorXd scale = tables.front().diagonal().cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd lower(teeth * n, teeth * n);
  for (Eigen::Index i = 0; i < teeth; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      lower.block(i * n, j * n, n, n) = scale.asDiagonal() * tables[static_cast<std::size_t>(i - j)].transpose() * scale.asDiagonal();
    }
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(lower, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

}  // namespace

InfluenceTable::InfluenceTable(StationGrid grid, std::vector<Eigen::MatrixXd> tables, TableProjection projection)
    : grid_(std::move(grid)), tables_(std::move(tables)), along_u_(grid_.us()), along_zeta_(grid_.zetas()), projection_(projection) {
  const auto fits = [&](const Eigen::MatrixXd& t) { return t.rows() == grid_.size() && t.cols() == grid_.size() && t.allFinite(); };
  if (tables_.empty() || !std::ranges::all_of(tables_, fits) || !(tables_.front().diagonal().minCoeff() > 0)) {
    throw InvalidInput("tables", std::to_string(tables_.size()) + " tables",
                       "finite square ones of the grid's size, the first with a positive diagonal");
  }
  make_coefficients();
}

InfluenceTable::InfluenceTable(StationGrid grid, std::vector<Eigen::MatrixXd> tables) : InfluenceTable(std::move(grid), std::move(tables), {}) {
  Eigen::MatrixXd& own = tables_.front();
  own = (0.5 * (own + own.transpose())).eval();
  projection_.lowest_eigenvalue = lowest_eigenvalue(tables_);
  projection_.added = std::max(0.0, -projection_.lowest_eigenvalue);
  own.diagonal() *= 1 + projection_.added;
  make_coefficients();
}

void InfluenceTable::make_coefficients() {
  const Eigen::MatrixXd &u = along_u_.coefficients(), &zeta = along_zeta_.coefficients();
  Eigen::MatrixXd both(grid_.size(), grid_.size());
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    for (Eigen::Index j = 0; j < u.cols(); ++j) {
      both.block(i * zeta.rows(), j * zeta.cols(), zeta.rows(), zeta.cols()) = u(i, j) * zeta;
    }
  }
  coefficients_.clear();
  for (const Eigen::MatrixXd& table : tables_) coefficients_.push_back(both * table * both.transpose());
}

/// The B-splines of a station: their indices in a table, and their values.
struct InfluenceTable::LocalStation {
  std::array<Eigen::Index, 4> rows;  ///< the first of four in a row, for each B-spline along u
  Eigen::Vector4d along_u, along_zeta;
};

InfluenceTable::LocalStation InfluenceTable::local_station(const FlankStation& station) const {
  grid_.require_on_flank(station);
  const LocalSpline::Weights u = along_u_.at(station.u), zeta = along_zeta_.at(station.zeta);
  LocalStation local{{}, Eigen::Vector4d(u.values.data()), Eigen::Vector4d(zeta.values.data())};
  for (std::size_t k = 0; k < 4; ++k) {
    local.rows[k] = (u.first + static_cast<Eigen::Index>(k)) * std::ssize(grid_.zetas()) + zeta.first;
  }
  return local;
}

namespace {

/// A row of a grid, along zeta, as far as stations read it.
struct GridSpan {
  Eigen::Index begin, end;
};

/// The spans of a grid that stations read, by their row. Stations of a tooth lie on a line, which needs a few of the grid's deflections only.
using GridSpans = std::map<Eigen::Index, GridSpan>;

/// @param rows  of a station: the first of four in a row, for each B-spline along u
/// @param zetas  of the grid
void add_station(const std::array<Eigen::Index, 4>& rows, Eigen::Index zetas, GridSpans& spans) {
  for (const Eigen::Index first : rows) {
    GridSpan& span = spans.try_emplace(first / zetas, GridSpan{first, first + 4}).first->second;
    span = {std::min(span.begin, first), std::max(span.end, first + 4)};
  }
}

}  // namespace

Eigen::MatrixXd InfluenceTable::evaluate(std::span<const FlankStation> points) const {
  std::vector<LocalStation> stations;
  std::map<int, std::vector<std::size_t>> of_tooth;
  for (std::size_t i = 0; i < points.size(); ++i) {
    stations.push_back(local_station(points[i]));
    of_tooth[points[i].tooth].push_back(i);
  }
  const auto zetas = static_cast<Eigen::Index>(grid_.zetas().size());
  Eigen::MatrixXd result(std::ssize(points), std::ssize(points));
  Eigen::VectorXd deflection(grid_.size());
  for (const auto& [loaded, columns] : of_tooth) {
    for (const auto& [tooth, rows] : of_tooth) {
      if (tooth > loaded) break;
      if (loaded - tooth > teeth_apart()) {
        throw InvalidInput("place.tooth", std::to_string(loaded - tooth) + " pitches apart", "at most " + std::to_string(teeth_apart()));
      }
      const Eigen::MatrixXd& table = coefficients_[static_cast<std::size_t>(loaded - tooth)];
      const bool is_own = tooth == loaded;  // symmetric: of the points up to the force
      GridSpans spans;
      for (const std::size_t p : rows) {
        if (!is_own) add_station(stations[p].rows, zetas, spans);
      }
      for (const std::size_t q : columns) {
        const LocalStation& force = stations[q];
        if (is_own) add_station(force.rows, zetas, spans);
        for (const auto& [row, span] : spans) {
          deflection.segment(span.begin, span.end - span.begin).setZero();
          for (int k = 0; k < 4; ++k) {
            const double* first = table.col(force.rows[static_cast<std::size_t>(k)]).data() + span.begin;
            const Eigen::Vector4d factors = force.along_u[k] * force.along_zeta;
            add_four_columns({first, first + grid_.size(), first + 2 * grid_.size(), first + 3 * grid_.size()},
                             {factors[0], factors[1], factors[2], factors[3]}, span.end - span.begin, deflection.data() + span.begin);
          }
        }
        for (const std::size_t p : rows) {
          if (is_own && p > q) break;
          const LocalStation& station = stations[p];
          double value = 0;
          for (int k = 0; k < 4; ++k) {
            value += station.along_u[k] * station.along_zeta.dot(deflection.segment<4>(station.rows[static_cast<std::size_t>(k)]));
          }
          const auto i = static_cast<Eigen::Index>(p), j = static_cast<Eigen::Index>(q);
          result(i, j) = result(j, i) = value;
        }
      }
    }
  }
  return result;
}

}  // namespace flankwright
