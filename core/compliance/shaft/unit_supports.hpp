#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/compliance/shaft/beam_system.hpp"
#include "core/compliance/shaft/unit_data.hpp"
#include "core/compliance/shaft/unit_statics.hpp"

namespace flankwright {

/// A bearing of the unit, on the housing or on another shaft.
struct UnitBearing {
  std::string name;
  int shaft{-1};
  int outer_shaft{-1};               ///< -1: the housing
  double outer_position{not_given};  ///< [mm]
  ShaftBearing data;
  /// Indices of its supports: across x and y, along, tilting about x and y; -1: none.
  std::array<int, 5> supports{-1, -1, -1, -1, -1};
};

/// The bearings as supports of beams.
struct UnitSupports {
  std::vector<UnitBearing> bearings;
  std::vector<BeamSupport> supports;  ///< of the bearings, and one a shaft that holds it against turning
  std::vector<int> turning;           ///< of each shaft the index of that; -1: none
  std::vector<int> tilting;           ///< of each mesh beside the pair the index of its hold against tilting; -1: none
  /// Compliance beyond the supports' own, of the housing and of bearings with a matrix, where these are rigid [mm, rad per N, N mm]; empty: none.
  Eigen::MatrixXd further;
};

/// @param shafts  as the pair is analysed, see mirrored(); bearings on shafts that are there
UnitSupports make_supports(const ShaftsOfPair& shafts);

/// The same with meshes that resist tilting: teeth of stiffness c along the common face b hold both shafts by a moment of c b^3/12 per rad of their
/// tilt in the base tangent plane. The force along the face is q(z) = F/b + c (tilt) z, and at its sum, F, the balance of the shafts' torques
/// holds it. Linear: also where q would be below 0 at one end, see MeshState::face_load_factor.
/// @param torques  of the meshes; one without load holds nothing
UnitSupports make_supports(const ShaftsOfPair& shafts, const UnitTorques& torques);

/// What a loose motion lacks, and of which shaft: "it can move along its axis: a bearing with axial_stiffness".
std::string restraint_in_words(const LooseMotion& loose);

}  // namespace flankwright
