#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/compliance/shaft/bearing_law.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// Torques and forces of one mesh of a unit under mean forces.
struct MeshState {
  std::string name;
  std::array<std::string, 2> shafts;
  std::array<double, 2> torque{not_given, not_given};           ///< on each gear by its shaft, about z [N mm]
  double normal_force{not_given};                               ///< [N], >= 0
  Eigen::Vector3d force{Eigen::Vector3d::Constant(not_given)};  ///< on the second gear [N]
  WorkingFlank first_flank{WorkingFlank::Right};                ///< of the first gear that works
  /// Over the common face by the tilt of its shafts, as ShaftMotion::misalignment [mm]; NaN of a mesh without face width and of the pair under study.
  double misalignment{not_given};
  /// Where it resists tilting, the largest force per face width over the mean by its linear spring [-], >= 1; NaN: it does not. Above 2 one end of the
  /// face is out of contact, and the spring holds the shafts more than the teeth do.
  double face_load_factor{not_given};
  /// Which of its gears drives, 0 or 1, by the torques and the turns that follow from the pair's; -1: no mesh joins it to the pair, or it carries nothing.
  int driver{-1};
};

/// How a bearing whose stiffness depends on its load yields under its radial force F.
struct BearingLawState {
  BearingType type{BearingType::NotGiven};  ///< by whose formula; not given: by its table
  double deflection{not_given};             ///< delta(F), beyond the clearance [mm]
  double secant{not_given};                 ///< F / delta [N/mm]
  /// What the loaded contact has: d F/d delta along the force, and F / (clearance + delta) across it [N/mm].
  double tangent{not_given}, across{not_given};
  bool beyond_table{false};  ///< the force is beyond the end of the table, which goes on along its last piece
};

/// A bearing under mean forces. What has a direction is in the axes of the pair, x, y, z.
struct BearingState {
  std::string name, shaft, outer_shaft;                          ///< outer_shaft empty: on the housing
  double position{not_given};                                    ///< on the shaft [mm]
  Eigen::Vector3d force{Eigen::Vector3d::Constant(not_given)};   ///< on the shaft [N]
  Eigen::Vector2d moment{Eigen::Vector2d::Constant(not_given)};  ///< on the shaft about x and y [N mm]
  double radial_clearance{0.0};                                  ///< as given [mm]
  Eigen::Vector2d shift{Eigen::Vector2d::Zero()};                ///< of the shaft within it [mm]
  bool carries{true};                                            ///< false: the shaft lies within the clearance
  std::optional<BearingLawState> law{};                          ///< nothing: its stiffness is constant
};

/// A shaft under mean forces, at stations along it.
struct ShaftState {
  std::string name;
  Eigen::Vector2d axis{Eigen::Vector2d::Constant(not_given)};  ///< where it lies, from the pinion's [mm]; NaN: nothing says
  double coupling_torque{0.0};                                 ///< that enters at its torque_position, about z [N mm]
  double turning_hold{not_given};                              ///< where it does not turn [mm]
  std::vector<double> z;                                       ///< [mm]
  std::vector<Eigen::Vector3d> displacement;                   ///< of the axis [mm]
  std::vector<Eigen::Vector3d> turn;                           ///< of the section about x and y; about z its twist [rad]
  double residual{not_given};  ///< of its equilibrium, forces over the largest and moments over the largest, the larger [-]
};

/// A unit under the mean forces of one load case: the mesh under study by one normal force at the pitch point at mid face.
struct UnitState {
  double pinion_torque{not_given};  ///< [N mm]
  std::vector<MeshState> meshes;    ///< the pair under study first
  std::vector<BearingState> bearings;
  std::vector<ShaftState> shafts;
  double mesh_misalignment{not_given};  ///< of the pair under study by all shafts: as ShaftMotion::misalignment of both gears [mm]
  /// The part of it that the other forces make [mm].
  double outside_misalignment{not_given};
  bool linear{true};               ///< no bearing has a clearance, or a stiffness that depends on its load
  bool converged{true};            ///< of these: whether their equilibrium was found
  double clearance_residual{0.0};  ///< ClearanceState::residual [-]
  int iterations{0};
};

}  // namespace flankwright
