#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/load/load_factors.hpp"
#include "core/load/mesh_parameter.hpp"

namespace flankwright {

/// Derivatives of located peaks, 1 x m each; empty where there is no peak.
///
/// A peak lies either where its slope over the phase is zero or at a phase that geometry alone fixes (a line begins, ends or passes the
/// length of the spike rule; a point enters or leaves). Both ways its first derivative is that of the same place of the same line at the same phase, held; of
/// equal peaks that of the one found, by which the largest rises on one side at least. What the search leaves between the
/// place found and the true one, PeakSearch::phase_tolerance, enters by first order. With the axial offset lines begin and end at other phases:
/// the place goes with the event that it lies at, so that the further meshes of OffsetSlopes are those at the phases that it then has; NaN where the
/// place passes a point on the way.
struct PeakGradients {
  struct Pair {
    Eigen::RowVectorXd contact_stress;  ///< [MPa per unit of the parameter]
    Eigen::RowVectorXd line_load;       ///< [N/mm per unit of the parameter]
  };
  Pair with_spikes, without_spikes;
};

/// @param mesh_at  makes meshes with MeshModel::further where the axial offset is among the parameters
/// @param peaks    as locate_peaks() found them for the same mesh, condition and torque
PeakGradients peak_gradients(const MeshAt& mesh_at, const FlankCondition& condition, double pinion_torque, const ContactPeaks& peaks,
                             const std::vector<MeshParameter>& parameters);

/// The same for a part of a condition, as the whole's parameters change: those that the part leaves out do not move it.
/// @param peaks  of part(condition)
PeakGradients peak_gradients_of_part(const MeshAt& mesh_at, const FlankCondition& condition, ConditionPart part, double pinion_torque,
                                     const ContactPeaks& peaks, const std::vector<MeshParameter>& parameters);

/// Derivatives of LoadFactors, 1 x m each; empty where the factor has no value.
struct LoadFactorGradients {
  struct Triple {
    Eigen::RowVectorXd lead, profile, combined, product;
  };
  Triple without_spikes, with_spikes;
};

/// Located peaks of one part of a condition and their derivatives.
struct RatedPeaks {
  ContactPeaks peaks;
  PeakGradients gradients;
};

/// dK = 2 K (dsigma/sigma - dsigma_0/sigma_0).
LoadFactorGradients load_factor_gradients(const RatedPeaks& perfect, const RatedPeaks& lead, const RatedPeaks& profile,
                                          const RatedPeaks& combined);

}  // namespace flankwright
