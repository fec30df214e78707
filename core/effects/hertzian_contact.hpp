#pragma once

#include "core/compliance/local/hertz_line.hpp"
#include "core/effects/effect.hpp"

namespace flankwright {

/// Flanks flatten where they touch, see ContactLaw.
class HertzianContactEffect final : public Effect {
 public:
  std::string_view name() const override { return "hertzian_contact"; }
  EffectStage stage() const override { return EffectStage::ContactLaw; }
  bool makes_compliant() const override { return true; }
  EffectCall called_for(const EffectFacts& facts) const override { return {facts.loaded, facts.loaded ? "flanks flatten under load" : "no load"}; }
  void act(MeshBuilder& builder) const override {
    const MeshParts& parts = builder.parts;
    const double modulus = contact_modulus(parts.material.pinion, parts.material.wheel);
    for (std::size_t i = 0; i < builder.points.size(); ++i) {
      const ContactPoint& point = builder.points[i];
      const TipDistances& tips = builder.tip_distances[i];
      const EndDistances& ends = builder.end_distances[i];
      ContactSide pinion = ContactSide::of(parts.material.pinion, point.pinion_depth, tips.pinion, ends.pinion, ends.pinion_lean);
      ContactSide wheel = ContactSide::of(parts.material.wheel, point.wheel_depth, tips.wheel, ends.wheel, ends.wheel_lean);
      pinion.correction = builder.corrections[i].pinion;
      wheel.correction = builder.corrections[i].wheel;
      builder.laws.emplace_back(pinion, wheel, point.relative_radius, modulus, builder.tip_edges[i]);
    }
  }
};

}  // namespace flankwright
