#include "core/load/cycle/contact_stress.hpp"

#include <cmath>
#include <span>
#include <utility>

#include "core/base/smooth_interpolation.hpp"
#include "core/contact/gap/flank_touch_search.hpp"

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

Eigen::RowVectorXd PlaceValue::derivative(const PlaceSlopes& slopes) const {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(slopes.load.cols());
  for (std::size_t k = 0; k < count; ++k) {
    const auto& [index, by_load, by_edge] = points[k];
    sum += by_load * slopes.load.row(index);
    if (by_edge != 0.0 && slopes.edge.size() > 0) sum += by_edge * slopes.edge.row(index);
  }
  if (crest.index >= 0) sum += crest.by_deflection * slopes.crests.deflection.row(crest.index) + (slopes.crests.*crest.motion).row(crest.index);
  return sum;
}

namespace {

PlaceValue at_point(const StripContact::Peak& peak, Eigen::Index point) {
  PlaceValue place{peak.pressure};
  place.add({point, peak.slope, peak.by_edge});
  return place;
}

/// Raises the stress of point i to that between it and a neighbour on its line.
void climb(const MeshModel& model, const MeshPosition& at, const RoundedEdge& edge, const Eigen::VectorXd& line_load, Eigen::Index i,
           Eigen::Index neighbour, PointPeaks& peaks) {
  const ContactPoint &here = at.points[static_cast<std::size_t>(i)], &there = at.points[static_cast<std::size_t>(neighbour)];
  if (there.tooth != here.tooth || there.tip_edge.gear != here.tip_edge.gear || !(there.tip_edge.radius > 0.0)) return;
  const double further = there.tip_edge.distance - here.tip_edge.distance;
  for (const double share : {0.25, 0.5}) {
    const double load = (1.0 - share) * line_load[i] + share * line_load[neighbour];
    const double radius = (1.0 - share) * here.relative_radius + share * there.relative_radius;
    const StripContact strip({edge.radius, edge.distance + share * further}, radius, model.contact_modulus, load);
    const StripContact::Peak crest = strip.crest();
    if (!(crest.pressure > peaks.on_edge.value)) return;  // it falls that way
    peaks.on_edge = at_point({crest.pressure, (1.0 - share) * crest.slope, crest.by_edge}, i);
    peaks.on_edge.add({neighbour, share * crest.slope});
    if (crest.pressure > peaks.stress.value) peaks.stress = peaks.on_edge;
  }
}

/// A value that follows from the deflection at a place: multiplies the derivatives of that deflection.
PlaceValue following(PlaceValue deflection, double value, double by_deflection) {
  deflection.value = value;
  for (std::size_t k = 0; k < deflection.count; ++k) {
    deflection.points[k].by_load *= by_deflection;
    deflection.points[k].by_edge *= by_deflection;
  }
  return deflection;
}

/// Raises stress and load of the last point of a line to those at its end on a face.
void rise_to_face_end(const MeshModel& model, const MeshPosition& at, const FaceEndOfLine& end, const std::vector<ContactLaw>& laws,
                      const Eigen::VectorXd& line_load, PointPeaks& peaks) {
  const Eigen::Index last = end.point;
  if (!(line_load[last] > line_load[last + end.inwards] && line_load[last + end.inwards] > 0.0)) return;
  std::array<double, 3> z{};
  std::size_t count = 0;
  for (Eigen::Index i = last; count < z.size(); i += end.inwards) {
    const bool on_line = i >= 0 && i < line_load.size() && at.points[static_cast<std::size_t>(i)].tooth == end.place.tooth;
    if (!on_line || !(line_load[i] > 0.0)) break;
    z[count++] = at.points[static_cast<std::size_t>(i)].z;
  }
  const std::array<double, 3> weights = continued(std::span(z).first(count), end.place.z);
  PlaceValue deflection;
  for (std::size_t k = 0; k < count; ++k) {
    const Eigen::Index i = last + static_cast<Eigen::Index>(k) * end.inwards;
    const ContactLaw& law = laws[static_cast<std::size_t>(i)];
    const ContactLaw::Response response = law.evaluate(line_load[i]);
    deflection.value += weights[k] * response.deflection;
    deflection.add({i, weights[k] * response.slope, weights[k] * law.edge_slope(line_load[i])});
  }
  const auto k = static_cast<std::size_t>(last);
  const double moved = laws[k].edge() && at.laws[k].edge() ? laws[k].edge()->distance - at.laws[k].edge()->distance : 0.0;
  const ContactLaw law = end.law.with_edge_moved(moved);
  const double load = law.line_load(deflection.value);
  // dw = (du - dc at w held)/c', u the deflection that is continued
  const double by_deflection = 1.0 / law.slope(load), by_edge = -by_deflection * law.edge_slope(load);
  if (load > peaks.load.value) {
    peaks.load = following(deflection, load, by_deflection);
    peaks.load.points[0].by_edge += by_edge;
  }
  const auto raise = [&](const StripContact::Peak& peak, PlaceValue& value) {
    if (!(peak.pressure > value.value)) return;
    value = following(deflection, peak.pressure, peak.slope * by_deflection);
    value.points[0].by_edge += peak.by_edge + peak.slope * by_edge;
  };
  const StripContact::Peaks at_end = contact_stress(model, end.place, &law, load);
  raise(at_end.highest, peaks.stress);
  raise(at_end.on_edge, peaks.on_edge);
}

/// Raises stress and load of the higher of both points beside a crest to those on it.
void rise_to_crest(const std::vector<ContactLaw>& laws, const std::vector<LineCrest>& crests, std::size_t number, const Eigen::VectorXd& line_load,
                   std::vector<PointPeaks>& peaks) {
  const LineCrest& crest = crests[number];
  const CrestLoad found = load_on_crest(laws, crest);
  const Eigen::Index higher = line_load[crest.before] >= line_load[crest.before + 1] ? crest.before : crest.before + 1;
  PointPeaks& of = peaks[static_cast<std::size_t>(higher)];
  const auto place = static_cast<Eigen::Index>(number);
  if (found.line_load > of.load.value) of.load = {.value = found.line_load, .crest = {place, found.load_by_deflection, &CrestSlopes::load}};
  if (found.pressure > of.stress.value) of.stress = {.value = found.pressure, .crest = {place, found.by_deflection, &CrestSlopes::pressure}};
}

}  // namespace

std::vector<PointPeaks> point_peaks(const MeshModel& model, const MeshPosition& at, const std::vector<ContactLaw>& laws,
                                    const Eigen::VectorXd& line_load, const std::vector<LineCrest>& crests) {
  const std::size_t n = at.points.size();
  std::vector<PointPeaks> peaks(n);
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (!(line_load[row] > 0.0)) continue;
    const StripContact::Peaks own = contact_stress(model, at.points[i], laws.empty() ? nullptr : &laws[i], line_load[row]);
    peaks[i] = {at_point(own.highest, row), at_point(own.on_edge, row), at_point({line_load[row], 1.0, 0.0}, row), own.edge_load};
    if (own.on_edge.pressure > 0.0) reached.push_back(i);
  }
  std::vector<double> on_edge(n);
  for (std::size_t i = 0; i < n; ++i) on_edge[i] = peaks[i].on_edge.value;
  for (const std::size_t i : reached) {
    const auto less = [&](std::size_t neighbour) {
      return neighbour >= n || at.points[neighbour].tooth != at.points[i].tooth || on_edge[neighbour] <= on_edge[i];
    };
    if (!less(i - 1) || !less(i + 1)) continue;
    for (const std::size_t neighbour : {i - 1, i + 1}) {
      if (neighbour >= n) continue;
      climb(model, at, *laws[i].edge(), line_load, static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(neighbour), peaks[i]);
    }
  }
  if (laws.empty()) return peaks;
  for (const FaceEndOfLine& end : at.face_ends) rise_to_face_end(model, at, end, laws, line_load, peaks[static_cast<std::size_t>(end.point)]);
  for (std::size_t k = 0; k < crests.size(); ++k) rise_to_crest(laws, crests, k, line_load, peaks);
  return peaks;
}

}  // namespace flankwright
