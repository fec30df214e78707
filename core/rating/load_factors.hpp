#pragma once

#include "core/contact/assembly/flank_condition.hpp"
#include "core/rating/contact_peaks.hpp"
#include "core/load/cycle/mesh_parameter.hpp"

namespace flankwright {

/// The parts of a condition that load distribution factors distinguish. An axial offset remains in each: it belongs to
/// the mounted pair, not to the shape of its flanks.
///
/// perfect: nothing else. lead: what changes along the face (lead crowning and slope, end relief, helix slope errors, crossing and
/// intersecting axes, lead angle, mesh misalignment, of a measured grid the trace along the face at the middle of its profile). profile: what changes along the
/// profile or from tooth to tooth (profile crowning and slope, tip and root relief, profile slope and pitch errors, pressure angle, of a measured grid
/// the trace at mid face). Twist, shapes of a topography that vary both ways, a predesigned parabola and a changed centre distance are neither and enter the whole condition only.
FlankCondition perfect_part(const FlankCondition& condition);
FlankCondition lead_part(const FlankCondition& condition);
FlankCondition profile_part(const FlankCondition& condition);
FlankCondition whole_condition(const FlankCondition& condition);
/// One of these.
using ConditionPart = FlankCondition (*)(const FlankCondition&);
/// Whether a part of a condition depends on a parameter.
bool acts(const MeshParameter& parameter, ConditionPart part);

/// Whether shafts, bearings, housing and the other meshes of a unit deflect in a part of a condition. What they open along the face is a deviation of the lead,
/// as it is in ISO 6336-1 (f_sh): they belong to the lead part and to the whole. The perfect pair and the profile part have rigid shafts.
bool shafts_deflect(ConditionPart part);

/// A part of a condition beside rims on webs, whose tilt is a deviation of the lead as well: where shafts are rigid, the flanks are set against what it opens.
/// @param rim_opening  rim_opening() under the torque [mm]; 0: solid bodies
FlankCondition part_without_rims(const FlankCondition& condition, ConditionPart part, double rim_opening);

/// Load distribution factors from the calculated load distribution, over the whole mesh cycle. By contact stress each is the square of a ratio of peaks,
///
///     K = (sigma_Hmax / sigma_Hmax0)^2,      0: the perfect pair under the same torque,
///
/// K_Hbeta of the lead part alone [Haddad 1991, eqs 4.2 and 4.5], K_Halpha of the profile part alone [4.8 and 4.11], K_H of the whole
/// condition [4.19 and 4.22]; spikes left out (4.2, 4.8, 4.19) as SpikeRule says, or included (4.5, 4.11, 4.22). K_H is not the
/// product of the other two, which is given beside it [4.25 and 4.28]. By line loads it is the ratio itself, K = w_max / w_max0, without spikes
/// [4.1, 4.7 and 4.18]; pitting follows stress, so that the thesis prefers those above.
///
/// ISO 6336-1 defines K_Hbeta as the largest line load along the face over the mean one. Here the peak of the perfect pair takes the place of that mean, and all
/// peaks are those of the line between its points and of the cycle between its positions, see ContactPeaks. By line loads this is the same where the perfect
/// pair's load is uniform along the face: spur gears, whose peaks with and without deviations lie in single contact. Along an oblique contact line the load
/// of the perfect pair changes with the stiffness of the teeth, and ends of the face are stiffer or softer; ISO's mean leaves both to other factors, and the
/// ratio leaves them out. By stress, at the same line load, a peak that moves along the profile counts with another radius of curvature: K differs from the
/// ratio of line loads by the ratio of the radii.
struct LoadFactors {
  struct Triple {
    double lead{not_given};                            ///< K_Hbeta [-]
    double profile{not_given};                         ///< K_Halpha [-]
    double combined{not_given};                        ///< K_H [-]
    double product() const { return lead * profile; }  ///< K_Hbeta K_Halpha [-]
  };
  Triple without_spikes, with_spikes;  ///< by contact stress
  Triple line_load;                    ///< by line loads, without spikes
};

/// From the peaks of the four conditions at one torque; NaN where one of them has none, or failed at some position.
LoadFactors load_factors(const ContactPeaks& perfect, const ContactPeaks& lead, const ContactPeaks& profile, const ContactPeaks& combined);

}  // namespace flankwright
