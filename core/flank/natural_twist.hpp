#pragma once

#include <memory>

#include "core/flank/contact_shift.hpp"
#include "core/flank/modifications/modification.hpp"
#include "core/gear/deviation_field.hpp"

namespace flankwright {

/// What the process of a flank adds to its lead modification f, all modifications of ModificationClass::Lead together:
///
///     D = f(z - h(rho)) - f(z)
///
/// with the process' ContactShift h, exact with its derivatives. Null where the process twists nothing, of a spur gear, and without lead modification.
/// Crowning C (2z/b)^2 becomes the twist 8 C tan(beta_b) g_alpha/b of natural_twist(), a profile slope that changes along the face, and a profile
/// crowning of C (2 h/b)^2.
/// @throws InvalidInput "grinding_wheel_diameter", see FormWheelContact
std::shared_ptr<const DeviationField> make_natural_twist_field(const GearPair& pair, Member member, const Modification& modification);

/// Natural twist S over roll and face, as the modification `twist` counts it: the profile slope that the process brings from the start of the active
/// profile to the tip, at z = +b/2 less that at z = -b/2 [mm]; + removes at the tip at z = +b/2. 0 where the process twists nothing.
double natural_twist(const GearPair& pair, Member member, const Modification& modification);

/// What the process moves along the face over the active profile: h(tip) - h(start of active profile) [mm]; 0 where it moves nothing.
double contact_shift_over_profile(const GearPair& pair, Member member, const GrindingProcess& process);

}  // namespace flankwright
