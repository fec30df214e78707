#include "core/load/cycle/contact_stress.hpp"

#include <cmath>

namespace flankwright {

std::vector<ContactLaw> laws_with_moved_edges(const MeshPosition& at, const TipEdgeShift& shift, const Eigen::VectorXd& most) {
  std::vector<ContactLaw> laws;
  for (std::size_t i = 0; i < at.laws.size(); ++i) {
    const ContactLaw& law = at.laws[i];
    const ContactPoint& point = at.points[i];
    const double load = most[static_cast<Eigen::Index>(i)];
    if (!law.edge() || !(load > 0.0)) continue;
    const double reach = law.half_width(load) + TipEdgeShift::steepest * point.relative_radius;
    if (law.edge()->distance >= reach) continue;
    if (laws.empty()) laws = at.laws;
    laws[i] = law.with_edge_moved(shift.at(point));
  }
  return laws;
}

std::vector<ContactLaw> laws_with_moved_edges(const MeshModel& model, const MeshPosition& at, const FlankCondition& condition,
                                              const Eigen::VectorXd& most) {
  return has_rounded_tips(model.pair) ? laws_with_moved_edges(at, TipEdgeShift(model.pair, condition), most) : std::vector<ContactLaw>();
}

std::optional<ContactLaw> contact_law_in(const MeshModel& model, const ContactPoint& point, const FlankCondition& condition) {
  const std::optional<ContactLaw> law = model.contact_law(point);
  if (!law || !law->edge()) return law;
  return law->with_edge_moved(TipEdgeShift(model.pair, condition).at(point));
}

StripContact::Peaks contact_stress(const MeshModel& model, const ContactPoint& point, const ContactLaw* law, double line_load) {
  if (law != nullptr && law->edge()) return law->peak_pressure(line_load);
  if (line_load <= 0.0) return {};
  const double stress = std::sqrt(line_load * model.contact_modulus / (units::pi * point.relative_radius));
  return {{stress, stress / (2.0 * line_load), 0.0}, {}, {}};
}

namespace {

/// Raises the stress of point i to that between it and a neighbour on its line.
void climb(const MeshModel& model, const MeshPosition& at, const RoundedEdge& edge, const Eigen::VectorXd& line_load, Eigen::Index i,
           Eigen::Index neighbour, PointStress& stress) {
  const ContactPoint &here = at.points[static_cast<std::size_t>(i)], &there = at.points[static_cast<std::size_t>(neighbour)];
  if (there.tooth != here.tooth || there.tip_edge.gear != here.tip_edge.gear || !(there.tip_edge.radius > 0.0)) return;
  const double further = there.tip_edge.distance - here.tip_edge.distance;
  for (const double share : {0.25, 0.5}) {
    const double load = (1.0 - share) * line_load[i] + share * line_load[neighbour];
    const double radius = (1.0 - share) * here.relative_radius + share * there.relative_radius;
    const StripContact strip({edge.radius, edge.distance + share * further}, radius, model.contact_modulus, load);
    const StripContact::Peak crest = strip.crest();
    if (!(crest.pressure > stress.on_edge.peak.pressure)) return;  // it falls that way
    stress.on_edge = {crest, neighbour, share};
    if (crest.pressure > stress.highest.peak.pressure) stress.highest = stress.on_edge;
  }
}

}  // namespace

std::vector<PointStress> contact_stresses(const MeshModel& model, const MeshPosition& at, const std::vector<ContactLaw>& laws,
                                          const Eigen::VectorXd& line_load) {
  const std::size_t n = at.points.size();
  std::vector<PointStress> stresses(n);
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < n; ++i) {
    const StripContact::Peaks peaks = contact_stress(model, at.points[i], laws.empty() ? nullptr : &laws[i], line_load[static_cast<Eigen::Index>(i)]);
    stresses[i] = {{peaks.highest}, {peaks.on_edge}, peaks.edge_load};
    if (peaks.on_edge.pressure > 0.0) reached.push_back(i);
  }
  const std::vector<PointStress> of_points = reached.empty() ? std::vector<PointStress>() : stresses;
  const auto own = [&](std::size_t i) { return of_points[i].on_edge.peak.pressure; };
  for (const std::size_t i : reached) {
    const auto less = [&](std::size_t neighbour) {
      return neighbour >= n || at.points[neighbour].tooth != at.points[i].tooth || own(neighbour) <= own(i);
    };
    if (!less(i - 1) || !less(i + 1)) continue;
    for (const std::size_t neighbour : {i - 1, i + 1}) {
      if (neighbour >= n) continue;
      climb(model, at, *laws[i].edge(), line_load, static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(neighbour), stresses[i]);
    }
  }
  return stresses;
}

}  // namespace flankwright
