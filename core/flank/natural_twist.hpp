#pragma once

#include <memory>
#include <optional>

#include "core/flank/contact_shift.hpp"
#include "core/flank/modifications/modification.hpp"
#include "core/flank/removal.hpp"
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

/// Derivative of a ground flank's deviation by the twist_compensation c of its process [mm], exact with its derivative by the radius:
///
///     dD/dc = f'(z - (1 - c) h(rho)) h(rho)
///
/// with the ContactShift h of the process without compensation; where f' jumps that of the side without relief. 0 where the process has no natural
/// twist, of a spur gear, and without lead modification.
class CompensationDerivative {
 public:
  /// @throws InvalidInput "grinding_wheel_diameter", see FormWheelContact
  CompensationDerivative(const GearPair& pair, Member member, const Modification& modification);

  double at(double r, double z) const { return with_slope(r, z).value; }
  RemovalDerivative::WithSlope with_slope(double r, double z) const;
  /// Whether it depends on the roll length at r: always.
  static constexpr bool is_shifted() { return true; }

 private:
  DeviationFormula lead_;  ///< f
  double base_radius_, pitch_radius_;
  double left_;                        ///< 1 - c
  std::optional<ContactShift> shift_;  ///< h
};

/// Natural twist S over roll and face, as the modification `twist` counts it: the profile slope that the process brings from the start of the active
/// profile to the tip, at z = +b/2 less that at z = -b/2 [mm]; + removes at the tip at z = +b/2. 0 where the process twists nothing.
double natural_twist(const GearPair& pair, Member member, const Modification& modification);

/// What the process moves along the face over the active profile: h(tip) - h(start of active profile) [mm]; 0 where it moves nothing.
double contact_shift_over_profile(const GearPair& pair, Member member, const GrindingProcess& process);

}  // namespace flankwright
