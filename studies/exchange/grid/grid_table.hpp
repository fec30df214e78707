#pragma once

#include <string>

#include "core/gear/gear_pair.hpp"
#include "core/flank/modifications/modification.hpp"

namespace flankwright::studies {

/// Points of a measurement grid on a flank, even in radius and along the face.
struct GridLayout {
  int profile_points{9};  ///< 2 .. 500
  int face_points{15};    ///< 2 .. 500
  /// Share of the active flank's extent (start of active profile to tip, face width) that is left out at each of its borders, 0 .. 0.4:
  /// probes measure no edges.
  double margin{0.0};

  /// Throws InvalidInput with field, value and violated bound.
  void validate() const;
};

/// "9x15" as profile and face points. @throws InvalidInput ("--grid-points") where it is anything else
GridLayout grid_layout(const std::string& points, double margin);

/// A flank as points of a grid.
struct GridTable {
  std::string text;  ///< as grid_file.hpp reads it, normal to the flank, + = metal added, with comments that say what it is
  /// Of the surface through the points from the flank, at most, normal to it [mm]: a relief that starts between two lines is rounded.
  double departure{0.0};
  std::string unreadable{};  ///< why a study cannot read it as modification.grid, without a departure then; empty: it can
};

/// The flank as generated and modified, without errors, against its involute.
GridTable grid_table(const GearPair& pair, Member member, const Modification& modification, const GridLayout& layout, const std::string& title);

}  // namespace flankwright::studies
