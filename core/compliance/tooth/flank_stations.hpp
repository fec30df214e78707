#pragma once

#include "core/compliance/tooth/flank_compliance.hpp"
#include "core/gear/tooth_form.hpp"

namespace flankwright {

/// Radius of a station, r_Ff + (u + 1)/2 (r_a - r_Ff), within form_radius() .. tip_radius() [mm]; -1 <= u <= 1.
double flank_radius(const ToothForm& form, double u);

/// @param relative_face  B = b/m_n [-]
/// @throws InvalidInput  "place.u" for |u| > 1, "place.zeta" outside 0 .. B
void require_on_flank(const FlankStation& station, double relative_face);

}  // namespace flankwright
