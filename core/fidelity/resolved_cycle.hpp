#pragma once

#include <memory>

#include "core/fidelity/cycle_error.hpp"
#include "core/fidelity/peak_reading.hpp"
#include "core/load/cycle/cycle_gradient.hpp"

namespace flankwright {

/// The figures of a cycle with extremes between its positions, and the error of each.
struct ResolvedCycle {
  CycleSummary summary;         ///< of positions and extremes together
  CycleErrorParts error_parts;  ///< NaN where no coarser cycle was given
  CycleErrors errors;           ///< their sum
  CycleExtremes extremes;
  std::vector<PeakReading> further;               ///< of CycleResolving::further
  std::shared_ptr<const MeshModel> extreme_mesh;  ///< at extremes.phases, without root stress; null where there are none
  LoadedCycle extreme_cycle;                      ///< of it
};

/// The mesh at phases of one's choice [base pitches], with what derivatives by these parameters need.
using MeshWithParameters = std::function<MeshModel(const std::vector<double>& phases, const std::vector<MeshParameter>& parameters)>;

/// What is resolved beyond the positions of a cycle.
struct CycleResolving {
  bool seek_extremes{true};                ///< false: extremes are those of the positions
  const LoadedCycle* coarse{nullptr};      ///< at coarse_phases() or at all phases of the cycle, with fewer intervals; null: no error is estimated
  const MeshModel* coarse_model{nullptr};  ///< of `coarse`; null: no error of further readings is estimated
  MeshAt coarse_at{};                      ///< the mesh of `coarse` at other phases; empty: both are compared at the positions alone
  std::vector<PointReading> further{};     ///< whose largest values are sought as well
};

/// Seeks the extremes of a solved cycle and holds it against a coarser one.
/// @param cycle    evenly spaced over one base pitch, of `model`
/// @param mesh_at  the same mesh at other phases
ResolvedCycle resolve_cycle(const MeshModel& model, const LoadedCycle& cycle, const MeshWithParameters& mesh_at, const FlankCondition& condition,
                            double pinion_torque, const CycleResolving& resolving, const std::vector<MeshParameter>& parameters = {});

/// Takes the errors by points from a finer cycle, see point_errors_beside_finer().
/// @param cycle, finer  usable or not, with their meshes, at the same phases
/// @param further       CycleResolving::further of `resolved`
void hold_against_finer(const SolvedCycle& cycle, const SolvedCycle& finer, const std::vector<PointReading>& further, ResolvedCycle& resolved);

/// Derivatives of ResolvedCycle::summary: as summary_gradient(), of the position that has the extreme, with its phase
/// held. On a smooth curve that is exact, for at its extreme the phase does not matter; where a kink moves with the
/// parameter, the effect of its motion is left out.
CycleGradient resolved_gradient(const MeshModel& model, const LoadedCycle& cycle, const ResolvedCycle& resolved);

}  // namespace flankwright
