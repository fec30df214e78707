#pragma once

#include <optional>

#include "core/gear/tooth_form.hpp"

namespace flankwright {

/// A face end of a helical tooth by the angle between loaded flank and face there: less than a right angle, or more.
/// The acute end of a spur gear is the one at z = -b/2 of GearToMesh.
enum class FaceEnd { Acute, Obtuse };

/// Bore over shaft diameter where no bore is given: as near to a solid shaft as elements go.
inline constexpr double default_bore_share = 0.05;

/// Hub diameter over that of the shaft, or of the bore that is held, where no hub is given: a usual hub of steel.
inline constexpr double default_hub_share = 1.5;

/// What carries a gear at its centre.
enum class BodyHold {
  /// An elastic shaft runs through the gear and is one piece with it: a gear cut on its shaft, or a joint that neither slips nor opens.
  Shaft,
  /// The surface of the gear's bore neither yields nor moves. There is no shaft.
  RigidBore,
};

/// "shaft", "rigid_bore".
const char* to_string(BodyHold hold);

/// Holes through a web, evenly spaced on a circle.
struct WebHoles {
  int count{0};                       ///< n, 0: none; otherwise >= 3
  double diameter{not_given};         ///< d_h [mm]
  double circle_diameter{not_given};  ///< d_c [mm]; not given: midway between hub and rim
};

/// Young's modulus of the band of the web that the holes lie in, between the diameters d_c - d_h and d_c + d_h, over that of the material:
///
///     (1 - f)^3,   f = n d_h / (4 d_c),
///
/// the differential scheme for a sheet with circular holes of the area fraction f [McLaughlin 1977, Int. J. Eng. Sci. 15, 237]; where f is small
/// it is the exact 1 - 3 f. f is the holes' area over that of the band. Holes that all but touch have f = pi/4 and 1 % of the stiffness left.
/// Not modelled: that the band is softer right between two holes, as the gear turns under the load.
double hole_stiffness(const WebHoles& holes);

/// The part of a gear below its teeth made of a rim as wide as the face, a web, and a hub. The hub's middle lies at mid face.
struct WebbedBody {
  double rim_thickness{not_given};  ///< from the root circle to the rim's underside [mm], >= 0.5 m_n
  double web_thickness{not_given};  ///< [mm], at least 0.1 m_n
  double web_offset{0.0};           ///< of the web's middle from mid face [mm], + towards the end at +b/2
  double hub_diameter{not_given};   ///< [mm]; not given: default_hub_share of the shaft's, or of the held bore's
  double hub_width{not_given};      ///< [mm]; not given: the face width
  WebHoles holes{};
};

/// The gear body: a disc as wide as the face, or rim, web and hub, and what holds it.
struct GearBody {
  double shaft_diameter{not_given};  ///< d_s [mm]; not given: default_shaft_diameter(); only with BodyHold::Shaft
  /// [mm], > 0. BodyHold::Shaft: of the shaft; not given: default_bore_share d_s. RigidBore: of the gear; not given: default_shaft_diameter().
  double bore_diameter{not_given};
  /// Length of the shaft beyond each face end, or beyond the hub's where that is wider [mm], > 0; not given: 0.5 d_s; only with BodyHold::Shaft.
  double shaft_overhang{not_given};
  /// The end at which torque and axial force leave the gear. The gear is twisted between this end and the load.
  /// Haddad's sample outputs show the default: pinion loads that fall towards the other, acute end.
  FaceEnd torque_end{FaceEnd::Obtuse};
  /// Everything inside rim_radius() is rigid. Only the teeth and the material below them yield, as Vedmar modelled them
  /// [Haddad 1991, 1.4.3.2].
  bool rigid{false};
  BodyHold hold{BodyHold::Shaft};
  std::optional<WebbedBody> web{};  ///< empty: a solid disc

  /// What is given in neither counts as equal.
  bool operator==(const GearBody& other) const;
};

/// Steward's rule for helical gears [Haddad 1991, eq. 2.4]: d_s = 0.8 d, at most 25 m_n / cos(beta). Departure: at
/// most the root diameter less 1.2 m_n (which matters below 18 teeth), so that a rim is left.
double default_shaft_diameter(const ToothForm& form, double normal_module);

/// The body, with defaults for what is not given.
GearBody complete_body(const GearBody& body, const ToothForm& form, double normal_module, double face_width);

/// The body with every length over a unit.
GearBody in_units(GearBody body, double unit);

/// Where the teeth's own material ends and the gear's body begins [mm]: 1.25 m_n below the root circle, or the surface inside the teeth (the shaft's, a
/// held bore's or the rim's underside) where that is less than 1.8 m_n below it. Elastic half-planes under a tooth are taken to reach "a few modules" below the
/// pitch point [Haddad 1991, 1.3.2]; this is 2.5 of them with a standard rack.
double rim_radius(const ToothForm& form, double inner_diameter, double normal_module);

/// The cylinders that bound the parts of a body [mm].
struct BodyRadii {
  double teeth{not_given};      ///< rim_radius()
  double underside{not_given};  ///< of the rim; NaN: a solid disc
  double hub{not_given};        ///< NaN: a solid disc
  double carrier{not_given};    ///< the shaft's surface, or the bore that is held
  double bore{not_given};       ///< of the shaft, or the bore that is held
};

/// The radii of a complete body, with all its checks.
///
/// @throws InvalidInput  "body." and the key that does not fit, with its allowed range
BodyRadii body_radii(const GearBody& body, const ToothForm& form, double normal_module, double face_width);

}  // namespace flankwright
