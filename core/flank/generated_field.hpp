#pragma once

#include <memory>

#include "core/gear/deviation_field.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// The flank that the tool of one gear leaves (GearData::generation), as a deviation from the involute; null for the straight
/// rack. D = 0 at the reference circle in mid face; elsewhere D >= 0.
///
/// Exact with its derivatives from the form to the tip circle and a little beyond (GeneratedRange::exact_margin); where the
/// crowned tool undercuts the flank above the form circle, only from the start of the active profile. Beyond its ends along rho
/// the field continues with the value and slope it has there (C1), finite for every rho. Along z it is the tool's own surface:
/// NaN past the circle in which a surface of revolution ends, never within 1.2 times half the face width. The field of a
/// ParabolicRack does not depend on z.
/// @pre the pair was built by make_gear_pair(), which refuses tools that cannot generate the flank
std::shared_ptr<const DeviationField> make_generated_field(const GearPair& pair, Member member);

}  // namespace flankwright
