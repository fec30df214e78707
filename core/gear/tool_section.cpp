#include "core/gear/tool_section.hpp"

#include "core/gear/tooth_form.hpp"

namespace flankwright {

ParabolicSection::ParabolicSection(const ParabolicRack& tool, const PairData& pair) {
  const double cos_beta = std::cos(pair.helix_angle), sin_beta = std::sin(pair.helix_angle);
  const double alpha_t = std::atan(std::tan(pair.pressure_angle) / cos_beta);
  const double cos_alpha_n = std::cos(pair.pressure_angle);
  // ISO 21771: cos(beta_b) cos(alpha_t) = cos(beta) cos(alpha_n).
  curvature_ = tool.coefficient * std::cos(alpha_t) / (cos_beta * cos_alpha_n);
  stretch_ = cos_alpha_n / std::cos(alpha_t);
  bend_ = tool.coefficient * cos_alpha_n * std::sin(alpha_t) * sin_beta * sin_beta / cos_beta;
}

RevolutionSection::RevolutionSection(const RevolutionTool& tool, const PairData& pair, const GearData& gear)
    : sin_(std::sin(tool.half_apex)),
      cos_(std::cos(tool.half_apex)),
      apex_distance_(tool.distance / cos_ - (gear.rack.dedendum - generating_profile_shift(gear, pair.normal_module, pair.pressure_angle)) *
                                                pair.normal_module / std::cos(pair.pressure_angle)),
      curvature_(1.0 / tool.arc_radius) {}

}  // namespace flankwright
