#pragma once

#include <optional>

#include "tests/benchmarks/contact_truth/contact_mesh.hpp"
#include "tests/benchmarks/contact_truth/root_curve.hpp"
#include "tests/benchmarks/contact_truth/rounded_tip.hpp"

namespace flankwright::contact_truth {

/// The surface of a gear's detailed teeth: which of them are loaded, how many elements lie along them, and where the nodes of those lie. Teeth are counted
/// counter-clockwise. Of a tooth, side 1 is the one that may be loaded, and -1 the other.
class ToothSurface {
 public:
  ToothSurface(const ContactGear& gear, const ContactMeshOptions& options);

  const ToothForm& form() const { return form_; }
  /// Pair k is tooth k of the pinion and -k of the wheel.
  int pair_of(int tooth) const { return pinion() ? tooth : -tooth; }
  int first_loaded() const { return pinion() ? gear_.first : -gear_.last; }
  int last_loaded() const { return pinion() ? gear_.last : -gear_.first; }
  bool loaded(int tooth) const { return tooth >= first_loaded() && tooth <= last_loaded(); }
  /// A loaded tooth with a rounding ends in a cap of its own, between its loaded side, its other flank and the tip land.
  bool capped(int tooth) const { return loaded(tooth) && tip_.has_value(); }

  int flank_elements(int tooth) const { return loaded(tooth) ? options_.flank : options_.far_flank; }
  int fillet_elements(int tooth) const { return loaded(tooth) || options_.far_fillet == 0 ? options_.fillet : options_.far_fillet; }
  int steps(int tooth) const { return flank_elements(tooth) + fillet_elements(tooth); }

  /// Angle of tooth 0's centre line at z = 0 [rad].
  double turn() const;
  /// Radius where the centre line, and the unloaded flank, of a tooth begin [mm].
  double top(int tooth) const;
  /// The surface at half step i from the tip, 0 .. 2 steps(tooth); angles from the centre line.
  Polar profile(int tooth, int side, int i, double z) const;

 private:
  /// Where contact is expected on a loaded flank, by arc length, and how fine elements are there [mm].
  struct Finest {
    double at, size;
  };

  bool pinion() const { return gear_.member == Member::Pinion; }
  double involute_arc(double rho) const { return rho * rho / (2 * form_.base_radius()); }
  Finest finest(int tooth, double z) const;
  double arc(int tooth, int side, int i, double z) const;
  Polar beyond_flank(double length) const;

  const ContactGear& gear_;
  const ContactMeshOptions& options_;
  ToothForm form_;
  PathOfContact path_;
  RootCurve root_;
  double rounding_;  ///< [mm]
  std::optional<RoundedTip> tip_;
};

}  // namespace flankwright::contact_truth
