#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/base/for_each_index.hpp"
#include "core/load/solve/load_problem.hpp"
#include "core/load/cycle/cycle_values.hpp"
#include "core/load/cycle/loaded_cycle.hpp"
#include "core/load/cycle/mesh_model.hpp"
#include "core/load/cycle/mesh_parameter.hpp"

namespace flankwright {

/// Root stress follows from the loads, for more than half of what they cost: with them, or by add_root_stress() where it is read.
enum class RootStresses { WithLoads, Later };

/// Solves the load distribution at every position, each started from those before it, see starting_loads(), and its exact derivatives.
///
/// Mesh stiffness is Haddad's eq. 2.16b, (F/b) cos^2(beta_b) / f_t, with f_t counted from first touch, f_t - min(g), so that a
/// gap common to all points (modified or displaced flanks) is not taken for compliance.
/// @param condition      GapModel::WholeSurface: with the misalignment that the model was placed for
/// @param pinion_torque  [N mm], >= 0
/// @param parameters     derivatives are computed for these; empty: none. Without torque there is none with respect to
///                       it: what the flanks yield first is infinite per unit load, and 0 is given instead. Derivatives
///                       of points by parameters that move the mesh follow the points, see MeshSlopes
/// @param earlier        another cycle of the same model, of a design that differs by little, to start from; null: none. Only the time
///                       depends on it, and digits beyond the tolerance
/// @param for_each       where an earlier cycle is known, shares the halves of the cycle among threads: the halves are the same on one thread
/// @throws InvalidInput  where a parameter moves the mesh and the model has no perturbed meshes along it
LoadedCycle analyse_cycle(const MeshModel& model, const FlankCondition& condition, double pinion_torque,
                          const std::vector<MeshParameter>& parameters = {}, RootStresses root_stresses = RootStresses::WithLoads,
                          const LoadedCycle* earlier = nullptr, const ForEachIndex& for_each = {});

/// Some positions of the same, without derivatives; the others stay as they begin, with no loads. What holds at these holds in the whole cycle to the
/// tolerance.
/// @param positions  indices of the model's positions, rising
LoadedCycle analyse_positions(const MeshModel& model, std::span<const std::size_t> positions, const FlankCondition& condition, double pinion_torque,
                              RootStresses root_stresses = RootStresses::WithLoads, const LoadedCycle* earlier = nullptr);

/// The largest principal stress at every point of MeshPosition::root_stress [MPa].
Eigen::VectorXd root_stresses(const MeshPosition& at, const LoadDistribution& load);
/// Completes a cycle whose root stress was left for later.
void add_root_stress(const MeshModel& model, LoadedCycle& cycle);

/// d(root_stress[i])/dp at fillet point i of one position, 1 x m. Computed when asked for: there are many fillet
/// points, and few matter.
Eigen::RowVectorXd root_stress_derivative(const MeshPosition& at, const LoadedPosition& position, Eigen::Index station);

/// The largest root stress of one gear: tension side, largest principal stress at the surface.
struct RootStressPeak {
  double stress{not_given};          ///< over all teeth and points [MPa]
  RootStation station{};             ///< where; the pair's tooth and z
  double phase{not_given};           ///< of the position [base pitches]
  double tangent_stress{not_given};  ///< the same over the points at the 30 deg tangent only [MPa]
};

/// Of one gear at one mesh position; NaN where there is none.
RootStressPeak root_stress_peak(const MeshPosition& at, const LoadedPosition& position, Member member);

/// Some of the points of MeshPosition::root_stress.
struct RootStations {
  Member member{Member::Pinion};
  std::optional<int> tooth{};  ///< of the tooth pair; nothing: all teeth
  bool tangent_only{false};    ///< those at the 30 deg tangent
};
/// Index of the point with the largest stress among these at one position, the first of equals; -1 where there is none.
Eigen::Index highest_root_stress(const MeshPosition& at, const LoadedPosition& position, const RootStations& among);

/// The main figures of a cycle. NaN: not computed; no harmonics of explicit phases.
struct CycleSummary : CycleValues<double, std::vector<double>> {
  RootStressPeak pinion_root_stress, wheel_root_stress;  ///< over the positions; NaN where the model has none
  double worst_kkt_residual{not_given};
  double worst_condition{not_given};  ///< largest LoadDistribution::condition [-]

  double stiffness_variation() const { return (largest_stiffness - least_stiffness) / mean_stiffness; }  ///< [-]
  /// Raises what is a peak over positions, root stress aside, to that of one more.
  void include(const LoadedPosition& position);
};
CycleSummary summarise(const MeshModel& model, const LoadedCycle& cycle);

}  // namespace flankwright
