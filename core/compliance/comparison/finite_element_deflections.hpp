#pragma once

#include <Eigen/Core>
#include <span>

#include "core/compliance/finite_element/influence.hpp"
#include "core/compliance/tooth/flank_compliance.hpp"

namespace flankwright {

/// The points of a meshed gear that belong to stations on its flanks.
/// @throws InvalidInput as require_on_flank()
std::vector<FlankPoint> flank_points(const GearMesh& mesh, std::span<const FlankStation> stations);

/// Solved influence values of a gear, E m_n K [-]: row: where it deflects; column: where the force acts.
/// @param model  of a gear whose matrix is factorised
/// @throws InvalidInput as flank_points()
Eigen::MatrixXd finite_element_deflections(const InfluenceModel& model, std::span<const FlankStation> stations, std::span<const FlankStation> loads,
                                           RemovedRigidMotion removed);

}  // namespace flankwright
