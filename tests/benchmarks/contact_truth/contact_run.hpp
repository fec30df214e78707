#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/contact/assembly/flank_condition.hpp"
#include "tests/benchmarks/contact_truth/contact_mesh.hpp"

namespace flankwright::contact_truth {

/// One position of a pair in three-dimensional contact. Both gears are rigid at their bores; the wheel's is held, the
/// pinion's turned.
struct ContactTask {
  PairData pair;                             ///< the pinion drives its right flanks
  FlankCondition condition{};                ///< modifications, and misalignment, which places the wheel
  double phase{not_given};                   ///< line phase of tooth pair 0 [base pitches], see PathOfContact
  double approach{not_given};                ///< turn of the pinion from where undisturbed flanks touch, times r_b1 cos(beta_b) [mm]
  PerGear<double> bore_radius{};             ///< [mm]
  bool half_face{false};                     ///< see ContactGear
  bool plane_strain{false};                  ///< no node moves along the axis (spur gears)
  Material material{};                       ///< of both gears
  PerGear<std::optional<WebbedBody>> web{};  ///< with hub diameter and width; empty: solid discs
};

/// One gear of a task, with the tooth pairs first .. last meshed for contact.
/// @param pair, flank  of the task; they have to outlive the result, as the task has
ContactGear contact_gear(const ContactTask& task, const GearPair& pair, const Flank& flank, Member member, int first, int last);

/// How CalculiX is to solve it.
struct ContactSettings {
  ContactMeshOptions mesh{};
  double penalty{2e7};             ///< pressure over penetration [MPa/mm]; 1500 MPa sink in by 0.08 um
  bool reduced_integration{true};  ///< C3D20R in place of C3D20
  bool fillets{false};             ///< whether displacements of the fillets are printed
};

/// What one layer of a tooth pair carries.
struct LayerLoad {
  int tooth;                ///< tooth pair
  double begin, end;        ///< z [mm]
  double force;             ///< [N]
  double peak_compression;  ///< largest pressure along a principal direction in the pinion's outermost elements [MPa]
};

/// An element's face on the fillet below a loaded flank, or on the half of the root land next to it.
struct FilletFace {
  int tooth;  ///< tooth pair
  /// In the housing's frame [mm]: four corners, then the sides' middles, as face_shape() counts them; the first local axis runs down the fillet, the second
  /// along +z.
  Eigen::Matrix<double, 3, 8> nodes, displacements;
};

struct ContactAnswer {
  bool converged{false};
  Eigen::Index unknowns{0};  ///< three per node
  double processor_seconds{not_given}, peak_bytes{not_given};
  double pinion_torque{not_given}, wheel_torque{not_given};  ///< reactions of the bores on the whole face [N mm], > 0
  std::vector<LayerLoad> layers;                             ///< by tooth pair and rising z, z <= 0 only of half a face
  /// Translation and rotation about the gear's own axis at mid face, in the housing's frame, of the rigid motion that fits a rim on a web best over its
  /// volume [mm, rad]; NaN: a solid disc.
  PerGear<Eigen::Vector<double, 6>> rim{Eigen::Vector<double, 6>::Constant(not_given), Eigen::Vector<double, 6>::Constant(not_given)};

  PerGear<std::vector<FilletFace>> fillets;  ///< by tooth pair, layer by layer of rising z, downwards; empty unless ContactSettings::fillets

  double force() const;             ///< of all layers [N]
  double share(int tooth) const;    ///< of the force [-]
  double peak_compression() const;  ///< [MPa]
  double peak_compression(int tooth) const;
};

/// Whether CalculiX (ccx, Debian package calculix-ccx) can be called.
bool calculix_is_installed();

/// Writes the deck into a folder that is made, runs CalculiX on one thread, reads what it prints. Frictionless contact
/// of surfaces by penalty, small displacements, one increment unless CalculiX halves it. Forces are CalculiX' sums over each layer. Stress is that
/// in the integration points next to the flank: the pressures that CalculiX prints for its contact points do not add up
/// to the force.
ContactAnswer run_calculix(const ContactTask& task, const ContactSettings& settings, const std::filesystem::path& folder);

}  // namespace flankwright::contact_truth
