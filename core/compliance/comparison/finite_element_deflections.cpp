#include "core/compliance/comparison/finite_element_deflections.hpp"

#include <algorithm>

#include "core/compliance/tooth/flank_stations.hpp"

namespace flankwright {

std::vector<FlankPoint> flank_points(const GearMesh& mesh, std::span<const FlankStation> stations) {
  std::vector<FlankPoint> points;
  for (const FlankStation& station : stations) {
    require_on_flank(station, mesh.face_width / mesh.normal_module);
    const double z = station.zeta * mesh.normal_module - mesh.face_width / 2;
    points.push_back({station.tooth, flank_radius(mesh.form, station.u), std::min(z, mesh.face_width / 2)});
  }
  return points;
}

Eigen::MatrixXd finite_element_deflections(const InfluenceModel& model, std::span<const FlankStation> stations, std::span<const FlankStation> loads,
                                           RemovedRigidMotion removed) {
  const GearMesh& mesh = model.mesh();
  std::vector<FlankStation> all(stations.begin(), stations.end());
  all.insert(all.end(), loads.begin(), loads.end());
  const double scale = model.material().youngs_modulus * mesh.normal_module;
  return scale * model.influence(flank_points(mesh, all), removed).compliance.topRightCorner(std::ssize(stations), std::ssize(loads));
}

}  // namespace flankwright
