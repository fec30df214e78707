#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/load/cycle/loaded_cycle.hpp"
#include "core/load/cycle/mesh_model.hpp"

namespace flankwright {

/// For each point of one mesh position the corresponding one of another. It is of the same tooth pair, at the same z
/// where the line has such a point, else the one with as many points between it and the nearer end of the theoretical
/// path, A or E. Graded rules move their points with the line.
/// @returns  of each point of `to` its index in `from`, -1 where there is none
std::vector<Eigen::Index> corresponding_points(const MeshPosition& from, const MeshPosition& to);

/// Line loads near those of position i, to start its solution from, n; empty where nothing is known.
///
/// Extrapolates the loads of the two positions before it along the phase. With an earlier cycle the change since then
/// is extrapolated and added to the earlier loads of position i itself: where the design has changed by little, the
/// start is off by a small part of that.
/// @param cycle    solved up to position i - 1
/// @param earlier  another cycle of the same mesh, or null
Eigen::VectorXd starting_loads(const MeshModel& model, const LoadedCycle& cycle, std::size_t i, const LoadedCycle* earlier);

}  // namespace flankwright
