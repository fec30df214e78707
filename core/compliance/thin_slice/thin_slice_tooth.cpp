#include "core/compliance/thin_slice/thin_slice_tooth.hpp"

#include <algorithm>
#include <cmath>

#include "core/compliance/thin_slice/tooth_bending.hpp"
#include "core/compliance/tooth/flank_stations.hpp"

namespace flankwright {

ThinSliceTooth::ThinSliceTooth(const ToothForm& form, double normal_module, double face_width, double poissons_ratio, double calibration)
    : form_(form), relative_face_(face_width / normal_module), poissons_ratio_(poissons_ratio), calibration_(calibration) {}

Eigen::MatrixXd ThinSliceTooth::evaluate(std::span<const FlankStation> points) const {
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::VectorXd root(n);
  for (Eigen::Index p = 0; p < n; ++p) {
    const FlankStation& point = points[static_cast<std::size_t>(p)];
    require_on_flank(point, relative_face_);
    const double Q = calibration_ * tooth_compliance(form_, flank_radius(form_, point.u), poissons_ratio_).total();
    root[p] = std::sqrt(Q / kSpread);
  }
  const double cos_beta = std::cos(form_.helix_angle());
  Eigen::MatrixXd K(n, n);
  for (Eigen::Index p = 0; p < n; ++p) {
    for (Eigen::Index q = 0; q <= p; ++q) {
      const FlankStation &a = points[static_cast<std::size_t>(p)], &b = points[static_cast<std::size_t>(q)];
      const double overlap = std::max(0.0, 1 - std::abs(a.zeta - b.zeta) / cos_beta / kSpread);
      K(p, q) = K(q, p) = a.tooth == b.tooth ? root[p] * root[q] * overlap : 0.0;
    }
  }
  return K;
}

}  // namespace flankwright
