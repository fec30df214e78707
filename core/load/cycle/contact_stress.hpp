#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/contact/gap/gap.hpp"
#include "core/load/cycle/mesh_model.hpp"

namespace flankwright {

inline bool has_rounded_tips(const GearPair& pair) { return pair.pinion.tip_edge_radius > 0.0 || pair.wheel.tip_edge_radius > 0.0; }

/// The contact laws of a position in a condition: deviations move tip edges, see TipEdgeShift. Edges that no load within these bounds reaches stay
/// where they are; empty where all do: then the laws of the position hold.
/// @param most  bounds of the line loads of all points [N/mm]
std::vector<ContactLaw> laws_with_moved_edges(const MeshPosition& at, const TipEdgeShift& shift, const Eigen::VectorXd& most);
/// The same of one position alone.
std::vector<ContactLaw> laws_with_moved_edges(const MeshModel& model, const MeshPosition& at, const FlankCondition& condition,
                                              const Eigen::VectorXd& most);

/// MeshModel::contact_law() in a condition.
std::optional<ContactLaw> contact_law_in(const MeshModel& model, const ContactPoint& point, const FlankCondition& condition);

/// The largest contact pressure at a point, Hertz's sqrt(w E'/(pi R)) or that of a strip on an edge, that on the edge and the load there. All 0
/// without load.
/// @param law  null: Hertzian contact is left out, and with it any edge
StripContact::Peaks contact_stress(const MeshModel& model, const ContactPoint& point, const ContactLaw* law, double line_load);

/// A largest pressure on the part of a line that belongs to a point: at the point, or a share of the way to the next one.
struct StressPlace {
  StripContact::Peak peak{};
  Eigen::Index neighbour{-1};  ///< the next point; -1: at the point itself
  double share{0.0};           ///< of the way there, 0 .. 1/2

  /// Of values per point, one row each.
  template <typename Rows>
  Eigen::RowVectorXd interpolated(const Rows& values, Eigen::Index point) const {
    if (neighbour < 0) return values.row(point);
    return (1.0 - share) * values.row(point) + share * values.row(neighbour);
  }
};

/// Contact stress of one point.
struct PointStress {
  StressPlace highest, on_edge;
  StripContact::EdgeLoad edge_load{};
};

/// Contact stress of every point of a position.
///
/// Where a line runs onto a tip edge its pressure has a crest that is shorter than the distance of the points. Around a point that has more than
/// its neighbours the strip is therefore solved at a quarter and half of the way to both neighbours as well, with load, relative radius and the edge's distance in
/// between linear; the edge is moved as at the point.
/// @param laws  of the points, moved by a condition; empty: Hertzian contact is left out
std::vector<PointStress> contact_stresses(const MeshModel& model, const MeshPosition& at, const std::vector<ContactLaw>& laws,
                                          const Eigen::VectorXd& line_load);

}  // namespace flankwright
