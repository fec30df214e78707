#include "core/compliance/comparison/finite_element_deflections.hpp"

#include <algorithm>

#include "core/compliance/tooth/tooth_places.hpp"

namespace flankwright {

std::vector<FlankPoint> flank_points(const GearMesh& mesh, std::span<const FlankPlace> places) {
  std::vector<FlankPoint> points;
  for (const FlankPlace& place : places) {
    require_on_flank(place, mesh.face_width / mesh.normal_module);
    const double z = place.zeta * mesh.normal_module - mesh.face_width / 2;
    points.push_back({place.tooth, flank_radius(mesh.form, place.u), std::min(z, mesh.face_width / 2)});
  }
  return points;
}

Eigen::MatrixXd finite_element_deflections(const InfluenceModel& model, std::span<const FlankPlace> places,
                                           std::span<const FlankPlace> loads, RemovedMotion removed) {
  const GearMesh& mesh = model.mesh();
  std::vector<FlankPlace> all(places.begin(), places.end());
  all.insert(all.end(), loads.begin(), loads.end());
  const double scale = model.material().youngs_modulus * mesh.normal_module;
  return scale * model.influence(flank_points(mesh, all), removed).compliance.topRightCorner(std::ssize(places), std::ssize(loads));
}

}  // namespace flankwright
