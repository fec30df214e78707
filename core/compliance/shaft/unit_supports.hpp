#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/compliance/shaft/beam_system.hpp"
#include "core/compliance/shaft/unit_data.hpp"

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
  Eigen::MatrixXd housing;            ///< compliance that the housing adds to the supports [mm/N]; empty: rigid
};

/// @param shafts  as the pair is analysed, see mirrored(); bearings on shafts that are there
UnitSupports make_supports(const ShaftsOfPair& shafts);

/// What a loose motion lacks, and of which shaft: "it can move along its axis: a bearing with axial_stiffness".
std::string restraint_in_words(const LooseMotion& loose);

}  // namespace flankwright
