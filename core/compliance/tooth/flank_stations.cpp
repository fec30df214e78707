#include "core/compliance/tooth/flank_stations.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.hpp"

namespace flankwright {

double flank_radius(const ToothForm& form, double u) {
  const double radius = form.form_radius() + 0.5 * (u + 1) * (form.tip_radius() - form.form_radius());
  return std::clamp(radius, form.form_radius(), form.tip_radius());
}

void require_on_flank(const FlankStation& station, double relative_face) {
  if (!(std::abs(station.u) <= 1)) throw InvalidInput("place.u", std::to_string(station.u), "-1 .. 1");
  if (!(station.zeta >= 0 && station.zeta <= relative_face)) {
    throw InvalidInput("place.zeta", std::to_string(station.zeta), "0 .. " + std::to_string(relative_face));
  }
}

}  // namespace flankwright
