#pragma once

#include <cmath>
#include <memory>
#include <optional>

#include "core/compliance/pair/pair_compliance.hpp"
#include "core/compliance/shaft/beam_system.hpp"
#include "core/compliance/shaft/bearing_equilibrium.hpp"
#include "core/compliance/shaft/shaft_data.hpp"
#include "core/compliance/shaft/unit_data.hpp"
#include "core/compliance/shaft/unit_state.hpp"
#include "core/compliance/shaft/unit_statics.hpp"
#include "core/compliance/shaft/unit_supports.hpp"

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

/// A gear that is one with its shaft over its face.
struct GearSeat {
  double from{not_given}, to{not_given};                 ///< [mm]
  double root_radius{not_given}, tip_radius{not_given};  ///< [mm]
};

/// A shaft with gears on it as a beam, z from the shaft's first end.
///
/// Sections are cylinders, E and nu the shaft's: I = pi (d^4 - d_i^4)/64, I_p = 2 I, kappa G A with Cowper's kappa for a
/// hollow circle,
///
///     kappa = 6 (1 + nu)(1 + m^2)^2 / ((7 + 6 nu)(1 + m^2)^2 + (20 + 12 nu) m^2),   m = d_i/d_o
///
/// (0.89 for a solid shaft of steel; Haddad 1991, eq. 2C.8 has 3/4, the largest stress over the mean). Over the face of a gear that is
/// one with the shaft the outer diameter is the root circle's for torsion and shear [eqs 2C.5, 2C.13] and the mean of tip and root for
/// bending [eq. 2C.30], unless the shaft's own is larger.
std::vector<BeamPiece> shaft_pieces(const ShaftData& shaft, const std::vector<GearSeat>& seats);

/// Motion of one gear's shaft along the common normal, transverse base tangent.
struct ShaftMotion {
  double displacement{not_given};  ///< at mid face [mm], + away from the mate
  /// Over the common face, at z = +b/2 less at z = -b/2 [mm]: + opens the mesh at +z, as mesh_misalignment does.
  double misalignment{not_given};
};

/// Shafts of a pair and of the unit around it [Haddad 1991, 7.3, suggestion 5; app. 2C with a force at every contact point]. In the influence matrix
///
///     K(p, q) = t_p' S^-1 t_q,
///
/// with t_p the wrenches on both gears' shafts of a unit normal force at p, taken in the base tangent plane: force n and moment
/// about the axis, axial force and its moment included; also where a tip edge touches outside that plane, as the load
/// distribution takes the force there. S^-1 is the flexibility of all shafts on their bearings, see BeamSystem: shafts that neither housing nor bearings
/// couple add up. Symmetric and positive semi-definite by construction.
///
/// Other meshes and outside loads act with their mean forces f T, in proportion to the torque, and move the flanks apart by
///
///     g(p) = t_p' S^-1 (f T + h) - s_p'v         [outside_motion()],
///
/// where h are loads that are the same at every torque, v are displacements of shafts in their bearings that are forced on them, and s_p the supports'
/// forces under t_p. With clearances, and with bearings whose stiffness depends on the load, S is that at the equilibrium under mean forces, the pair's by
/// one normal force at the pitch point at mid face: a bearing whose shaft is pressed against the border, shifted by c in the direction e of its force F,
/// yields by (c/|F|) (1 - e e') beyond its spring, one with a law by its tangent, see tangent_of(), and one that carries nothing is not there.
/// linearised_at() makes these shafts; they are exact at that load and tangent to the truth around it.
///
/// Departures from app. 2C, which has the whole load at mid face, the translation of the axis alone (the section's
/// rotation about axes across its own is left out there) and a moment of the axial force that lies in the plane of action.
class ShaftPair final : public PairCompliance {
 public:
  /// @throws InvalidInput  the first of find_problems()
  ShaftPair(const GearPair& pair, ShaftsOfPair shafts, PerGear<GearBodyIn> body);
  /// The pair's two shafts by themselves.
  ShaftPair(const GearPair& pair, std::optional<ShaftData> pinion, std::optional<ShaftData> wheel, PerGear<GearBodyIn> body)
      : ShaftPair(pair, ShaftsOfPair{{std::move(pinion), std::move(wheel)}, {}}, body) {}
  /// Both gears alike.
  ShaftPair(const GearPair& pair, std::optional<ShaftData> pinion, std::optional<ShaftData> wheel, GearBodyIn body)
      : ShaftPair(pair, std::move(pinion), std::move(wheel), PerGear<GearBodyIn>{body, body}) {}

  /// K of all shafts together [mm/N].
  Eigen::MatrixXd influence(const std::vector<ContactPoint>& points, double axial_offset) const override;
  OutsideMotion outside_motion(const std::vector<ContactPoint>& points, double axial_offset) const override;
  bool depends_on_load() const override { return !nonlinear_.empty(); }
  /// Other meshes change their flanks as well. @pre as with_torques_reversed()
  std::shared_ptr<const PairCompliance> on_other_flanks() const override { return std::make_shared<const ShaftPair>(reversed()); }
  /// The same as what it is. @pre it is not linearised
  ShaftPair reversed() const { return {pair_.on_other_flanks(), with_torques_reversed(given_), body_}; }
  /// @throws InvalidInput  where the equilibrium in the bearings is not found, or leaves a shaft loose
  std::shared_ptr<const PairCompliance> linearised_at(double pinion_torque) const override;
  /// The same as what it is; this one where nothing depends on the load.
  ShaftPair at_torque(double pinion_torque) const;

  /// Motion of one gear's shaft under normal forces at the points and what they bring with them outside; NaN where the gear has none.
  /// @param forces  [N], one a point
  ShaftMotion motion(Member member, const std::vector<ContactPoint>& points, const Eigen::VectorXd& forces, double axial_offset) const;
  /// The same of a change of the forces: without what is there whatever the load.
  ShaftMotion motion_by(Member member, const std::vector<ContactPoint>& points, const Eigen::VectorXd& forces, double axial_offset) const;

  /// Everything in the unit under mean forces, in the axes of the pair as it is given. Of linearised shafts the state that they are made for, whatever the
  /// torque.
  UnitState state(double pinion_torque, double axial_offset = 0.0) const;

  bool has_shaft(Member member) const { return index_[member] >= 0; }
  bool has_unit() const { return !shafts_.unit.empty(); }

 private:
  int parts(Member m) const { return !has_shaft(m) ? 0 : body_[m] == GearBodyIn::Structure ? 3 : 1; }
  int parts() const { return parts(Member::Pinion) + parts(Member::Wheel); }
  /// Wrenches of a unit normal force on one gear, parts() of them.
  void add_loads(Member member, const ContactPoint& point, double axial_offset, std::vector<BeamLoad>& loads) const;
  /// Of unit normal forces, parts() a point.
  std::vector<BeamLoad> loads(const std::vector<ContactPoint>& points, double axial_offset) const;
  std::vector<BeamLoad> loads(Member member, const std::vector<ContactPoint>& points, double axial_offset) const;
  ContactPoint pitch_point(double axial_offset) const;
  double common_face_middle(double axial_offset) const;
  /// Normal force of the mesh per torque on the pinion [1/mm].
  double force_per_torque() const { return 1.0 / (pair_.pinion.base_radius * std::cos(pair_.base_helix_angle)); }
  /// All mean forces per torque on the pinion.
  std::vector<BeamLoad> mean_loads(double axial_offset) const;
  /// What forces that do not change with the torque do to the rows of unit loads [mm].
  Eigen::VectorXd fixed_motion(const std::vector<BeamLoad>& rows, int parts) const;
  ShaftMotion moved(Member member, const std::vector<ContactPoint>& points, const Eigen::VectorXd& forces, double axial_offset, double fixed) const;
  /// Forces of the supports under mean forces [N or N mm].
  Eigen::VectorXd mean_reactions(double pinion_torque, double axial_offset) const;
  /// Where the shafts lie in the bearings that depend on the load.
  ClearanceState bearing_equilibrium(double pinion_torque) const;
  /// The same equilibrium by the forces that the tangents there leave the bearings: one step of Newton's method by forces, without the round-off of displacements.
  ClearanceState refined(ClearanceState found, const ShaftPair& tangent, double pinion_torque) const;
  /// These shafts with each such bearing replaced by its tangent.
  ShaftPair with_tangents(const ClearanceState& found, double pinion_torque) const;
  /// Marks the supports of a shaft's load-dependent bearings as kept. @return whether one was not
  bool keep_bearings_of(int shaft, std::vector<bool>& kept) const;
  void find_drivers(UnitState& state) const;
  void add_meshes(double pinion_torque, double axial_offset, UnitState& state) const;
  void add_bearings(double pinion_torque, double axial_offset, UnitState& state) const;
  void add_shafts(double pinion_torque, double axial_offset, UnitState& state) const;

  GearPair pair_;
  PathOfContact path_;
  PerGear<GearBodyIn> body_;
  ShaftsOfPair given_;
  ShaftsOfPair shafts_;  ///< as the pair is analysed
  PerGear<int> index_{-1, -1};
  UnitSupports supports_;
  std::vector<std::vector<BeamPiece>> pieces_;
  std::optional<BeamSystem> system_;  ///< nothing: all are rigid
  UnitTorques torques_;
  std::vector<BeamLoad> outside_;                     ///< per torque on the pinion
  std::vector<BeamLoad> constant_;                    ///< whatever the torque is
  std::vector<int> nonlinear_;                        ///< indices of bearings that depend on the load, of shafts that are not linearised
  std::vector<NonlinearBearing> nonlinear_bearings_;  ///< these, in the same order
  Eigen::VectorXd prestrain_;                         ///< of linearised shafts: displacements forced on the supports of system_ [mm]; empty: none
  std::optional<UnitState> state_;                    ///< that linearised shafts are made for
};

}  // namespace flankwright
