#pragma once

#include <vector>

#include "core/compliance/tooth/station_grid.hpp"
#include "core/compliance/tooth/local_spline.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// The correction of a table so that no load does negative work.
struct TableProjection {
  /// Lowest eigenvalue of the table's block matrix over all its teeth, scaled so that the diagonal is 1 [-]; before
  /// anything was added.
  double lowest_eigenvalue{not_given};
  /// Fraction of each diagonal value that was added to it [-]: -lowest_eigenvalue where that is negative, otherwise 0.
  double added{not_given};
};

/// Influence values of one gear, interpolated from a table of them:
///
///     E m_n K(p, q) = w(p)' T_m w(q),   m = tooth of q - tooth of p >= 0,
///
/// with the weights w of cubic splines on a grid of stations on one tooth and one table T_m per number of pitches
/// apart; for m < 0 it is T_-m'. Teeth of a gear are alike, so that the matrix over several teeth is block Toeplitz.
/// Every K is W' T W with the T of teeth 0 .. M, hence positive semi-definite wherever that is.
///
/// The lowest eigenvalue of T can be negative, because its blocks stem from teeth that are meshed differently. Then the
/// smallest multiple of the diagonal that lifts it to 0 is added when the table is made; T_0 stays symmetric and T
/// Toeplitz.
class InfluenceTable final : public FlankCompliance {
 public:
  /// @param tables  T_0 .. T_M [-], each grid.size() x grid.size(), finite; row: where it deflects, on tooth 0; column:
  ///                where the force acts, on tooth m. T_0 is symmetrised, with a diagonal > 0.
  /// @throws InvalidInput  "tables" otherwise
  InfluenceTable(StationGrid grid, std::vector<Eigen::MatrixXd> tables);

  /// The same table, from its own tables() and projection().
  /// @throws InvalidInput  "tables" of another size than the grid's
  InfluenceTable(StationGrid grid, std::vector<Eigen::MatrixXd> tables, TableProjection projection);

  /// @throws InvalidInput  "place.u", "place.zeta", and "place.tooth" where teeth are more than teeth_apart() apart
  Eigen::MatrixXd evaluate(std::span<const FlankStation> points) const override;

  const StationGrid& grid() const { return grid_; }
  const std::vector<Eigen::MatrixXd>& tables() const { return tables_; }    ///< with what was added
  int teeth_apart() const { return static_cast<int>(tables_.size()) - 1; }  ///< M
  const TableProjection& projection() const { return projection_; }

 private:
  struct LocalStation;
  LocalStation local_station(const FlankStation& station) const;
  void make_coefficients();

  StationGrid grid_;
  std::vector<Eigen::MatrixXd> tables_;
  LocalSpline along_u_, along_zeta_;
  std::vector<Eigen::MatrixXd> coefficients_;  ///< of the tables' splines in B-splines; a station needs 16
  TableProjection projection_;
};

}  // namespace flankwright
