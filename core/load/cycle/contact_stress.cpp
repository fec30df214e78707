#include "core/load/cycle/contact_stress.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

std::vector<ContactLaw> laws_with_moved_edges(const MeshPosition& at, const Gap& gap, const Eigen::VectorXd& most) {
  std::vector<ContactLaw> laws;
  for (std::size_t i = 0; i < at.laws.size(); ++i) {
    const ContactLaw& law = at.laws[i];
    const double load = most[static_cast<Eigen::Index>(i)];
    if (!law.edge() || !(load > 0.0)) continue;
    const double further = edge_moved_by(at.points[i], gap.touches[i]);
    if (further == 0.0 || law.edge()->distance + std::min(0.0, further) >= law.half_width(load)) continue;
    if (laws.empty()) laws = at.laws;
    laws[i] = law.with_edge_moved(further);
  }
  return laws;
}

std::optional<ContactLaw> contact_law_in(const MeshModel& model, const ContactPoint& point, const FlankCondition& condition) {
  const std::optional<ContactLaw> law = model.contact_law(point);
  if (!law || !law->edge()) return law;
  return law->with_edge_moved(edge_moved_by(point, FlankTouchSearch(model.pair, condition, model.placement.misalignment).at(point)));
}

StripContact::Peaks contact_stress(const MeshModel& model, const ContactPoint& point, const ContactLaw* law, double line_load) {
  if (law != nullptr && law->edge()) return law->peak_pressure(line_load);
  if (line_load <= 0.0) return {};
  const double stress = std::sqrt(line_load * model.contact_modulus / (units::pi * point.relative_radius));
  return {{stress, stress / (2.0 * line_load), 0.0}, {}, {}};
}

Eigen::RowVectorXd StressPlace::derivative(const Eigen::MatrixXd& load, const Eigen::MatrixXd& edge) const {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(load.cols());
  for (std::size_t k = 0; k < count; ++k) {
    sum += points[k].by_load * load.row(points[k].index);
    if (edge.size() > 0) sum += points[k].by_edge * edge.row(points[k].index);
  }
  return sum;
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
    if (!(crest.pressure > stress.on_edge.pressure)) return;  // it falls that way
    stress.on_edge = {{crest.pressure, (1.0 - share) * crest.slope, crest.by_edge}, i};
    stress.on_edge.add({neighbour, share * crest.slope, 0.0});
    if (crest.pressure > stress.highest.pressure) stress.highest = stress.on_edge;
  }
}

/// Weights that continue values at `count` places z to another place: by the parabola through three, the straight line through two.
std::array<double, 3> continued(const std::array<double, 3>& z, std::size_t count, double there) {
  std::array<double, 3> weights{};
  for (std::size_t k = 0; k < count; ++k) {
    weights[k] = 1.0;
    for (std::size_t m = 0; m < count; ++m) {
      if (m != k) weights[k] *= (there - z[m]) / (z[k] - z[m]);
    }
  }
  return weights;
}

/// Raises the stress of the last point of a line to that at its end on a face.
void rise_to_face_end(const MeshModel& model, const MeshPosition& at, const FaceEndOfLine& end, const std::vector<ContactLaw>& laws,
                      const Eigen::VectorXd& line_load, PointStress& stress) {
  const Eigen::Index last = end.point;
  if (!(line_load[last] > line_load[last + end.inwards] && line_load[last + end.inwards] > 0.0)) return;
  std::array<double, 3> z{};
  std::size_t count = 0;
  for (Eigen::Index i = last; count < z.size(); i += end.inwards) {
    const bool on_line = i >= 0 && i < line_load.size() && at.points[static_cast<std::size_t>(i)].tooth == end.place.tooth;
    if (!on_line || !(line_load[i] > 0.0)) break;
    z[count++] = at.points[static_cast<std::size_t>(i)].z;
  }
  const std::array<double, 3> weights = continued(z, count, end.place.z);
  double deflection = 0.0;
  StressPlace place;
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Index i = last + static_cast<Eigen::Index>(k) * end.inwards;
    const ContactLaw& law = laws[static_cast<std::size_t>(i)];
    const ContactLaw::Response response = law.evaluate(line_load[i]);
    deflection += weights[k] * response.deflection;
    place.add({i, weights[k] * response.slope, weights[k] * law.edge_slope(line_load[i])});
  }
  const auto k = static_cast<std::size_t>(last);
  const double moved = laws[k].edge() && at.laws[k].edge() ? laws[k].edge()->distance - at.laws[k].edge()->distance : 0.0;
  const ContactLaw law = end.law.with_edge_moved(moved);
  const double load = law.line_load(deflection);
  const StripContact::Peak peak = contact_stress(model, end.place, &law, load).highest;
  if (!(peak.pressure > stress.highest.pressure)) return;
  // dw = (du - dc at w held)/c', u the deflection that is continued
  const double by_deflection = peak.slope / law.slope(load);
  place.pressure = peak.pressure;
  for (std::size_t j = 0; j < count; ++j) {
    place.points[j].by_load *= by_deflection;
    place.points[j].by_edge *= by_deflection;
  }
  place.points[0].by_edge += peak.by_edge - by_deflection * law.edge_slope(load);
  stress.highest = place;
}

}  // namespace

std::vector<PointStress> contact_stresses(const MeshModel& model, const MeshPosition& at, const std::vector<ContactLaw>& laws,
                                          const Eigen::VectorXd& line_load) {
  const std::size_t n = at.points.size();
  std::vector<PointStress> stresses(n);
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const StripContact::Peaks peaks = contact_stress(model, at.points[i], laws.empty() ? nullptr : &laws[i], line_load[row]);
    stresses[i] = {{peaks.highest, row}, {peaks.on_edge, row}, peaks.edge_load};
    if (peaks.on_edge.pressure > 0.0) reached.push_back(i);
  }
  const std::vector<PointStress> of_points = reached.empty() ? std::vector<PointStress>() : stresses;
  const auto own = [&](std::size_t i) { return of_points[i].on_edge.pressure; };
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
  if (laws.empty()) return stresses;
  for (const FaceEndOfLine& end : at.face_ends) rise_to_face_end(model, at, end, laws, line_load, stresses[static_cast<std::size_t>(end.point)]);
  return stresses;
}

}  // namespace flankwright
