#include "core/compliance/finite_element/solve_half_space_correction.hpp"

#include <cmath>

#include "core/base/units.hpp"
#include "core/compliance/local/contact_law.hpp"
#include "core/compliance/local/hertz_line.hpp"

namespace flankwright {
namespace {

constexpr double closest_to_tip = 0.99;  ///< height up to which the last two are extrapolated

/// Deflection of one body down to a depth in a half space under a unit line load, E = 1.
double half_space_deflection(double depth, double half_width, double poissons_ratio) {
  const Material material{1, poissons_ratio};
  const ContactSide side = ContactSide::of(material, depth);
  const double modulus = contact_modulus(material, material);
  const ContactLaw both(side, side, half_width * half_width * units::pi * modulus / 4, modulus);  // L = sqrt(4 w R / (pi E'))
  return both.deflection(1) / 2;
}

}  // namespace

HalfSpaceCorrection half_space_correction(const LoadedSection& section, const Gear& gear) {
  std::vector<double> all(section_heights.begin(), section_heights.end()), values;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    values.push_back(section.flank_deflection[k] - section.centre_deflection[k] -
                     half_space_deflection(section.places[i].law_depth, section.half_width, section.poissons_ratio));
  }
  // Closer to the tip, where no pressure fits in, the deflection goes on growing with the logarithm of the distance as at the edge of a wedge.
  const std::size_t last = all.size() - 1;
  all.push_back(closest_to_tip);
  values.push_back(values[last] + (values[last] - values[last - 1]) * std::log((1 - all[last]) / (1 - closest_to_tip)) /
                                      std::log((1 - all[last - 1]) / (1 - all[last])));
  return {gear.form_radius, gear.tip_radius, all, values};
}

}  // namespace flankwright
