#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/compliance/finite_element/section_mesh.hpp"
#include "core/compliance/finite_element/section_sweep.hpp"
#include "core/compliance/finite_element/solid_model.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// A gear as its finite-element model sees it: right-hand helix, loaded on the right-hand (clockwise) flanks, z = 0 at
/// mid face, tooth 0 along +y there, teeth counted counter-clockwise. The flank's outward normal then has n_z =
/// +sin(beta_b): the acute end, where flank and face enclose less than a right angle, is z = -b/2. A left hand, or the
/// left-hand flank, is the mirror image.
struct GearToMesh {
  GearData gear;
  double normal_module{not_given};   ///< m_n [mm], > 0
  double pressure_angle{not_given};  ///< alpha_n [rad]
  double helix_angle{not_given};     ///< |beta| [rad], 0 .. 45 deg
  GearBody body;
};

/// Surfaces of one detailed tooth, without the shaft's overhangs.
struct ToothSurfaces {
  std::vector<MeshFace> centre;  ///< centre surface, from the tip to the bore
  std::vector<MeshFace> flank;   ///< loaded flank, tip to start of fillet
  std::vector<MeshFace> fillet;  ///< fillet below it, to its lowest point
};

/// A brick of the rim, and the detailed tooth that it lies below within half a pitch, -n .. n.
struct RimBrick {
  int brick{-1};
  std::optional<int> tooth{};
};

/// The section swept along z (SectionSweep), each part over its own width, and the shaft's overhangs, held at their far ends: that beyond the
/// torque end whole, the other one radially. The compliance of the axial support is axial_hold_compliance(). A bore that is held is so all
/// over, a rigid body everywhere.
struct GearMesh {
  ToothForm form;
  int teeth{0};
  double normal_module{not_given}, face_width{not_given};
  int teeth_each_side{0};
  double shaft_diameter{not_given};  ///< [mm]; NaN without a shaft
  bool rigid_body{false};            ///< GearBody::rigid
  bool rigid_bore{false};            ///< BodyHold::RigidBore: nothing below has a shaft
  double torque_end{not_given};      ///< z of the face end where torque and axial force leave, -b/2 or b/2 [mm]
  SolidMesh solid{};
  std::vector<NodeSupport> supports{};
  std::vector<double> planes{};                  ///< z of the layers' ends on the face width, ascending [mm]
  std::vector<std::vector<int>> shaft_bricks{};  ///< that reach through every layer between them; local z runs along the axis
  std::vector<ToothSurfaces> tooth_surfaces{};   ///< of teeth -n .. n
  /// Bricks between root circle and underside of a rim on a web, with the pitch that they lie in, right below a detailed tooth; empty: a solid disc.
  std::vector<RimBrick> rim{};

  const ToothSurfaces& surfaces(int tooth) const { return tooth_surfaces.at(tooth + teeth_each_side); }
  FaceNodes face_nodes(const MeshFace& face) const;
};

/// @throws InvalidInput  as ToothForm and section_mesh(), "face_width", and "options" where an element comes out folded
GearMesh gear_mesh(const GearToMesh& gear, const GearMeshOptions& options = {});

}  // namespace flankwright
