#pragma once

#include <optional>

#include "core/compliance/tooth/flank_compliance.hpp"
#include "core/compliance/plate/tapered_plate.hpp"
#include "core/gear/tooth_form.hpp"

namespace flankwright {

/// A tooth as a rack-shaped cantilever plate on an elastic foundation, in the spirit of Umezawa (1972) and of Inoue and
/// Tobe (1981), who added shear and the foundation [Haddad 1991, 1.4.2]; for comparison with more complete models.
///
/// The plate is the tooth's centre surface in its normal section, straightened: as long as the tooth trace, B /
/// cos(beta), with the thickness of this tooth over its height, from the lowest point of the fillet to the tip. Its
/// foundation is Weber and Banaschek's, so that under a load that is constant along the trace every slice deflects by
/// tooth_compliance(), less its compression. Unlike slices, the plate couples neighbouring sections.
///
/// A load on the flank acts where its line meets the centre surface, with its component cos(a) across the plate;
/// beneath the foot, at the foot. It enters over a piece of the plate as wide as Boussinesq's stress is (same variance)
/// at half the depth of the centre surface, where finite-element loads have their source.
///
/// Left out are the load's component along the plate and its compression; the oblique ends of helical teeth (acute and
/// obtuse end are alike, stations count from either at the same fraction of the face width); the foundation's own
/// coupling along the trace; other teeth, which do not move, and the gear body. Hence there is no influence between
/// teeth.
class CantileverPlate final : public FlankCompliance {
 public:
  /// @param normal_module   m_n [mm], > 0, of the form
  /// @param face_width      b [mm], > 0
  /// @param poissons_ratio  nu, 0 <= nu < 0.5
  /// @param correction      of the numbers of polynomials, >= 1
  /// @throws InvalidInput as TaperedPlate
  CantileverPlate(const ToothForm& form, double normal_module, double face_width, double poissons_ratio, double correction = 1);

  /// E m_n K [-], n x n; 0 between teeth. @throws InvalidInput as require_on_flank()
  Eigen::MatrixXd evaluate(std::span<const FlankStation> points) const override;

  const TaperedPlate& plate() const { return *plate_; }

 private:
  ToothForm form_;
  double normal_module_, relative_face_;
  double foot_;  ///< height of the lowest point of the fillet above the gear's centre [m_n]
  std::optional<TaperedPlate> plate_;
};

/// Weber and Banaschek's foundation under a root of the thickness s_f; see slice_compliance().
/// @param root_thickness  s_f > 0 [length]
EdgeCompliance tooth_foundation(double root_thickness, double poissons_ratio);

}  // namespace flankwright
