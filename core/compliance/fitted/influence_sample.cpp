#include "core/compliance/fitted/influence_sample.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.hpp"

namespace flankwright {

void GearProportions::validate() const {
  if (teeth < 5) throw InvalidInput("gear.teeth", std::to_string(teeth), "an integer of at least 5");
  if (!(std::abs(helix_angle) < 1.5)) {
    throw InvalidInput("gear.helix_angle", std::to_string(helix_angle), "between -1.5 and 1.5 rad");
  }
  if (!(relative_face > 0) || !std::isfinite(relative_face)) {
    throw InvalidInput("gear.relative_face", std::to_string(relative_face), "a positive number of modules");
  }
  if (!std::isfinite(profile_shift)) {
    throw InvalidInput("gear.profile_shift", std::to_string(profile_shift), "a finite number");
  }
}

double InfluenceSample::at(Eigen::Index p, Eigen::Index q) const {
  const double there = compliance(p, q), back = compliance(q, p);
  if (std::isnan(there)) return back;
  if (std::isnan(back)) return there;
  return 0.5 * (there + back);
}

void InfluenceSample::validate() const {
  gear.validate();
  const auto n = static_cast<Eigen::Index>(points.size());
  if (n == 0) throw InvalidInput("sample.points", "none", "at least one point");
  if (compliance.rows() != n || compliance.cols() != n) {
    throw InvalidInput("sample.compliance", std::to_string(compliance.rows()) + " x " + std::to_string(compliance.cols()),
                       "as many rows and columns as points, " + std::to_string(n));
  }
  if (given.size() != 0 && (given.rows() != n || given.cols() != n || !given.allFinite())) {
    throw InvalidInput("sample.given", std::to_string(given.rows()) + " x " + std::to_string(given.cols()),
                       "nothing, or finite values as many as the compliance has");
  }
  for (const FlankStation& point : points) {
    if (!(std::abs(point.u) <= 1.05)) throw InvalidInput("sample.u", std::to_string(point.u), "-1.05 .. 1.05");
    if (!(point.zeta >= 0 && point.zeta <= gear.relative_face)) {
      throw InvalidInput("sample.zeta", std::to_string(point.zeta), "0 .. " + std::to_string(gear.relative_face));
    }
  }
  if (compliance.array().isInf().any()) throw InvalidInput("sample.compliance", "inf", "finite values, or NaN where unknown");
  for (Eigen::Index p = 0; p < n; ++p) {
    if (compliance(p, p) <= 0) {
      throw InvalidInput("sample.compliance", std::to_string(compliance(p, p)), "a positive diagonal");
    }
  }
}

}  // namespace flankwright
