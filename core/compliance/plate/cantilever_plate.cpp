#include "core/compliance/plate/cantilever_plate.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "core/compliance/tooth/flank_stations.hpp"

namespace flankwright {
namespace {

/// Polynomials over the height, and along the trace a few and so many per module. With half as many again no K(p, q)
/// changes by more than 0.5 % of the root of K(p, p) K(q, q) (18 and 100 teeth, faces of 2 to 12 modules).
constexpr int kUp = 7;
constexpr int kAlong = 12;
constexpr double kAlongPerModule = 2.5;

/// Height of the load's source above the centre surface, of the depth of that surface below the flank.
constexpr double kSourceHeight = 0.5;

}  // namespace

EdgeCompliance tooth_foundation(double root_thickness, double poissons_ratio) {
  const double nu = poissons_ratio, plane_strain = 1 - nu * nu;
  return {plane_strain * 4.8 / units::pi, plane_strain * (1 - 2 * nu) / (1 - nu) / root_thickness,
          plane_strain * 18 / units::pi / (root_thickness * root_thickness)};
}

CantileverPlate::CantileverPlate(const ToothForm& form, double normal_module, double face_width, double poissons_ratio, double correction)
    : form_(form),
      normal_module_(normal_module),
      relative_face_(face_width / normal_module),
      foot_(form.fillet_point(units::pi / 2).y / normal_module) {
  const double cos_beta = std::cos(form.helix_angle());
  const double top = form.at_radius(form.tip_radius()).y / normal_module;
  const double involute = form.at_radius(form.form_radius()).y / normal_module;
  PlateShape shape;
  shape.thickness = [&](double y) {
    const double height = std::clamp(y, foot_, top) * normal_module;
    return 2 * cos_beta * form.at_height(height).x / normal_module;
  };
  shape.heights = {foot_, involute, top};
  shape.length = relative_face_ / cos_beta;
  shape.poissons_ratio = poissons_ratio;
  shape.edge = tooth_foundation(shape.thickness(foot_), poissons_ratio);
  const double along = correction * (kAlong + kAlongPerModule * shape.length);
  plate_.emplace(shape, static_cast<int>(along), static_cast<int>(correction * kUp));
}

Eigen::MatrixXd CantileverPlate::evaluate(std::span<const FlankStation> points) const {
  const double cos_beta = std::cos(form_.helix_angle());
  const auto n = static_cast<Eigen::Index>(points.size());
  std::vector<PlateLoad> loads;
  Eigen::VectorXd share(n);
  for (Eigen::Index p = 0; p < n; ++p) {
    const FlankStation& point = points[static_cast<std::size_t>(p)];
    require_on_flank(point, relative_face_);
    const ProfilePoint flank = form_.at_radius(flank_radius(form_, point.u));
    const double half_thickness = flank.x * cos_beta, tan_load = std::tan(flank.tangent_angle) * cos_beta;
    share[p] = 1 / std::sqrt(1 + tan_load * tan_load);
    // Boussinesq's stress at the depth h, 3 h^3 / (2 pi (x^2 + y^2 + h^2)^(5/2)), has the variance h^2 each way, the
    // weights of PlateLoad half^2 / 7.
    const double half = std::sqrt(7.0) * kSourceHeight * half_thickness / share[p] / normal_module_;
    const double height = std::max(foot_, (flank.y - half_thickness * tan_load) / normal_module_);
    loads.push_back({point.zeta / cos_beta, height, half, half});
  }
  Eigen::MatrixXd K = plate_->influence(loads);
  for (Eigen::Index p = 0; p < n; ++p) {
    for (Eigen::Index q = 0; q <= p; ++q) {
      const bool same_tooth = points[static_cast<std::size_t>(p)].tooth == points[static_cast<std::size_t>(q)].tooth;
      K(p, q) = K(q, p) = same_tooth ? share[p] * share[q] * K(p, q) : 0.0;
    }
  }
  return K;
}

}  // namespace flankwright
