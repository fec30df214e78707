#pragma once

#include "core/contact/assembly/flank_assembly.hpp"
#include "core/contact/unloaded/search_density.hpp"

namespace flankwright {

/// The point of the flanks at which a tooth pair touches first.
enum class ContactKind {
  None,       ///< the flanks do not face each other at this angle
  Line,       ///< along a line: aligned flanks
  Surface,    ///< inside both flanks
  PinionTip,  ///< tip edge of the pinion
  WheelTip,
  PinionRoot,  ///< lower end of the pinion's flank (form circle)
  WheelRoot,
  FaceEnd,  ///< face end of either gear
  Corner    ///< two edges at once
};

/// First contact of one tooth pair at one pinion angle.
struct ToothContact {
  ContactKind kind{ContactKind::None};
  int tooth{0};
  double phi1{not_given};                                ///< pinion angle [rad]
  double phi2{not_given};                                ///< wheel angle at first touch [rad]
  double pinion_radius{not_given}, pinion_z{not_given};  ///< on the pinion [mm], its own frame
  double wheel_radius{not_given}, wheel_z{not_given};    ///< on the wheel [mm], its own frame
  /// delta_phi2 = phi2 - (N1/N2) phi1 [rad], wheel.
  double transmission_error{not_given};
  /// d(delta_phi2)/d(phi1) [rad/rad], exact by the envelope theorem; where the contact changes its kind, of the side found.
  double slope{not_given};

  bool exists() const { return kind != ContactKind::None; }
};

/// Unloaded contact of tooth pairs:
///
///     phi2(phi1) = max over (rho1, z1) of the wheel angle that puts the wheel's flank through the pinion's point,
///     subject to form..tip and face ends of *both* flanks.
///
/// One solver for line, surface, edge and corner contact, without an initial guess from outside. In a transverse
/// section of the pinion (fixed z1) the angle is maximised over the roll length, from where undisturbed flanks would
/// touch, by secant steps on its exact slope inside the section's bounds. The section maxima, a function of z1 alone
/// with an exact slope by the envelope theorem, are sampled in sections over the face, and every maximum between two of
/// them is refined in the same way. Slope jumps (start of a linear relief on either gear) and flat valleys (aligned
/// gears) need no special case.
///
/// Global within a resolution: search_density() decides once per assembly whether a section can have several maxima
/// (hollow or wavy flanks) and how many sections the line of contact needs. Between sections the hollow curvature of
/// the flanks bounds the height of an unseen maximum; where that exceeds what is known the interval is halved. Maxima
/// in different pieces of a profile (with several maxima none longer than 1/32 of it) and in different intervals of a
/// hollow face (1/32 of it) are separated; of two in one, one is found.
///
/// A pair touches along a line where the maximum stays within 1e-9 mm (along the base tangent) over 1/200 of the face
/// width to either side that the flanks cover; the point given is then the middle of the sections that lie on it.
class ToothContactSolver {
 public:
  /// @param assembly  must outlive the solver
  explicit ToothContactSolver(const FlankAssembly& assembly) : assembly_(assembly), density_(search_density(assembly)) {}

  /// First contact of tooth pair `tooth`, which runs k pitches ahead of the reference pair 0, at pinion angle phi1 [rad].
  ToothContact find(int tooth, double phi1) const;

 private:
  const FlankAssembly& assembly_;
  SearchDensity density_;
};

/// One first contact of one assembly; for many of the same assembly a ToothContactSolver saves the judgement of the
/// flanks.
ToothContact find_tooth_contact(const FlankAssembly& assembly, int tooth, double phi1);

/// Lower-case name of the kind as results.json has it ("pinion_tip").
const char* to_string(ContactKind kind);

}  // namespace flankwright
