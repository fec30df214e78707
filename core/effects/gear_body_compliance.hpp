#pragma once

#include "core/effects/effect.hpp"

namespace flankwright {

/// The gear's body yields under its teeth: the material deeper than that right below them.
class GearBodyComplianceEffect final : public Effect {
 public:
  std::string_view name() const override { return "gear_body_compliance"; }
  EffectStage stage() const override { return EffectStage::Body; }
  EffectCall called_for(const EffectFacts& facts) const override {
    const bool on = facts.loaded && facts.gear_bodies;
    return {on, on ? "the gear body is compliant as well" : "no load, or a compliance model without gear bodies"};
  }
  void act(MeshBuilder& builder) const override { builder.with_gear_bodies = true; }
};

}  // namespace flankwright
