#pragma once

#include <optional>

#include "core/compliance/pair/pair_compliance.hpp"
#include "core/compliance/shaft/shaft_beam.hpp"
#include "core/compliance/shaft/shaft_data.hpp"

namespace flankwright {

/// The motion that the teeth's structural model leaves to the shaft.
enum class GearBodyIn {
  /// The model has teeth only (thin slices): forces and moments act on the shaft where the tooth is loaded.
  Shaft,
  /// The model has the gear's body and removes, of the shaft's motion, the translation of the section of the load, the
  /// tilt at mid face and the rotation at the face end where the torque leaves [NetFunctionals]. Just these act on the
  /// shaft, there: the gear's torsion and the tilt of its sections against mid face remain the model's.
  Structure,
  /// The model has the gear down to a bore that is held: forces and moments act on the shaft at mid face, on which the bore turns and tilts as a
  /// rigid sleeve.
  RigidBore,
};

/// The shaft with the gear on it as a beam, z from the shaft's first end.
///
/// Sections are cylinders, E and nu the shaft's: I = pi (d^4 - d_i^4)/64, I_p = 2 I, kappa G A with Cowper's kappa for a
/// hollow circle,
///
///     kappa = 6 (1 + nu)(1 + m^2)^2 / ((7 + 6 nu)(1 + m^2)^2 + (20 + 12 nu) m^2),   m = d_i/d_o
///
/// (0.89 for a solid shaft of steel; Haddad 1991, eq. 2C.8 has 3/4, the largest stress over the mean). Over the face of a gear that is
/// one with the shaft the outer diameter is the root circle's for torsion and shear [eqs 2C.5, 2C.13] and the mean of tip and root for
/// bending [eq. 2C.30], unless the shaft's own is larger.
/// @throws InvalidInput  as find_problems()
std::vector<BeamPiece> shaft_pieces(const ShaftData& shaft, const Gear& gear);

/// The beam on its bearings, held against turning where the torque enters.
ShaftBeam make_shaft_beam(const ShaftData& shaft, const Gear& gear);

/// Motion of one gear's shaft along the common normal, transverse base tangent.
struct ShaftMotion {
  double displacement{not_given};  ///< at mid face [mm], + away from the mate
  /// Over the common face, at z = +b/2 less at z = -b/2 [mm]: + opens the mesh at +z, as mesh_misalignment does.
  double misalignment{not_given};
};

/// Shafts of a pair in the influence matrix [Haddad 1991, 7.3, suggestion 5; app. 2C with a force at every contact point]:
///
///     K(p, q) = t_p' S^-1 t_q   for each gear that has a shaft,
///
/// with t_p the wrench on the shaft of a unit normal force at p, taken in the base tangent plane: force n and moment
/// about the axis, axial force and its moment included; also where a tip edge touches outside that plane, as the load
/// distribution takes the force there. Symmetric and positive semi-definite by construction. The shafts are coupled
/// only through the mesh.
///
/// Departures from app. 2C, which has the whole load at mid face, the translation of the axis alone (the section's
/// rotation about axes across its own is left out there) and a moment of the axial force that lies in the plane of action.
class ShaftPair final : public PairCompliance {
 public:
  /// @throws InvalidInput  "pinion.shaft." or "wheel.shaft." and the field of find_problems()
  ShaftPair(const GearPair& pair, std::optional<ShaftData> pinion, std::optional<ShaftData> wheel, PerGear<GearBodyIn> body);
  /// Both gears alike.
  ShaftPair(const GearPair& pair, std::optional<ShaftData> pinion, std::optional<ShaftData> wheel, GearBodyIn body)
      : ShaftPair(pair, std::move(pinion), std::move(wheel), PerGear<GearBodyIn>{body, body}) {}

  /// K of both shafts together [mm/N].
  Eigen::MatrixXd influence(const std::vector<ContactPoint>& points, double axial_offset) const override;

  /// Motion of one gear's shaft under normal forces at the points; NaN where the gear has none.
  /// @param forces  [N], one a point
  ShaftMotion motion(Member member, const std::vector<ContactPoint>& points, const Eigen::VectorXd& forces, double axial_offset) const;

  bool has_shaft(Member member) const { return side(member).has_value(); }

 private:
  struct Side {
    ShaftData data;
    ShaftBeam beam;
  };
  const std::optional<Side>& side(Member m) const { return m == Member::Pinion ? pinion_ : wheel_; }
  int parts(Member m) const { return body_[m] == GearBodyIn::Structure ? 3 : 1; }
  /// Wrenches of unit normal forces, parts() a point.
  std::vector<BeamLoad> loads(Member member, const std::vector<ContactPoint>& points, double axial_offset) const;

  GearPair pair_;
  PathOfContact path_;
  PerGear<GearBodyIn> body_;
  std::optional<Side> pinion_, wheel_;
};

}  // namespace flankwright
