#include "core/load/cycle/contact_stress.hpp"

#include <algorithm>
#include <cmath>

namespace flankwright {

std::vector<ContactLaw> laws_with_moved_edges(const MeshModel& model, const MeshPosition& at, const FlankCondition& condition) {
  if (std::ranges::none_of(at.laws, [](const ContactLaw& law) { return law.edge().has_value(); })) return {};
  const Eigen::VectorXd shift = tip_edge_shift(model.pair, at.points, condition);
  std::vector<ContactLaw> laws;
  laws.reserve(at.laws.size());
  for (std::size_t i = 0; i < at.laws.size(); ++i) laws.push_back(at.laws[i].with_edge_moved(shift[static_cast<Eigen::Index>(i)]));
  return laws;
}

std::optional<ContactLaw> contact_law_in(const MeshModel& model, const ContactPoint& point, const FlankCondition& condition) {
  const std::optional<ContactLaw> law = model.contact_law(point);
  if (!law || !law->edge()) return law;
  return law->with_edge_moved(tip_edge_shift(model.pair, {point}, condition)[0]);
}

StripContact::Peaks contact_stress(const MeshModel& model, const ContactPoint& point, const ContactLaw* law, double line_load) {
  if (law != nullptr && law->edge()) return law->peak_pressure(line_load);
  if (line_load <= 0.0) return {};
  const double stress = std::sqrt(line_load * model.contact_modulus / (units::pi * point.relative_radius));
  return {{stress, stress / (2.0 * line_load), 0.0}, {}, {}};
}

}  // namespace flankwright
