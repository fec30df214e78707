#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/compliance/shaft/shaft_data.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// Names of the shafts that carry the gears of the pair under study.
inline constexpr std::array<const char*, 2> pair_shafts{"pinion", "wheel"};

/// One gear of a mesh beside the pair under study.
struct UnitGear {
  std::string shaft;           ///< the one that it sits on: "pinion", "wheel", or the name of a further one
  double position{not_given};  ///< of its mid face on the shaft [mm]
  int teeth{0};                ///< >= 5
  double face_width{0.0};      ///< over which the shaft is as thick as the gear's root (bending: mean of tip and root) [mm], >= 0; 0: nowhere
};

/// A mesh beside the pair under study, which loads its shafts with mean forces and, with a stiffness, holds both shafts against tilting towards each
/// other. External involute gears on parallel axes.
struct UnitMesh {
  std::string name;
  std::array<UnitGear, 2> gears;
  double normal_module{not_given};         ///< m_n [mm], > 0
  double pressure_angle{20 * units::deg};  ///< alpha_n, normal section [rad]
  double helix_angle{0.0};                 ///< |beta| at the reference cylinder [rad], >= 0
  Hand hand{Hand::Right};                  ///< of the first gear, the second one's is the opposite
  double centre_distance{not_given};       ///< a_w [mm]; not given: of the reference circles
  /// Where the second gear's axis lies, seen from that of the first: turned from x, the direction from pinion to wheel, towards y [rad].
  double angle{not_given};
  /// Torque on the first gear by its shaft, about z, at the unit's reference torque [N mm]; not given: what the balance of the shafts leaves.
  double torque{not_given};
  /// Per face width, c_gamma of ISO 6336-1, along the transverse base tangent [N/mm^2], > 0; not given: the force stays at mid face whatever tilts.
  double stiffness{not_given};

  /// Of the face that both gears have in common, mid face by mid face [mm].
  double face_width() const { return std::min(gears[0].face_width, gears[1].face_width); }
  bool resists_tilting() const { return stiffness > 0.0; }
};

/// What follows from a mesh's data [ISO 21771].
struct MeshGeometry {
  std::array<double, 2> reference_radius, base_radius, working_radius;  ///< of both gears [mm]
  double centre_distance;                                               ///< a_w [mm]
  double working_pressure_angle, base_helix_angle;                      ///< alpha_wt, |beta_b| [rad]
};
/// @pre the mesh has no problem that find_problems() names
MeshGeometry geometry_of(const UnitMesh& mesh);

/// A force and a moment from outside on a shaft, at the unit's reference torque and in proportion to the torque, or whatever the torque is.
struct UnitLoad {
  std::string shaft;
  double position{not_given};                       ///< [mm]
  Eigen::Vector3d force{Eigen::Vector3d::Zero()};   ///< [N], axes of the pair
  Eigen::Vector3d moment{Eigen::Vector3d::Zero()};  ///< [N mm]; z is torque
  bool constant{false};                             ///< the same at every torque, as a weight or the pull of a belt; it has no torque then

  /// Whether it keeps its direction when the torque turns round, or is a torque itself: false of a force or a moment across the shaft in proportion to the torque.
  bool keeps_direction() const { return constant || (force.isZero(0.0) && moment.head<2>().isZero(0.0)); }
};

/// A bearing between two shafts on one axis.
struct ShaftJoint {
  std::string outer_shaft, shaft;
  double outer_position{not_given};  ///< on the outer shaft [mm]
  ShaftBearing bearing{};            ///< its position is that on `shaft`
};

/// The housing: how far the seats of bearings move under the forces of all of them.
struct Housing {
  std::vector<std::string> seats;  ///< names of bearings; those not named sit in a rigid housing
  Eigen::MatrixXd stiffness;       ///< between the seats' displacements x, y, z of each [N/mm], symmetric, positive definite; empty: rigid
};

/// A gear unit around the pair under study: the shafts that do not carry the pair's gears, the meshes, loads and bearings beside those of the
/// pair's two shafts. Without any of them the pair's two shafts stand by themselves.
struct UnitData {
  std::vector<ShaftData> shafts;  ///< further ones, each with its name
  std::vector<UnitMesh> meshes;
  std::vector<UnitLoad> loads;
  std::vector<ShaftJoint> joints;
  Housing housing;
  /// On the pinion, at which loads and given torques are meant [N mm], > 0; all of them but constant loads scale with the torque.
  double reference_torque{not_given};

  bool empty() const { return shafts.empty() && meshes.empty() && loads.empty() && joints.empty() && housing.seats.empty(); }
};

/// The pair's two shafts, and the unit around them.
struct ShaftsOfPair {
  PerGear<std::optional<ShaftData>> shaft{};  ///< of the pair's gears; nothing: rigid
  UnitData unit{};

  bool any() const { return shaft.pinion || shaft.wheel || !unit.shafts.empty(); }
  /// All shafts: the pinion's, the wheel's, then the further ones; those that are rigid have no entry.
  std::vector<const ShaftData*> all() const;
  /// Their names, in the same order.
  std::vector<std::string> names() const;
  /// Index of a shaft in all(); nothing where there is none of that name.
  std::optional<int> find(const std::string& name) const;
  std::optional<int> find(Member member) const { return find(name_of(member)); }
  /// How messages name a shaft's table: "pinion.shaft", "unit.shafts.0".
  std::string table(int shaft) const;
  bool depends_on_load() const;
};

/// Where the shafts' axes are, x and y from that of the pinion [mm], by the meshes and joints between them; NaN of those that nothing joins.
std::vector<Eigen::Vector2d> axes_of(const ShaftsOfPair& shafts, const GearPair& pair);

/// The same with all torques the other way round: what the other flanks of the pair carry.
/// @pre UnitLoad::keeps_direction() of all loads
ShaftsOfPair with_torques_reversed(ShaftsOfPair shafts);

/// The same shafts and unit seen in a mirror, the plane y = 0: as a pair that works on its left flanks is analysed.
ShaftsOfPair mirrored(ShaftsOfPair shafts);

}  // namespace flankwright
