#include "core/compliance/tooth/tooth_places.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.hpp"

namespace flankwright {

double flank_radius(const ToothForm& form, double u) {
  const double radius = form.form_radius() + 0.5 * (u + 1) * (form.tip_radius() - form.form_radius());
  return std::clamp(radius, form.form_radius(), form.tip_radius());
}

void require_on_flank(const FlankPlace& place, double relative_face) {
  if (!(std::abs(place.u) <= 1)) throw InvalidInput("place.u", std::to_string(place.u), "-1 .. 1");
  if (!(place.zeta >= 0 && place.zeta <= relative_face)) {
    throw InvalidInput("place.zeta", std::to_string(place.zeta), "0 .. " + std::to_string(relative_face));
  }
}

}  // namespace flankwright
