#pragma once

#include "core/contact/unloaded/tooth_contact.hpp"

namespace flankwright {

/// Shape of the gap between two flanks around a point where their surfaces touch: second order in the common tangent
/// plane,
///
///     separation = (kappa_1 s_1^2 + kappa_2 s_2^2)/2,     kappa_1 <= kappa_2 the principal relative curvatures,
///
/// and the ellipse inside which it stays below the thickness of a marking compound. Aligned involutes have kappa_1 = 0
/// along their line of contact and kappa_2 = (1/rho_1 + 1/rho_2) cos(beta_b) across it, rho the transverse roll
/// lengths.
struct ContactEllipse {
  double least_curvature{not_given};     ///< kappa_1 [1/mm]; 0 for line contact, < 0 would be a saddle: no ellipse
  double greatest_curvature{not_given};  ///< kappa_2 [1/mm], across the instantaneous line of contact
  double semi_major{not_given};          ///< sqrt(2 t/kappa_1) [mm]; infinite where kappa_1 <= 1e-12 kappa_2, the round-off of both
  double semi_minor{not_given};          ///< sqrt(2 t/kappa_2) [mm]
  /// Axes on the pinion's flank as displacements along its two parameters for one semi-axis of unit length: d(rho),
  /// d(z) [mm/mm]. Of the two senses the one with d(z) > 0 for the major, d(rho) > 0 for the minor axis.
  double major_d_rho{not_given}, major_d_z{not_given};
  double minor_d_rho{not_given}, minor_d_z{not_given};
};

/// Contact ellipse of one first contact for a marking compound of thickness t [mm], t > 0. NaN throughout for edge and
/// corner contact, where the flanks have no common tangent plane. Exact second derivatives of both flanks; where a
/// flank has a kink (start of a linear relief) those of the side on which the point was found.
/// @throws InvalidInput "marking_thickness"
ContactEllipse contact_ellipse(const FlankAssembly& assembly, const ToothContact& contact, double marking_thickness);

}  // namespace flankwright
