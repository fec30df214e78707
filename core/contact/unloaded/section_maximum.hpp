#pragma once

#include <limits>

#include "core/base/peak.hpp"
#include "core/contact/unloaded/contact_condition.hpp"

namespace flankwright {

/// Which bound of a transverse section holds its maximum.
enum class SectionBound { None, PinionRoot, PinionTip, WheelRoot, WheelTip };

/// A contact at a fixed point of both flanks, and the change of the wheel angle with the removal from either.
struct Touch {
  double rho{not_given}, z{not_given};              ///< on the pinion [mm]
  double wheel_rho{not_given}, wheel_z{not_given};  ///< on the wheel: roll length of the point's involute, own frame [mm]
  double slope_rho{0.0}, slope_phi1{0.0};           ///< of phi2, see FlankContact [rad/mm, rad/rad]
  double wheel_pace{1.0};                           ///< 1/(1 - dD/drho) of the wheel there
};

/// First contact in one transverse section of the pinion: the largest wheel angle over its roll length, inside both flanks. Where
/// the wheel's face ends before the section does, that end is the rest of it, see ContactCondition.
struct SectionMaximum {
  bool exists{false};                                     ///< false where no point of the section lies on both flanks
  double z{0.0};                                          ///< height of the section [mm]; the point's own is at.z
  double phi2{-std::numeric_limits<double>::infinity()};  ///< [rad]
  /// d(phi2)/dz [rad/mm], exact, bounds that move with z included; 0 where the wheel's end holds the point, and what leads
  /// back into the face where the section runs along that end to no avail.
  double slope_z{0.0};
  double slope_phi1{0.0};  ///< d(phi2)/d(phi1) [rad/rad], likewise
  SectionBound bound{SectionBound::None};
  bool held_by_wheel_end{false};  ///< a wider wheel would touch earlier
  FlankContact at;
  /// On a kink (start of a linear relief, of either gear) the maximum is the mean of both its sides, Lagrange's multipliers the
  /// weights: what lies beyond it from `at`, and its share, 0 where there is no kink.
  Touch beyond;
  double share_beyond{0.0};

  // A sample for find_peak().
  double position() const { return z; }
  double value() const { return phi2; }
  double slope() const { return slope_z; }
};

Touch touch_at(const FlankContact& contact);

/// Coarse: the point is a tenth of a micrometre off, so the angle, completed by its known curvature, is at round-off all but on
/// kinks, and the slopes are good for their signs. Full: round-off.
enum class SectionAccuracy { Coarse, Full };

/// Maximises over sections z = const of the pinion's flank.
class SectionSearch {
 public:
  /// @param cells  pieces into which the profile is cut, each searched for a maximum of its own; 1: there is only one
  SectionSearch(const ContactCondition& contact_condition, int cells) : condition_(contact_condition), cells_(cells) {}

  /// @param neighbour  the maximum of a section nearby, to start from, or one that does not exist; decides how fast, and not
  ///                   what, is found
  SectionMaximum at(double z, const SectionMaximum& neighbour, SectionAccuracy accuracy) const;

 private:
  struct Range;
  struct Sample;
  struct Tolerance;

  SectionMaximum only_maximum(double z, const SectionMaximum& neighbour, const Tolerance& tolerance) const;
  SectionMaximum highest_maximum(double z, const Tolerance& tolerance) const;
  SectionMaximum settle(double z, const Range& range, const Tolerance& tolerance, const Peak<Sample>& peak) const;
  SectionMaximum finish(double z, const FlankContact& contact, SectionBound bound) const;
  bool move_onto_wheel(double z, const Range& range, const Tolerance& tolerance, FlankContact& contact, SectionBound& bound) const;
  bool move_to_radius(double z, const Range& range, const Tolerance& tolerance, double radius, FlankContact& contact) const;
  double radius_of(SectionBound bound) const;

  const ContactCondition& condition_;
  int cells_;
};

}  // namespace flankwright
