#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/gear/gear_data.hpp"

namespace flankwright {

/// The part of the gear that an element of the section belongs to. Where no tooth is detailed the plain ring counts as
/// body, as adjacent teeth and the rim do.
enum class SectionPart { LoadedTooth, Body, Web, HoledWeb, Hub, Shaft };
inline constexpr int section_parts = 6;

/// An edge of a quad: corner, mid-side, corner.
using SectionEdge = std::array<int, 3>;

/// Lines of one detailed tooth in the section.
struct SectionTooth {
  std::vector<SectionEdge> centre_line;  ///< tip to bore
  std::vector<SectionEdge> flank;        ///< right-hand involute, tip to start of fillet
  std::vector<SectionEdge> fillet;       ///< right-hand fillet, down to its lowest point
};

/// A mid-side node where two elements of a ring meet one that is as long as both: it follows that one's edge.
struct SectionTie {
  int node{-1};
  SectionEdge edge{};  ///< of the long element; its mid-side is the corner that the two share
  double along{0};     ///< -1 at the edge's first corner, 1 at its last
  SectionPart part{};  ///< of the long element
};

/// Transverse section of a gear at z = 0 in quadratic 8-node quads, origin in the axis, tooth 0 along +y. Corners run
/// counter-clockwise, mid-sides 1-2, 2-3, 3-4, 4-1. All nodes of flanks and fillets lie exactly on them.
struct SectionMesh {
  double root_radius{not_given};  ///< [mm]
  Eigen::Matrix2Xd nodes;         ///< [mm]
  Eigen::Matrix<int, 8, Eigen::Dynamic> quads;
  std::vector<SectionPart> parts;   ///< of every quad
  std::vector<SectionTooth> teeth;  ///< -n .. n, counter-clockwise
  std::vector<SectionTie> ties;     ///< ring by ring, inwards
};

}  // namespace flankwright
