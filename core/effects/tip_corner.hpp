#pragma once

#include <cmath>

#include "core/base/units.hpp"
#include "core/effects/effect.hpp"

namespace flankwright {

/// A tooth is no half space, least of all near its tip's corner, where there is less material to hold what is pressed on. Beside a structure of finite
/// elements what is missing was solved for, see HalfSpaceCorrection; for slices it is Steward's factor M, see tip_factor().
class TipCornerEffect final : public Effect {
 public:
  std::string_view name() const override { return "tip_corner"; }
  EffectStage stage() const override { return EffectStage::ContactSite; }
  std::string_view needs() const override { return "hertzian_contact"; }
  EffectCall called_for(const EffectFacts& facts) const override {
    return {facts.loaded, facts.loaded ? "contact softens near the tips" : "no load"};
  }
  void act(MeshBuilder& builder) const override {
    const MeshParts& parts = builder.parts;
    for (std::size_t i = 0; i < builder.points.size(); ++i) {
      const ContactPoint& point = builder.points[i];
      const EndDistances& ends = builder.end_distances[i];
      if (const auto& pinion = parts.half_space.pinion) {
        builder.corrections[i].pinion =
            correction(pinion->at(point.pinion_radius), parts.material.pinion, point.pinion_depth, ends.pinion, ends.pinion_lean);
      } else {
        builder.tip_distances[i].pinion = point.pinion_tip_distance;
      }
      if (const auto& wheel = parts.half_space.wheel) {
        builder.corrections[i].wheel =
            correction(wheel->at(point.wheel_radius), parts.material.wheel, point.wheel_depth, ends.wheel, ends.wheel_lean);
      } else {
        builder.tip_distances[i].wheel = point.wheel_tip_distance;
      }
    }
  }

 private:
  /// The ends' softening is counted from mid face, where the structure has what a narrow face adds.
  static double correction(double of_half_space, const Material& material, double depth, const std::array<double, 2>& ends, double lean) {
    const double middle = 0.5 * (ends[0] + ends[1]);
    constexpr double narrow = 1e-6;  // a pressure that is thin against the depth
    const double at_mid_face =
        std::isinf(middle) ? 0.0 : 2.0 / units::pi * FreeEnd(material.poissons_ratio, lean).at({middle, middle}, depth, narrow * depth).value;
    return (of_half_space - at_mid_face) / material.youngs_modulus;
  }
};

}  // namespace flankwright
