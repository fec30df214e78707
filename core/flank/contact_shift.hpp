#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/base/dual.hpp"
#include "core/base/jet.hpp"
#include "core/flank/grinding_process.hpp"
#include "core/gear/pair_geometry.hpp"

namespace flankwright {

/// How far along the face a grinding tool finishes a point of roll length rho while it is fed to mid face: with the tool at feed position zeta the points
/// z = zeta + h(rho) are finished, in the frame of Flank. A lead modification f, which the machine makes of the feed position, is at the point (rho, z)
///
///     f(z - h(rho)),         h = (1 - twist_compensation) (h_tool(rho) - h_tool(rho_0)).
///
/// Generating grinding: threaded wheel and gear touch in a point that runs along the normal common to their flanks as they roll. That line lies in the
/// gear's plane of action and makes the angle beta_b with its transverse plane, so that a roll of d rho moves the point along the axis by
///
///     h_tool = -tan(beta_b) rho,                 tan(beta_b) signed as Flank::helix_rate.
///
/// Form grinding: the wheel touches along a line of which every point has another z, see FormWheelContact; h_tool rises with tan(beta_b) rho there.
///
/// rho_0 is the middle of the active profile: there the flank has the lead that was asked for. Helix deviations are measured there [ISO 1328-1], and the
/// measured trace is what a machine's feed is centred by.
///
/// How the tool displaces the flank does not matter, as long as it does so alike over the profile: a threaded wheel's infeed Delta removes
/// Delta sin(alpha_t), an added turn of the work removes r_b times its angle, both along the base tangent. A lead slope that comes from a changed
/// differential is no exception: at each feed position it is a turn of the work. The flank gets the profile slope -h'(rho) C_Hbeta/b with it: that of a
/// helicoid with the tool's normal base pitch. A setter takes it out by the pressure angle that the tool is dressed to: profile_slope, with the other
/// sign. Of form grinding the turn of the work is meant, for each flank by itself. An infeed of the form wheel, for both flanks at once, removes
/// in proportion to the sine of the profile's angle against the middle of the space, more at the tip than at the root; that is not modelled.
///
/// First order in the removal: where f has the slope f' the tool touches beside its nominal point and takes R f'^2/2 more, with R its radius of curvature
/// against the flank along the feed; for R = 0.4 m and 1 um/mm that is 0.2 um.
class ContactShift {
 public:
  /// Nothing for a process that twists no lead modification, and for spur gears.
  /// @throws InvalidInput "grinding_wheel_diameter", see FormWheelContact
  static std::optional<ContactShift> of(const GearPair& pair, Member member, const GrindingProcess& process);

  /// h [mm] at roll length rho [mm]; the shift of a FormWheelContact as a polynomial through it at the Chebyshev points between form and tip circle, to
  /// 1e-5 mm, and its tangents beyond. Scalar is double, Dual<N> or Jet.
  template <class Scalar>
  Scalar at(const Scalar& rho) const {
    const double x = (value_of(rho) - middle_) / half_;
    if (x < -1.0) return (rho - (middle_ - half_)) * lower_.u + lower_.value;
    if (x > 1.0) return (rho - (middle_ + half_)) * upper_.u + upper_.value;
    return sum((rho - middle_) * (1.0 / half_));
  }
  /// The same at radius r [mm]; below the base circle that of the base circle.
  double at_radius(double r) const { return at(std::sqrt(std::max(0.0, (r - base_radius_) * (r + base_radius_)))); }

 private:
  static constexpr std::size_t most_terms = 16;

  ContactShift(const Gear& gear, double lowest, double highest);
  void finish(double centre_roll, double share);

  /// Sum of c_k T_k(x) [Clenshaw].
  template <class Scalar>
  Scalar sum(const Scalar& x) const {
    Scalar after = 0.0, here = 0.0;
    for (std::size_t k = terms_ - 1; k > 0; --k) {
      const Scalar before = 2.0 * x * here - after + chebyshev_[k];
      after = here;
      here = before;
    }
    return x * here - after + chebyshev_[0];
  }

  double base_radius_;    ///< r_b [mm]
  double middle_, half_;  ///< of the roll lengths between form and tip circle [mm]
  std::size_t terms_{2};
  std::array<double, most_terms> chebyshev_{};  ///< [mm]
  Jet lower_, upper_;                           ///< value and slope by rho at both ends
};

}  // namespace flankwright
