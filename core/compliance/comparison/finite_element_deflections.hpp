#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>

#include "core/compliance/finite_element/influence.hpp"
#include "core/compliance/flank_compliance.hpp"

namespace flankwright {

/// Where places lie on the teeth of a meshed gear.
/// @throws InvalidInput as require_on_flank()
std::vector<FlankPoint> flank_points(const GearMesh& mesh, std::span<const FlankPlace> places);

/// Loads solved so far, and all of them.
using LoadProgress = std::function<void(int done, int total)>;

/// Solved influence values of a gear, E m_n K [-]: row: where it deflects; column: where the force acts. Symmetric to
/// the round-off of the solution, about 1e-12, where places and loads are the same.
///
/// Every load is solved for, places are only looked at; so where the loads are few or all on one tooth this is much
/// less than InfluenceModel::influence() of all.
/// @param model  of a gear whose matrix is factorised
/// @throws InvalidInput as flank_points()
Eigen::MatrixXd finite_element_deflections(const InfluenceModel& model, std::span<const FlankPlace> places,
                                           std::span<const FlankPlace> loads, RemovedMotion removed,
                                           const LoadProgress& progress = {});

}  // namespace flankwright
