#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "core/compliance/finite_element/section_mesh.hpp"
#include "core/compliance/finite_element/solid_model.hpp"

namespace flankwright {

/// An 8-node face of the mesh: four corners, then the mid-sides between them.
using MeshFace = std::array<int, 8>;

/// Layers that an element reaches through, by the numbers of the planes at its ends.
struct LayerSpan {
  int lower{0}, upper{0};
  auto operator<=>(const LayerSpan&) const = default;
};

/// Planes across the axis, ascending [mm]; those from number `first` to `last` lie on the face width.
struct SweepPlanes {
  std::vector<double> z;
  int first{0}, last{0};
  /// The planes that every part lies between; none of a part that the section does not have.
  std::array<LayerSpan, section_parts> parts{};
  std::vector<int> kept{};  ///< planes on the face width that no layers are joined across, ascending: where a part begins or ends

  const LayerSpan& of(SectionPart part) const { return parts[static_cast<std::size_t>(part)]; }
  LayerSpan& of(SectionPart part) { return parts[static_cast<std::size_t>(part)]; }
  bool has(SectionPart part, int layer) const { return layer >= of(part).lower && layer < of(part).upper; }
};

/// A section swept along the axis with the helix, in layers between planes. On the face width layers are joined by
/// twos, fours, ..., counted from both face ends to mid face, where GearMeshOptions::layer_share allows. Where a quad
/// with short elements meets one with long ones, the nodes of the short ones in between are tied to those of the long
/// one: they follow its quadratic displacement on the common face, which keeps the displacement continuous. Two
/// elements side by side that meet one are joined likewise (SectionTie).
class SectionSweep {
 public:
  /// @param twist  turn of the section per length, on the face width [rad/mm]
  SectionSweep(const SectionMesh& section, const SweepPlanes& planes, double twist, double layer_share);

  /// Layers that the quad's, or the edge's, element through a layer takes; of two quads at an edge that with the longer ones.
  LayerSpan span_of_quad(Eigen::Index quad, int layer) const { return span(quad_levels_[static_cast<std::size_t>(quad)], layer); }
  LayerSpan span_of_edge(const SectionEdge& edge, int layer) const { return span(node_level(edge[1], layer), layer); }
  /// Whether a quad's element, or one at an edge, reaches through a layer.
  bool has_quad(Eigen::Index quad, int layer) const { return planes_.has(section_.parts[static_cast<std::size_t>(quad)], layer); }
  bool has_edge(const SectionEdge& edge, int layer) const;

  /// Makes a brick; its number.
  int brick(Eigen::Index quad, LayerSpan span);
  MeshFace face(const SectionEdge& edge, LayerSpan span);
  /// Nodes made so far on a plane.
  std::vector<int> on_plane(int plane) const;
  /// The nodes and bricks made, with the ties; call once, at the end.
  SolidMesh take();

 private:
  LayerSpan span(int level, int layer) const;
  /// Highest level of the quads around a node that reach through a layer.
  int node_level(int section_node, int layer) const {
    return node_levels_[planes_.kept.empty() ? 0 : zone_of_[static_cast<std::size_t>(layer)]][static_cast<std::size_t>(section_node)];
  }
  double height(LayerSpan span) const { return (planes_.z[span.lower] + planes_.z[span.upper]) / 2; }
  int node(int section_node, LayerSpan span);
  void set_levels(double layer_share);
  double length_scale(Eigen::Index quad) const;
  void shorten_at_ties();
  void set_node_levels(int layer);
  bool tie_acts(const SectionTie& tie, LayerSpan span) const;
  void tie(int section_node, const SectionEdge* side, const SectionTie* joint);

  const SectionMesh& section_;
  const SweepPlanes& planes_;
  double twist_;
  std::vector<std::vector<int>> ends_;  ///< of every level (2^level layers are joined): numbers of the planes between its joined layers
  std::vector<int> quad_levels_;
  std::vector<std::size_t> zone_of_;               ///< of every plane: the zone of the layer above it; empty without kept planes
  std::vector<std::vector<int>> node_levels_;      ///< in every zone, through which the same parts reach
  std::map<int, std::vector<SectionPart>> sides_;  ///< parts on both sides of an edge, by its mid-side; empty without kept planes
  std::vector<std::map<LayerSpan, int>> numbers_;  ///< of the nodes above every section node
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<int, 20>> bricks_;
  std::vector<TiedNode> ties_;
  std::vector<int> tie_of_;  ///< for every node the number of its tie, or -1
};

}  // namespace flankwright
