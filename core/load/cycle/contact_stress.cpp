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

}  // namespace flankwright
