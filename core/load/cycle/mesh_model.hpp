#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/for_each_index.hpp"
#include "core/contact/gap/mesh_placement.hpp"
#include "core/contact/gap/misalignment_gap.hpp"
#include "core/contact/path/path_of_contact.hpp"
#include "core/effects/mesh_effects.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright {

class ConditionGap;
struct Gap;

/// The resolution of a mesh cycle.
struct MeshResolution {
  Quadrature quadrature;
  /// Phases of the reference tooth pair's line [base pitches]; see equally_spaced_phases().
  std::vector<double> phases;
};

/// n phases of the reference pair over one base pitch, from 0 (its leading end enters at A0): 0, 1/n, ...
std::vector<double> equally_spaced_phases(int n);

/// Where a contact line ends at a face end of the common width. There the line load may rise up to the very end, beyond the last point of the
/// quadrature.
struct FaceEndOfLine {
  Eigen::Index point{-1};   ///< of the line, the nearest
  Eigen::Index inwards{0};  ///< from a point to the next one away from the end, 1 or -1
  ContactPoint place{};     ///< the end as a point, without a weight
  ContactLaw law;
};

/// What does not change while modifications, torque and, with GapModel::PlaneOfAction, misalignment vary: points, influence and
/// contact laws per position.
///
/// With GapModel::WholeSurface points lie where the flanks of the misaligned, unmodified pair are nearest
/// (SurfaceGap::place), and stay there while modifications change: the gap is that of the modified flanks at their own
/// nearest points, while curvature, depths and influence are kept. A modification moves the point along the profile by
/// D'/kappa, with D' the slope of D over the arc and kappa the relative curvature. Curvature, depths and influence are
/// therefore wrong by first order in the slope of a modification, as in the plane of action; the gap and its
/// derivatives are exact.
struct MeshPosition {
  double phase{not_given};
  std::vector<ContactPoint> points;
  Eigen::VectorXd weight;
  Eigen::MatrixXd influence;
  std::vector<ContactLaw> laws;
  RootStressInfluence root_stress{};       ///< no points: not asked for
  std::vector<FaceEndOfLine> face_ends{};  ///< none without Hertzian contact
  OutsideMotion outside{};                 ///< what other forces than the mesh's own open between the points
  double shaft_compliance{0.0};  ///< what shafts yield in the mean of all points, under equal forces at all of them that are 1 N together [mm/N]
  Eigen::VectorXd
      even_load_compliance{};  ///< part of the laws' compliance that K takes back on its diagonal, see ContactCouplingEffect [mm^2/N]; empty: none
};

struct MeshModel;

/// The same mesh perturbed by one and two steps of a parameter that moves it, see MeshSlopes.
struct PerturbedMeshes {
  MisalignmentParameter parameter;
  double step;  ///< [mm or rad]
  std::vector<MeshModel> meshes;
};

struct MeshModel {
  GearPair pair;  ///< on the flanks that touch
  PerGear<Material> material;
  MeshEffects effects;
  MeshPlacement placement;
  double axial_offset{0.0};           ///< of the wheel, which shortens the common face [mm]
  double face_width{not_given};       ///< in contact [mm]
  double contact_modulus{not_given};  ///< E' [MPa]
  double calibration{not_given};      ///< kappa of the thin slice
  IsoStiffness iso;
  HalfSpaceCorrections half_space{};  ///< of the structure
  bool couples_points{true};          ///< of the structure, PairCompliance::couples_points()
  std::vector<MeshPosition> positions;
  std::vector<PerturbedMeshes> perturbed{};  ///< for each parameter of the derivatives that moves the mesh

  /// Force normal to the flanks for a torque on the pinion [N]; torque in N mm.
  double normal_force(double pinion_torque) const;
  /// Force over the mean length of the contact lines between A and E over a base pitch, eps_alpha b / cos(beta_b) [N/mm].
  double mean_line_load(double force) const;
  /// A point of tooth pair `tooth`'s line, where the effects put it; nothing where no contact can be.
  std::optional<ContactPoint> place(const PathOfContact& path, double phase, int tooth, double z) const;
  /// The local contact law at a point; nothing where that is left out.
  std::optional<ContactLaw> contact_law(const ContactPoint& point) const;
  /// The common face, z [mm].
  double face_start() const { return std::max(pair.pinion.face.begin, axial_offset + pair.wheel.face.begin); }
  double face_end() const { return face_start() + face_width; }
};

/// The placement of a load case's mesh. The torque is part of it where the shafts depend on the load.
/// @param shafts         null: rigid
/// @param pinion_torque  [N mm]
MeshPlacement placement_of(GapModel gap, const FlankCondition& condition, const PairCompliance* shafts, double pinion_torque);

/// The gap of a position's points in a condition, with what other forces than the mesh's own open, in proportion to the force.
/// @param force  normal force of the mesh [N]
Gap gap_under(const MeshPosition& at, const ConditionGap& gaps, double force);

/// What yields under the loads of a mesh.
struct MeshCompliance {
  const PairCompliance* structure{nullptr};    ///< null: thin slices
  const PairRootStress* root_stress{nullptr};  ///< null: none
  const PairCompliance* shafts{
      nullptr};  ///< added to the structure, coupling all points; null: rigid; linearised at the placement's torque where they depend on the load
};

/// Builds points, influence matrix and contact laws at every phase: asks the effects, stage by stage.
/// @param effects      the effects that are on
/// @param placement    as MeshPlacement::of() makes it
/// @param for_each     makes the positions, which do not hang on each other; nothing: one after the other
/// @throws InvalidInput where no effect makes the points compliant, no phase is given, the gears do not overlap
///                       axially, or structure, root stress or shafts do not know the other flanks that the placement asks for
MeshModel make_mesh_model(const GearPair& pair, const PerGear<Material>& material, const MeshResolution& resolution, const MeshEffects& effects = {},
                          const MeshPlacement& placement = {}, const MeshCompliance& compliance = {}, const ForEachIndex& for_each = {});

/// The same gears with other effects or another placement: data of gears and materials alone are taken from the model,
/// the rest is built as by make_mesh_model().
/// @param compliance     its structure is not null
/// @throws InvalidInput  as make_mesh_model()
MeshModel mesh_with_effects(MeshModel model, const MeshResolution& resolution, const MeshEffects& effects, const MeshPlacement& placement,
                            const MeshCompliance& compliance, const ForEachIndex& for_each = {});

}  // namespace flankwright
