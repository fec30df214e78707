#include "core/fidelity/edge_approach.hpp"

#include <cmath>

#include "core/contact/gap/flank_touch.hpp"

namespace flankwright {

namespace {

/// The law of a point with its edge where the condition puts it.
ContactLaw moved_law(const MeshPosition& at, const LoadedPosition& loaded, std::size_t point) {
  return at.laws[point].with_edge_moved(edge_moved_by(at.points[point], loaded.gap.touches[point]));
}

/// The deflection under which Hertz's strip, of half width L ~ sqrt(w), reaches the edge.
double deflection_at_edge(const ContactLaw& law) {
  const double distance = law.edge()->distance;
  if (distance <= 0.0) return 0.0;
  const double ratio = distance / law.half_width(1.0);
  return law.deflection(ratio * ratio);
}

}  // namespace

EdgeApproach edge_approach(const MeshPosition& at, const LoadedPosition& loaded, Member gear, std::optional<int> tooth) {
  EdgeApproach found;
  for (std::size_t i = 0; i < at.laws.size(); ++i) {
    if (!at.laws[i].edge() || at.points[i].tip_edge.gear != gear || (tooth && at.points[i].tooth != *tooth)) continue;
    const auto point = static_cast<Eigen::Index>(i);
    const double deflection = loaded.load.contact_deflection[point] - loaded.load.remaining_gap[point];
    if (deflection <= found.approach) continue;  // at_edge is 0 at least
    const double at_edge = deflection_at_edge(moved_law(at, loaded, i));
    if (!(deflection - at_edge <= found.approach)) found = {deflection - at_edge, point, at_edge};
  }
  return found;
}

double edge_pressure_at(const MeshPosition& at, const LoadedPosition& loaded, const EdgeApproach& edge, double approach) {
  if (edge.point < 0 || !(approach > 0.0)) return 0.0;
  const ContactLaw law = moved_law(at, loaded, static_cast<std::size_t>(edge.point));
  return law.peak_pressure(law.line_load(edge.at_edge + approach)).on_edge.pressure;
}

}  // namespace flankwright
