#pragma once

#include "core/contact/mesh_scene.hpp"

namespace flankwright {

/// Where on the flanks a tooth pair touches first.
enum class ContactKind {
  None,        ///< the flanks do not face each other at this angle
  Line,        ///< along a line: aligned flanks
  Surface,     ///< inside both flanks
  PinionTip,   ///< tip edge of the pinion
  WheelTip,
  PinionRoot,  ///< lower end of the pinion's flank (form circle)
  WheelRoot,
  FaceEnd,     ///< face end of either gear
  Corner       ///< two edges at once
};

/// First contact of one tooth pair at one pinion angle.
struct ToothContact {
  ContactKind kind{ContactKind::None};
  int tooth{0};
  double phi1{not_given};         ///< pinion angle [rad]
  double phi2{not_given};         ///< wheel angle at first touch [rad]
  double pinion_radius{not_given}, pinion_z{not_given};  ///< on the pinion [mm], its own frame
  double wheel_radius{not_given}, wheel_z{not_given};    ///< on the wheel [mm], its own frame
  /// delta_phi2 = phi2 - (N1/N2) phi1 [rad], wheel.
  double transmission_error{not_given};
  /// d(delta_phi2)/d(phi1) [rad/rad], exact by the envelope theorem; where the contact changes its kind, of the side found.
  double slope{not_given};

  bool exists() const { return kind != ContactKind::None; }
};

/// Unloaded contact of tooth pair `tooth` at pinion angle phi1: the bounded problem
///
///     phi2(phi1) = max over (rho1, z1) of the wheel angle that puts the wheel's flank through the pinion's point,
///     subject to form..tip and face ends of *both* flanks.
///
/// One solver for line, surface, edge and corner contact: in a transverse section of the pinion (fixed z1) the angle is a
/// concave function of the roll length, maximised by a safeguarded root of its exact slope inside the section's bounds; the
/// section maxima, a function of z1 alone with an exact slope by the envelope theorem, are searched in 17 sections over the
/// face, and every summit between them is refined by the same safeguarded root. Slope jumps (start of a linear relief on either
/// gear) and flat valleys (aligned gears) need no special case. Outside this are hollow flanks (metal added at the ends of a
/// profile or face) with two maxima in one section or within 1/16 of the face: one of the two is found. Tooth k runs k pitches
/// ahead of the reference tooth 0.
///
/// A pair is said to touch along a line where the maximum stays within 1e-9 mm (along the base tangent) over 1/200 of the
/// face width to either side that the flanks cover.
ToothContact find_tooth_contact(const MeshScene& scene, int tooth, double phi1);

/// Lower-case name of the kind as results.json has it ("pinion_tip").
const char* to_string(ContactKind kind);

}  // namespace flankwright
