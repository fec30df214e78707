#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/rating/load_factors.hpp"
#include "core/load/cycle/mesh_parameter.hpp"

namespace flankwright {

/// Derivatives of located peaks, 1 x m each; empty where there is no peak.
///
/// A peak s over the phase f is smooth, or a kink where a point of the mesh, often another one, just gains or loses
/// contact or passes A or E, or a jump where a line or a point begins or ends. For the first two the derivative is the
/// mean of both sides in which the slope over the phase vanishes,
///
///     ds/dp = (s'(+) ds(-)/dp - s'(-) ds(+)/dp) / (s'(+) - s'(-)),     s' = ds/df,
///
/// with the phase held on either side, so that the kink's motion is not needed. Both sides are read two and four
/// phase_tolerance of the search off the maximum and extrapolated to it. At a jump it is that of the same station on
/// the line at the phase held. An axial offset moves jumps: then the station moves with its event, and the perturbed
/// meshes of MeshSlopes are those at its phases; NaN where it passes a point on the way. Of equal peaks it is that of
/// the one found, which the largest has on one side at least.
struct PeakGradients {
  struct Pair {
    Eigen::RowVectorXd contact_stress;  ///< [MPa per unit of the parameter]
    Eigen::RowVectorXd line_load;       ///< [N/mm per unit of the parameter]
  };
  Pair with_spikes, without_spikes;
};

/// @param mesh_at  makes meshes with MeshModel::perturbed along those of the parameters that move it
/// @param peaks    as locate_peaks() found them for the same mesh, condition and torque
PeakGradients peak_gradients(const MeshAt& mesh_at, const FlankCondition& condition, double pinion_torque, const ContactPeaks& peaks,
                             const std::vector<MeshParameter>& parameters);

/// The same for a part of a condition, as the whole's parameters change: those that the part leaves out do not move it.
/// @param peaks               of part_without_rims()
/// @param opening_per_torque  rim_opening() over the torque [mm per N mm]. Where it is not 0, derivatives by the torque need the perturbed meshes of
///                            Misalignment::mesh_misalignment too, if that moves the mesh
PeakGradients peak_gradients_of_part(const MeshAt& mesh_at, const FlankCondition& condition, ConditionPart part, double pinion_torque,
                                     const ContactPeaks& peaks, const std::vector<MeshParameter>& parameters, double opening_per_torque = 0.0);

/// Derivatives of LoadFactors, 1 x m each; empty where the factor has no value.
struct LoadFactorGradients {
  struct Triple {
    Eigen::RowVectorXd lead, profile, combined, product;
  };
  Triple without_spikes, with_spikes, line_load;
};

/// Located peaks of one part of a condition and their derivatives.
struct RatedPeaks {
  ContactPeaks peaks;
  PeakGradients gradients;
};

/// By contact stress dK = 2 K (dsigma/sigma - dsigma_0/sigma_0), by line loads dK = K (dw/w - dw_0/w_0).
LoadFactorGradients load_factor_gradients(const RatedPeaks& perfect, const RatedPeaks& lead, const RatedPeaks& profile, const RatedPeaks& combined);

}  // namespace flankwright
