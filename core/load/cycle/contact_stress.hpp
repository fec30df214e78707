#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "core/contact/gap/gap.hpp"
#include "core/load/cycle/line_crest.hpp"
#include "core/load/cycle/mesh_model.hpp"

namespace flankwright {

/// The contact laws of a position in a condition: deviations move the contact against tip edges, see edge_moved_by(). Edges that no load within these
/// bounds reaches stay where they are; empty where all do: then the laws of the position hold.
/// @param most  bounds of the line loads of all points [N/mm]
std::vector<ContactLaw> laws_with_moved_edges(const MeshPosition& at, const Gap& gap, const Eigen::VectorXd& most);

/// MeshModel::contact_law() in a condition.
std::optional<ContactLaw> contact_law_in(const MeshModel& model, const ContactPoint& point, const FlankCondition& condition);

/// The largest contact pressure at a point, Hertz's sqrt(w E'/(pi R)) or that of a strip on an edge, that on the edge and the load there. All 0
/// without load.
/// @param law  null: Hertzian contact is left out, and with it any edge
StripContact::Peaks contact_stress(const MeshModel& model, const ContactPoint& point, const ContactLaw* law, double line_load);

/// Derivatives by parameters of what a position's contact follows from.
struct PlaceSlopes {
  const Eigen::MatrixXd& load;  ///< of the points' line loads, a row each
  const Eigen::MatrixXd& edge;  ///< of the distances of their edges; no rows: no edge is reached
  const CrestSlopes& crests;    ///< of all crests of the position
};

/// A largest value on the part of a line that belongs to a point, and the points that it follows from.
struct PlaceValue {
  struct Point {
    Eigen::Index index{-1};
    double by_load{0.0};  ///< derivative of the value by its line load
    double by_edge{0.0};  ///< and by the distance of its edge
  };
  /// A value on a crest of the position follows from the deflection there, and from where the crest is.
  struct Crest {
    Eigen::Index index{-1};  ///< -1: on none
    double by_deflection{0.0};
    Eigen::MatrixXd CrestSlopes::*motion{nullptr};  ///< what the motion of the place adds to the value
  };
  double value{0.0};
  std::array<Point, 3> points{};
  std::size_t count{0};  ///< of these
  Crest crest{};

  void add(const Point& point) { points[count++] = point; }
  Eigen::RowVectorXd derivative(const PlaceSlopes& slopes) const;
};

/// The largest contact stress of a point, that on its edge [MPa], and the largest line load [N/mm].
struct PointPeaks {
  PlaceValue stress, on_edge, load;
  StripContact::EdgeLoad edge_load{};
};

/// Contact stress and line load of every point of a position; 0 without load.
///
/// Where a line runs onto a tip edge its pressure has a crest that is shorter than the distance of the points. Around a point that has more than
/// its neighbours the strip is therefore solved at a quarter and half of the way to both neighbours as well, with load, relative radius and the edge's distance in
/// between linear; the edge is moved as at the point.
///
/// Where the line load rises towards a face end it goes on rising beyond the last point, most where the mate's flank overhangs and holds up the
/// load's end. The contact deflection, what gap and structure leave of the approach, is smooth: it is continued to the end by a parabola through
/// the last three points in contact (a straight line through two), and the contact law at the end gives the load there.
///
/// Between points a line has crests, see line_crests().
/// @param laws    of the points, moved by a condition; empty: Hertzian contact is left out
/// @param crests  of the position in that condition
std::vector<PointPeaks> point_peaks(const MeshModel& model, const MeshPosition& at, const std::vector<ContactLaw>& laws,
                                    const Eigen::VectorXd& line_load, const std::vector<LineCrest>& crests);

}  // namespace flankwright
