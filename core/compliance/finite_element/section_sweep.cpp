#include "core/compliance/finite_element/section_sweep.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <ranges>

namespace flankwright {
namespace {

/// Numbers of the planes that remain where 2^level layers are joined, from both ends of the face width to mid face; next to the
/// ends 1, 1, 2, 4, ... Those of a level are among those of the level below.
std::vector<int> joined_ends(const SweepPlanes& planes, int level) {
  std::vector<int> ends;
  const int half = (planes.last - planes.first) / 2, step = 1 << level;
  for (int plane = 0; plane < static_cast<int>(planes.z.size()); ++plane) {
    const int from_end = std::min(plane - planes.first, planes.last - plane);  // less than 0 beyond the face width
    const bool near_end = from_end < step && (from_end < 0 || std::has_single_bit(static_cast<unsigned>(from_end)));
    const bool kept = std::ranges::binary_search(planes.kept, plane);
    if (near_end || from_end % step == 0 || from_end == half || kept) ends.push_back(plane);
  }
  return ends;
}

}  // namespace

SectionSweep::SectionSweep(const SectionMesh& section, const SweepPlanes& planes, double twist, double layer_share)
    : section_(section), planes_(planes), twist_(twist), numbers_(static_cast<std::size_t>(section.nodes.cols())) {
  for (int level = 0; level == 0 || 1 << level < planes.last - planes.first; ++level) ends_.push_back(joined_ends(planes, level));
  set_levels(layer_share);
}

/// The length to which GearMeshOptions::layer_share refers.
double SectionSweep::length_scale(Eigen::Index quad) const {
  double side = 0, innermost = INFINITY, outermost = 0;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d corner = section_.nodes.col(section_.quads(i, quad)), next = section_.nodes.col(section_.quads((i + 1) % 4, quad));
    side = std::max(side, (corner - next).norm());
    innermost = std::min(innermost, corner.norm());
    outermost = std::max(outermost, corner.norm());
  }
  return std::max(side, std::min(section_.root_radius - outermost, innermost));
}

void SectionSweep::set_levels(double layer_share) {
  std::vector<double> longest;  // joined layer of every level
  for (const std::vector<int>& ends : ends_) {
    longest.push_back(0);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const bool on_face = ends[i] >= planes_.first && ends[i + 1] <= planes_.last;
      if (on_face) longest.back() = std::max(longest.back(), planes_.z[ends[i + 1]] - planes_.z[ends[i]]);
    }
  }
  for (Eigen::Index quad = 0; quad < section_.quads.cols(); ++quad) {
    int level = 0;
    if (section_.parts[static_cast<std::size_t>(quad)] != SectionPart::LoadedTooth) {
      const double most = layer_share * length_scale(quad);
      while (level + 1 < static_cast<int>(longest.size()) && longest[static_cast<std::size_t>(level) + 1] <= most) ++level;
    }
    quad_levels_.push_back(level);
  }
  shorten_at_ties();
  if (planes_.kept.empty()) {
    set_node_levels(planes_.first);
    return;
  }
  for (Eigen::Index quad = 0; quad < section_.quads.cols(); ++quad) {
    for (int i = 4; i < 8; ++i) sides_[section_.quads(i, quad)].push_back(section_.parts[static_cast<std::size_t>(quad)]);
  }
  const auto parts_in = [&](int layer) {
    std::array<bool, section_parts> there{};
    for (int part = 0; part < section_parts; ++part) there[static_cast<std::size_t>(part)] = planes_.has(static_cast<SectionPart>(part), layer);
    return there;
  };
  std::map<std::array<bool, section_parts>, std::size_t> zones;
  for (int layer = 0; layer < static_cast<int>(planes_.z.size()); ++layer) {
    const auto [zone, is_new] = zones.try_emplace(parts_in(layer), zones.size());
    zone_of_.push_back(zone->second);
    if (is_new) set_node_levels(layer);
  }
}

/// Adds the levels of a zone.
/// @param layer  any of the zone
void SectionSweep::set_node_levels(int layer) {
  const bool all = planes_.kept.empty();
  std::vector<int>& levels = node_levels_.emplace_back(static_cast<std::size_t>(section_.nodes.cols()), 0);
  for (Eigen::Index quad = 0; quad < section_.quads.cols(); ++quad) {
    if (!all && !has_quad(quad, layer)) continue;
    for (int i = 0; i < 8; ++i) {
      int& of_node = levels[static_cast<std::size_t>(section_.quads(i, quad))];
      of_node = std::max(of_node, quad_levels_[static_cast<std::size_t>(quad)]);
    }
  }
  for (const SectionTie& tie : section_.ties) {
    if (all || planes_.has(tie.part, layer)) levels[static_cast<std::size_t>(tie.node)] = levels[static_cast<std::size_t>(tie.edge[1])];
  }
}

bool SectionSweep::has_edge(const SectionEdge& edge, int layer) const {
  if (planes_.kept.empty()) return true;
  return std::ranges::any_of(sides_.at(edge[1]), [&](SectionPart part) { return planes_.has(part, layer); });
}

/// Whether the long element of a tie is there for a node between, or on, two planes.
bool SectionSweep::tie_acts(const SectionTie& tie, LayerSpan span) const {
  if (planes_.kept.empty()) return true;
  return planes_.has(tie.part, span.lower) || (span.lower == span.upper && planes_.has(tie.part, span.lower - 1));
}

/// An element tied to another must not be longer along the axis. Ties run inwards, so that those of the inner ring come
/// first here.
void SectionSweep::shorten_at_ties() {
  std::map<int, std::size_t> by_side;  // the quad that has a mid-side; of those at a long element's edge the long one, which alone has it
  for (Eigen::Index quad = 0; quad < section_.quads.cols(); ++quad) {
    for (int i = 4; i < 8; ++i) by_side[section_.quads(i, quad)] = static_cast<std::size_t>(quad);
  }
  for (const SectionTie& tie : section_.ties | std::views::reverse) {
    int& level = quad_levels_[by_side.at(tie.node)];
    level = std::min(level, quad_levels_[by_side.at(tie.edge[1])]);
  }
}

LayerSpan SectionSweep::span(int level, int layer) const {
  const std::vector<int>& ends = ends_[static_cast<std::size_t>(level)];
  const auto above = std::upper_bound(ends.begin(), ends.end(), layer);
  return {*(above - 1), above == ends.end() ? *(above - 1) : *above};
}

int SectionSweep::node(int section_node, LayerSpan span) {
  const auto [entry, is_new] = numbers_[static_cast<std::size_t>(section_node)].try_emplace(span, static_cast<int>(points_.size()));
  if (is_new) {
    const double z = height(span), turn = twist_ * std::clamp(z, planes_.z[planes_.first], planes_.z[planes_.last]);
    const Eigen::Vector2d p = section_.nodes.col(section_node);
    points_.push_back({p.x() * std::cos(turn) - p.y() * std::sin(turn), p.x() * std::sin(turn) + p.y() * std::cos(turn), z});
  }
  return entry->second;
}

int SectionSweep::brick(Eigen::Index quad, LayerSpan span) {
  const LayerSpan lower{span.lower, span.lower}, upper{span.upper, span.upper};
  std::array<int, 20> brick;
  for (int i = 0; i < 4; ++i) {
    const int corner = section_.quads(i, quad), side = section_.quads(i + 4, quad);
    brick[i] = node(corner, lower);
    brick[i + 4] = node(corner, upper);
    brick[i + 8] = node(side, lower);
    brick[i + 12] = node(side, upper);
    brick[i + 16] = node(corner, span);
  }
  bricks_.push_back(brick);
  return static_cast<int>(bricks_.size()) - 1;
}

MeshFace SectionSweep::face(const SectionEdge& edge, LayerSpan span) {
  const LayerSpan lower{span.lower, span.lower}, upper{span.upper, span.upper};
  return {node(edge[0], lower), node(edge[2], lower), node(edge[2], upper), node(edge[0], upper),
          node(edge[1], lower), node(edge[2], span),  node(edge[1], upper), node(edge[0], span)};
}

std::vector<int> SectionSweep::on_plane(int plane) const {
  std::vector<int> nodes;
  for (const auto& numbers : numbers_) {
    const auto found = numbers.find({plane, plane});
    if (found != numbers.end()) nodes.push_back(found->second);
  }
  return nodes;
}

/// @param side   the edge that the node is the middle of; null: none
/// @param joint  the tie of a mid-side that two elements side by side have beside one long element; null: another node
void SectionSweep::tie(int section_node, const SectionEdge* side, const SectionTie* joint) {
  const double along = joint ? joint->along : 0;
  const std::map<LayerSpan, int> made = numbers_[static_cast<std::size_t>(section_node)];
  for (const auto& [span, number] : made) {
    if (joint && !tie_acts(*joint, span)) continue;
    const SectionEdge* edge = joint ? &joint->edge : side && has_edge(*side, span.lower) ? side : nullptr;
    const LayerSpan around = this->span(node_level(section_node, span.lower), span.lower);
    const bool on_end = span.lower == span.upper && around.lower == span.lower;
    const bool free = edge ? on_end && along == 0 : on_end || span == around;
    if (free) continue;
    const double lower = planes_.z[around.lower], upper = planes_.z[around.upper];
    const double eta = (2 * height(span) - lower - upper) / (upper - lower);

    // A corner's node follows the long element's edge, a mid-side's node its face.
    std::map<int, double> follows;
    const auto add = [&](int node, double weight) {
      if (weight == 0) return;
      if (tie_of_[static_cast<std::size_t>(node)] < 0) {
        follows[node] += weight;
      } else {
        const TiedNode& tied = ties_[static_cast<std::size_t>(tie_of_[static_cast<std::size_t>(node)])];
        for (const auto& [other, share] : tied.follows) follows[other] += weight * share;
      }
    };
    if (edge && on_end) {
      add(node((*edge)[0], span), along * (along - 1) / 2);
      add(node((*edge)[1], span), 1 - along * along);
      add(node((*edge)[2], span), along * (along + 1) / 2);
    } else if (edge) {
      const MeshFace face = this->face(*edge, around);
      const FaceShape shape = face_shape(along, eta);
      for (int i = 0; i < 8; ++i) add(face[static_cast<std::size_t>(i)], shape.values[i]);
    } else {
      add(node(section_node, {around.lower, around.lower}), eta * (eta - 1) / 2);
      add(node(section_node, around), 1 - eta * eta);
      add(node(section_node, {around.upper, around.upper}), eta * (eta + 1) / 2);
    }
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (const auto& [other, weight] : follows) point += weight * points_[static_cast<std::size_t>(other)];
    points_[static_cast<std::size_t>(number)] = point;
    tie_of_[static_cast<std::size_t>(number)] = static_cast<int>(ties_.size());
    ties_.push_back({number, {follows.begin(), follows.end()}});
  }
}

SolidMesh SectionSweep::take() {
  tie_of_.assign(points_.size(), -1);
  std::map<int, SectionEdge> sides;  // by their middle
  std::vector<char> is_corner(numbers_.size(), 0);
  for (Eigen::Index quad = 0; quad < section_.quads.cols(); ++quad) {
    for (int i = 0; i < 4; ++i) {
      const int corner = section_.quads(i, quad), side = section_.quads(i + 4, quad);
      is_corner[static_cast<std::size_t>(corner)] = 1;
      sides.try_emplace(side, SectionEdge{corner, side, section_.quads((i + 1) % 4, quad)});
    }
  }
  // Corners' first: mid-sides follow what these follow. Corners on a long element's edge come after those that the edge ends in.
  const int count = static_cast<int>(numbers_.size());
  for (const SectionTie& tied : section_.ties) sides.erase(tied.node);
  for (int i = 0; i < count; ++i) {
    if (is_corner[static_cast<std::size_t>(i)] && !sides.contains(i)) tie(i, nullptr, nullptr);
  }
  for (const bool corners : {true, false}) {
    for (const auto& [middle, edge] : sides) {
      if ((is_corner[static_cast<std::size_t>(middle)] != 0) == corners) tie(middle, &edge, nullptr);
    }
  }
  for (const SectionTie& tied : section_.ties) tie(tied.node, &tied.edge, &tied);

  SolidMesh mesh;
  mesh.nodes.resize(3, static_cast<Eigen::Index>(points_.size()));
  for (std::size_t i = 0; i < points_.size(); ++i) mesh.nodes.col(static_cast<Eigen::Index>(i)) = points_[i];
  mesh.bricks.resize(20, static_cast<Eigen::Index>(bricks_.size()));
  for (std::size_t i = 0; i < bricks_.size(); ++i) {
    for (int k = 0; k < 20; ++k) mesh.bricks(k, static_cast<Eigen::Index>(i)) = bricks_[i][static_cast<std::size_t>(k)];
  }
  mesh.tied = std::move(ties_);
  return mesh;
}

}  // namespace flankwright
