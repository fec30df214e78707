#pragma once

#include <compare>

namespace flankwright {

/// The position of the wheel relative to the pinion. Axes: x from pinion to wheel along the line of centres, z along
/// the pinion axis, y = z x x; the pinion drives in +y. All rotations are of the wheel, right-handed, about its
/// mid-face centre. Zero everywhere is the aligned pair.
struct Misalignment {
  double crossing{0.0};               ///< about x [rad]: Litvin's delta gamma, f_Sigma_beta; + closes the mesh at +z
  double intersecting{0.0};           ///< about y [rad]: f_Sigma_delta; + opens the mesh at +z
  double centre_distance{0.0};        ///< delta E [mm], + apart
  double axial_offset{0.0};           ///< wheel towards +z [mm]
  double pinion_lead_angle{0.0};      ///< delta lambda_p1 [rad], TM-107451 app. 2 in full: r_p1, r_b1, p_1 follow
  double pinion_pressure_angle{0.0};  ///< delta alpha_n1 [rad], TM-107451 eqs 15-17
  double mesh_misalignment{0.0};      ///< F_beta_y [mm]: deviation of the flank lines over the smaller face width, transverse base
                                      ///< tangent, linear, zero at the wheel's mid face; + opens at +z

  auto operator<=>(const Misalignment&) const = default;
};

}  // namespace flankwright
