#pragma once

#include <functional>
#include <vector>

#include "core/gear/tooth_form.hpp"

namespace flankwright {

/// Compliance of one tooth slice in the direction of a load normal to its flank: deflection per line load [mm per
/// (N/mm)] times Young's modulus [MPa], hence dimensionless and independent of the module.
struct ToothCompliance {
  double bending{not_given};
  double shear{not_given};
  double compression{not_given};
  double foundation{not_given};  ///< of the rim material below the tooth
  double total() const { return bending + shear + compression + foundation; }
};

/// A point of a tooth slice's profile.
struct SlicePoint {
  double height;     ///< y [mm]
  double thickness;  ///< s > 0 [mm]
  double rise;       ///< dy/dp by the piece's parameter p
};

/// A stretch of a tooth slice along which its profile is a smooth function of some parameter p, upwards from begin to end (begin > end is as good).
struct SlicePiece {
  double begin, end;
  std::function<SlicePoint(double)> at;
};

/// Weber and Banaschek's cantilever of varying thickness on an elastic half-plane [Weber, Banaschek: Formaenderung und
/// Profilruecknahme bei gerad- und schraegverzahnten Raedern, 1953], plane strain, general Poisson's ratio. With the
/// lever l = y_p - y_f, the root thickness s_f and the load angle a (against the normal to the centre line),
///
///     bending      (1 - nu^2) cos^2 a * 12 int (y_p - y)^2 / s(y)^3 dy
///     shear        (1 - nu^2) cos^2 a * 2.4/(1 - nu) int dy / s(y)
///     compression  (1 - nu^2) sin^2 a * int dy / s(y)
///     foundation   (1 - nu^2) cos^2 a * [18/pi (l/s_f)^2 + 2 (1 - 2 nu)/(1 - nu) l/s_f
///                                        + 4.8/pi (1 + (1 - nu)/2.4 tan^2 a)]
///
/// both integrals from y_f to y_p, taken along the profile by its own parameter; the first three are the strain energies of a beam (shear factor 1.2). In the fourth,
/// 18/pi and 2 (1 - 2 nu)/(1 - nu) follow from linear normal and uniform tangential tractions on the half-plane; 4.8/pi
/// is the authors' choice for the parts that a half-plane leaves undetermined.
///
/// @param pieces          upwards from y_f to y_p, at least one. Where the load points into the rim, y_p < y_f, the first begins at y_f
///                        and none is longer than nothing: the beam is continued down with the thickness s_f and taken off
/// @param load_height     y_p [mm]
/// @param load_angle      a [rad], |a| < pi/2
/// @param poissons_ratio  nu, 0 <= nu < 0.5
ToothCompliance slice_compliance(const std::vector<SlicePiece>& pieces, double load_height, double load_angle, double poissons_ratio);

/// The same for the exact tooth form, loaded at a radius. The slice is taken in the normal section: the transverse form
/// with its thickness times cos(beta) and tan a = cos(beta) tan a_t; y_p is where the load's line meets the centre
/// line. The deflection is that of the centre line; the part between it and the flank belongs to the contact law. The
/// tooth is clamped in the rim at the lowest points of its fillets; heights and thickness are taken there. Neighbouring
/// slices do not help (no convection), and the rim is massive.
///
/// Grows with the radius; at the very foot of the involute (its lowest tenth) of an undercut or coarse tooth it may
/// fall by up to 8 % first. Not part of it: Hertzian flattening, gear-body and shaft deflection.
///
/// @param radius  [mm], form.form_radius() <= radius <= form.tip_radius()
ToothCompliance tooth_compliance(const ToothForm& form, double radius, double poissons_ratio);

}  // namespace flankwright
