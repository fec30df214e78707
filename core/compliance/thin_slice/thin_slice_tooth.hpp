#pragma once

#include "core/compliance/tooth/flank_compliance.hpp"
#include "core/gear/tooth_form.hpp"

namespace flankwright {

/// One gear's teeth as independent thin slices, in terms of point loads, for comparison with models that couple along
/// the face. Slices deflect under line loads, and a point load has none; so load and deflection are both means over
/// `spread` of the contact line around their points: with Q E the deflection per line load (tooth_compliance()) and d
/// the distance of the points along the tooth trace, in modules,
///
///     E m_n K(p, q) = calibration sqrt(Q_p Q_q) / spread  max(0, 1 - |d|/spread);
///
/// under its own load a slice yields by Q/spread, beyond the spread nothing moves. Symmetric and positive
/// semi-definite. Two heights of one slice, which a contact line never meets at once, have the geometric mean of both.
class ThinSliceTooth final : public FlankCompliance {
 public:
  static constexpr double kSpread = 1.0;  ///< [m_n]

  /// @param normal_module   m_n [mm], > 0, of the form
  /// @param face_width      b [mm], > 0
  /// @param poissons_ratio  nu, 0 <= nu < 0.5
  /// @param calibration     > 0; 1 is Weber and Banaschek's tooth, ThinSlice::calibration() ISO's
  ThinSliceTooth(const ToothForm& form, double normal_module, double face_width, double poissons_ratio, double calibration = 1);

  /// E m_n K [-], n x n; 0 between teeth. @throws InvalidInput as require_on_flank()
  Eigen::MatrixXd evaluate(std::span<const FlankStation> points) const override;

 private:
  ToothForm form_;
  double relative_face_, poissons_ratio_, calibration_;
};

}  // namespace flankwright
