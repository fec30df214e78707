#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/rating/line_ends.hpp"
#include "core/rating/load_sharing.hpp"

namespace flankwright {

/// Derivatives of a loaded position's quantities other than line loads, contact stress, f_t and stiffness, one column
/// per parameter of analyse_cycle(); exact while points keep their contact. Derivatives by parameters that move the
/// mesh follow each point, see PerturbedPosition.
struct PositionGradient {
  // Row per contact point.
  Eigen::MatrixXd point_force;            ///< of a w [N]
  Eigen::MatrixXd structural_deflection;  ///< of K a w [mm]
  Eigen::MatrixXd contact_deflection;     ///< of c(w) [mm]
  Eigen::MatrixXd gap, error;             ///< of Gap::total and Gap::error, before load [mm]
  // Row per entry.
  Eigen::MatrixXd shares;                          ///< of load_sharing() [-]
  Eigen::MatrixXd line_end_load, line_end_stress;  ///< of line_ends() [N/mm, MPa]; NaN by what moves the mesh where their number changes with it
};

/// With dF the change of the force, of a point that bears load
///
///     d(K a w) = K a dw,     dc = df_t - dg - d(K a w),
///
/// of the share s of a tooth pair ds = sum a dw / F - s dF/F, and of a line's end dw = (df_t - dg - dS)/c', with S the
/// spline through the structural deflections, linear in them; a line end without load has none. Parameters that move
/// the mesh move a line's end too: the deflection left for its contact, c at the held load, and its curvature are read
/// in the perturbed positions.
/// @param condition, parameters  as analyse_cycle() had them
/// @param position  of the cycle, usable and under some force
/// @param ends      line_ends() of it
PositionGradient position_gradient(const MeshModel& model, const FlankCondition& condition, const LoadedCycle& cycle, std::size_t position,
                                   const std::vector<LineEnd>& ends, const std::vector<MeshParameter>& parameters);

}  // namespace flankwright
