#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/compliance/contact_law.hpp"
#include "core/compliance/pair_compliance.hpp"
#include "core/compliance/pair_root_stress.hpp"
#include "core/contact/contact_points.hpp"
#include "core/contact/path_of_contact.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright {

/// Physical effects of the loaded mesh that may be left out.
struct MeshEffects {
  bool bending{true};                  ///< structural compliance of teeth and gear bodies
  bool adjacent_teeth{true};           ///< a load on one tooth moves the others (thin slices do not know of it)
  bool hertzian_contact{true};         ///< local contact deflection
  bool tip_corner{true};               ///< Steward's factor M near the tips
  bool extended_contact_region{true};  ///< tip edges before A and after E
};

/// How finely a mesh cycle is resolved.
struct MeshResolution {
  Quadrature quadrature;
  /// Phases of the reference tooth pair's line [base pitches]; see equally_spaced_phases().
  std::vector<double> phases;
};

/// n phases of the reference pair over one base pitch, from 0 (its leading end enters at A0): 0, 1/n, ...
std::vector<double> equally_spaced_phases(int n);

/// What does not change while modifications, misalignment and torque vary: points, influence and contact laws per position.
struct MeshPosition {
  double phase{not_given};
  std::vector<ContactPoint> points;
  Eigen::VectorXd weight;
  Eigen::MatrixXd influence;
  std::vector<ContactLaw> laws;
  RootStressInfluence root_stress{};  ///< no places: not asked for
};

struct MeshModel {
  GearPair pair;
  Material pinion_material, wheel_material;
  MeshEffects effects;
  double axial_offset{0.0};      ///< of the wheel, which shortens the common face [mm]
  double face_width{not_given};  ///< in contact [mm]
  double contact_modulus{not_given};  ///< E' [MPa]
  double calibration{not_given};      ///< kappa of the thin slice
  IsoStiffness iso;
  std::vector<MeshPosition> positions;

  /// Force normal to the flanks for a torque on the pinion [N]; torque in N mm.
  double normal_force(double pinion_torque) const;
  /// Force over the mean length of the contact lines on the theoretical path [N/mm].
  double mean_line_load(double force) const;
};

/// Builds points, influence matrix and contact laws at every phase.
/// @param structure    what yields structurally; null: thin slices
/// @param root_stress  null: none
/// @throws InvalidInput where bending and Hertzian contact are both off (nothing would yield), no phase is given, or the gears do
///         not overlap axially
MeshModel make_mesh_model(const GearPair& pair, const Material& pinion_material, const Material& wheel_material,
                          const MeshResolution& resolution, const MeshEffects& effects = {}, double axial_offset = 0.0,
                          const PairCompliance* structure = nullptr, const PairRootStress* root_stress = nullptr);

}  // namespace flankwright
