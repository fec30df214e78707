#pragma once

#include <optional>

#include "core/load/cycle/mesh_cycle.hpp"

namespace flankwright {

/// How far a gear's tip edge is pressed into its mate at a mesh position.
struct EdgeApproach {
  /// Deflection of the contact beyond that under which its strip just reaches the edge [mm]; below 0 what is missing, the gap that is left included. It passes smoothly
  /// through 0 where the stress on the edge begins. NaN: no point has an edge of this gear.
  double approach{not_given};
  Eigen::Index point{-1};     ///< of the position, where it is largest; -1: none
  double at_edge{not_given};  ///< deflection there under which the strip just reaches the edge [mm], >= 0; 0 where contact is beyond it
};

/// @param tooth  the tooth pair that counts; nothing: all
EdgeApproach edge_approach(const MeshPosition& at, const LoadedPosition& loaded, Member gear, std::optional<int> tooth = {});

/// The pressure on the edge at the point of `edge`, if it had this approach instead of its own [MPa]: >= 0, and 0 where `approach` is not above 0.
double edge_pressure_at(const MeshPosition& at, const LoadedPosition& loaded, const EdgeApproach& edge, double approach);

}  // namespace flankwright
