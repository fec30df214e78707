#pragma once

#include "core/compliance/finite_element/loaded_section.hpp"
#include "core/compliance/tooth/half_space_correction.hpp"

namespace flankwright {

/// Deflection of a flank is split into that of the structure, centre_functional() with loads and deflections at the tooth's centre surface, and the
/// contact law's, which goes down to the centre through a half space. A tooth is no half space, and the functional spreads a load a little more than
/// contact does. What both leave out is solved for here, in plane strain, on the tooth in its section across the contact line:
///
///     rho = u_p - l_mid' A^-1 l_mean - (2/pi)(1 - nu^2) [asinh(h') - nu/(1 - nu) h' (sqrt(1 + h'^2) - h')],   h' = h/L,
///
/// u_p the deflection of the flank itself under the middle of Hertz's pressure of half width L (thin against the tooth), l_mean the loads of points
/// evenly along the face, integrated across it, l_mid the functional of a point at mid face. All of a unit line load and E = 1. u_p and the last term
/// have the same near field, so that L cancels: from L = 0.05 to 0.2 m_n rho changes by 0.01.
///
/// It is added to the contact law of such structures, in place of Steward's tip factor, which does for slices. What the end faces soften (FreeEnd)
/// is then counted from its value at mid face: what a narrow face adds there, the structure has already. Against the flank's deflection of whole spur
/// teeth in three dimensions (half_space_correction_test.cpp) the sum is right to 0.045 w/E for each gear from a face of two modules up, where it was 0.05 to 0.35 short.
///
/// Solved for at heights of 0.05 to 0.97 of the flank, extrapolated to 0.99, and level beyond.
///
/// @param section  of the gear, with fine_section()
/// @param gear     its flank's radii are used
HalfSpaceCorrection half_space_correction(const LoadedSection& section, const Gear& gear);

}  // namespace flankwright
