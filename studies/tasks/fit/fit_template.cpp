#include "studies/tasks/fit/fit_template.hpp"

#include <string_view>

namespace flankwright::studies {

std::string fit_template() {
  static constexpr std::string_view text =
      R"(# Compliance of each gear by finite elements, fitted by a sum of kernels and compared with other models. Flank
# modifications, loads and misalignment do not enter.
title = "Compliance of my gears"
task = "fit"

[pair]
normal_module = 4                    # mm
pressure_angle = 20                  # deg, normal section
helix_angle = 15                     # deg, 0 is a spur gear

[pinion]
teeth = 20
face_width = 40                      # mm
profile_shift = 0.2                  # in normal modules, + outwards
rack = { addendum = 1, dedendum = 1.25, root_radius = 0.39 }         # in normal modules

[wheel]
teeth = 40
face_width = 40

[pinion.body]                        # the gear below its teeth; [wheel.body] alike
# shaft_diameter = 40                # mm; by default 0.8 d, at most 25 m_n/cos(beta)
# bore_diameter = 2                  # mm; by default 0.05 of the shaft
# shaft_overhang = 20                # mm beyond each face end; by default half the shaft's diameter

[material]
youngs_modulus = 206000              # MPa
poissons_ratio = 0.3

[fit]
gear = "both"                        # or "pinion", "wheel"
form = "one_tooth_accurate"          # the loaded tooth alone; "several_teeth" couples its neighbours, less closely
# test_grid = "off"                  # leaves out the comparison at stations that the fit has not seen
# max_iterations = 600               # steps of the least squares

# Required accuracy of the fit, for `flankwright test`:
# [expect]
# "fit.residuals.kernels.unseen.0.median_percent" = { max = 1 }      # 0: the loaded tooth, 1: one pitch away ...
)";

  return std::string(text);
}

}  // namespace flankwright::studies
