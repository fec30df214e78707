#pragma once

#include <array>
#include <cstddef>

#include "core/compliance/thin_slice/iso_stiffness.hpp"
#include "core/gear/gear_pair.hpp"
#include "core/gear/tooth_form.hpp"

namespace flankwright {

/// How the thin-slice compliance compares with ISO 6336-1.
enum class ThinSliceStatus {
  Calibrated,       ///< calibration() > 0 makes the single-pair stiffness ISO's
  HertzExceedsIso,  ///< the Hertzian part alone exceeds ISO's flexibility: used as computed, calibration() = 1
};

/// Structural compliance of a pair of teeth without coupling along the face: every mm of contact line is an independent
/// slice,
///
///     q(r_1, r_2) = kappa (Q_1(r_1)/E_1 + Q_2(r_2)/E_2),
///
/// Q from Weber and Banaschek (tooth_compliance()). One factor kappa brings it to ISO 6336-1, method B: at the pitch
/// point, under 300 N per mm of contact line (which is F_bt/b = 300 N/mm of face width: normal load and contact line
/// both carry cos(beta_b)), structure and Hertz together are ISO's flexibility 1/(c'_th C_M C_R C_B), scaled by the
/// moduli,
///
///     q(r_w1, r_w2) + c(300)/300 = 1e-3 / iso().normal_section,
///
/// c being the contact law without tip factor. Where the pitch point lies outside the path of contact its middle is
/// used instead. kappa > 0 for every steel pair tried (3966 of 5 .. 500 teeth, modules 0.1 .. 50 mm, pressure angles
/// from 12 to 28 deg, helix angles to 45 deg, profile shifts -1 .. 1): about 1.2 .. 1.5 without profile shift, mostly
/// ISO's C_M = 0.8 (measured stiffness over computed), at most 2.13, and near 0 only for teeth almost severed by
/// undercut. Where Hertz alone exceeds ISO's flexibility, with moduli of elasticity far above that of steel, status() says so.
///
/// Q is tabulated over the roll length; the interpolation error was below 2e-4 of Q in 2690 such pairs.
class ThinSlice {
 public:
  /// @throws InvalidInput where a material is out of range
  ThinSlice(const GearPair& pair, const Material& pinion, const Material& wheel);

  /// Compliance of the pair [mm per (N per mm of contact line)], normal to the flank.
  /// @param pinion_radius, wheel_radius  contact radii [mm]; below a form radius or above a tip radius that end's value
  ///                                     is used
  double compliance(double pinion_radius, double wheel_radius) const;

  /// The same for one gear; the pair's compliance is the sum of both.
  double compliance_of(Member member, double radius) const;

  double calibration() const { return calibration_; }  ///< kappa [-]
  ThinSliceStatus status() const { return status_; }
  const IsoStiffness& iso() const { return iso_; }

 private:
  static constexpr std::size_t kNodes = 65;  ///< of the table, for the interpolation error of the class comment

  /// Q/E of one gear: cubic Hermite interpolation between equal steps of roll length.
  struct Table {
    double base_radius, first_roll, last_roll;
    std::array<double, kNodes> values, slopes;  ///< slopes per interval
    Table(const ToothForm& form, const Material& material);
    double operator()(double radius) const;
  };

  Table pinion_, wheel_;
  IsoStiffness iso_;
  double calibration_{1};
  ThinSliceStatus status_{ThinSliceStatus::Calibrated};
};

/// The tooth form of one gear of a pair, with the tip radius that the pair settled on.
ToothForm tooth_form(const GearPair& pair, Member member);

}  // namespace flankwright
