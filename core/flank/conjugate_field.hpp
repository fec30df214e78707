#pragma once

#include <memory>

#include "core/gear/deviation_field.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// A deviation field with one coefficient that a designer may vary.
class PredesignedField : public DeviationField {
 public:
  /// dD/d(coefficient) at fixed rho and z, exact; past the ends between which the field is exact, with those ends held.
  virtual double coefficient_slope(double rho, double z) const = 0;
};

/// The flank whose unloaded transmission error is the predesigned parabola delta_phi2 = -a phi1^2 exactly (Modification::parabolic_te),
/// as a deviation from the involute: what the mate's involute flank envelops while the wheel turns by
///
///     phi2 = (N1/N2) phi1 - a phi1^2.
///
/// On parallel axes every transverse section is conjugate by itself. The pitch point divides the centre distance as 1
/// to dphi2/dphi1, the contact normal is the tangent from it to the mate's base circle, and contact lies on it where
/// the mate's involute does, so that flanks touch along lines as involutes do, and one scalar root gives D. To first
/// order in a it is r_b2 a phi1^2 along the whole line of contact of phi1, and that is the lag of the mesh to all
/// orders, see removal(); a little more must be removed from the flank itself, because contact slides along the profile
/// to where less is removed.
///
/// Contact runs along this flank by the factor 1 - 2 a/K slower than along the involute, K = (rho_1^2/r_b2)(1/rho_1 +
/// 1/rho_2) ((rho_2 N1/N2)^2 for rho_1^2 on the wheel), and the flank would fold over itself at 2 a = K, first near the
/// base circle. Exact with its derivatives from the start of the active profile to the tip circle and a little beyond
/// (GeneratedRange) as far as that factor is at least 1/2; from there it continues with its value and slope (C1), where
/// the pair's own curve lags less than the parabola.
/// @param coefficient  a [1/rad]; 0 gives the involute
/// @throws InvalidInput "parabolic_te" where that end lies inside the pitch in which an aligned pair is the leading
///                       one, |phi1| <= pi/N1 at mid face
std::shared_ptr<const PredesignedField> make_conjugate_field(const GearPair& pair, Member member, double coefficient);

}  // namespace flankwright
