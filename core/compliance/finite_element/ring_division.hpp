#pragma once

#include <vector>

namespace flankwright {

/// Elements side by side around the axis, in one ring of a section.
struct RingDivision {
  /// Angles of the corners (even indices) and mid-sides (odd ones) of n elements, 2 n of them, ascending over one turn
  /// [rad]. Element i reaches from angles[2 i] to angles[2 i + 2], the last one to the first corner's next turn.
  std::vector<double> angles;

  int elements() const { return static_cast<int>(angles.size()) / 2; }
  /// Angle at any index, also beyond the ends of the list, with the turns in between [rad].
  double angle(int index) const;
};

/// A ring with fewer elements, and where the one outside it has two for one.
struct JoinedRing {
  RingDivision division;
  /// Indices into the outer ring's angles: corners that have become mid-sides.
  std::vector<int> joints;
};

/// Joins neighbours of a ring by twos: alike on both sides of angle 0, starting there.
/// @param longest  angle that a joined element may have, round-off aside [rad]
/// @param kept     angles of corners that stay corners [rad]
JoinedRing join_neighbours(const RingDivision& outer, double longest, const std::vector<double>& kept);

}  // namespace flankwright
