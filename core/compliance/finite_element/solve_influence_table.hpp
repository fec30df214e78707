#pragma once

#include <functional>
#include <optional>

#include "core/compliance/finite_element/influence.hpp"
#include "core/compliance/finite_element/influence_table.hpp"
#include "core/compliance/finite_element/rim_motion.hpp"
#include "core/compliance/finite_element/root_stress_table.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// The input of a gear's influence table.
struct InfluenceTableTask {
  GearToMesh gear;
  double poissons_ratio{0.3};
  int teeth_apart{2};      ///< M, 1 .. (teeth - 1)/2: so many teeth on either side are meshed in detail
  GearMeshOptions mesh{};  ///< its teeth_each_side is replaced by teeth_apart
  RemovedRigidMotion removed{RemovedRigidMotion::TranslationTorsionAndTilt};
  StationGrid grid;         ///< as wide as the face
  bool root_stress{false};  ///< the same run also solves for root stress
  /// Stations that are solved for on the neighbours of tooth 0, from which the tables are interpolated; as wide as the
  /// face. Empty: those of `grid`.
  std::optional<StationGrid> neighbour_grid{};

  const StationGrid& grid_of_neighbours() const { return neighbour_grid ? *neighbour_grid : grid; }
};

/// The task with lengths in normal modules: m_n = 1. Gears that differ in size only become the same.
InfluenceTableTask in_modules(InfluenceTableTask task);
/// Whether two tasks have the same result: equal in modules, however the flanks are cut.
bool alike_but_for_size(const InfluenceTableTask& one, const InfluenceTableTask& other);

/// Whether the run of a gear also reads the motion of its rim.
bool reads_rim_motion(const GearBody& body);

/// Most teeth apart that two points of a pair in contact at once can be, the extended region included.
int teeth_apart_in_contact(const GearPair& pair);

/// A table and what it took.
struct InfluenceTableRun {
  FactorStatus status{FactorStatus::NotPositiveDefinite};
  std::optional<InfluenceTable> table;         ///< empty unless status is Factorised
  std::optional<RootStressTable> root_stress;  ///< empty unless asked for and status is Factorised
  RunStatistics statistics;
  std::optional<RimMotionTable> rim_motion{};  ///< empty unless the gear has a web, does not count as rigid, and status is Factorised
};

/// Progress of a run in steps of about the same time: kModelSteps until the matrix is ordered, the rest for the elimination.
inline constexpr int kModelSteps = 2, kTableSteps = 10;
using TableProgress = std::function<void(int done, int total)>;

/// Solves a gear's finite elements for a load at every station of the grid on tooth 0, which is meshed finely, and
/// reads the deflections of its neighbours at their own stations. T_m is the mean of two reciprocal values, the deflection on tooth -m and,
/// transposed, on tooth m. They differ only by the neighbours' coarser mesh.
///
/// E = m_n = 1. Same input, same bits, whatever the number of threads.
/// @param memory_limit  OutOfMemory where statistics.peak_bytes > memory_limit, once the matrix is ordered, and where an
///                      allocation fails after all
/// @param for_each      as multifrontal_gram()
/// @throws InvalidInput  as gear_mesh(), and "grid" where it is not as wide as the face
InfluenceTableRun solve_influence_table(const InfluenceTableTask& task, double memory_limit, const TableProgress& progress = {},
                                        const ForEachIndex& for_each = {});

}  // namespace flankwright
