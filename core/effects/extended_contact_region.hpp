#pragma once

#include "core/effects/effect.hpp"

namespace flankwright {

/// Tip edges that touch before A and after E, as teeth bend into each other, see contact_points().
class ExtendedContactRegionEffect final : public Effect {
 public:
  std::string_view name() const override { return "extended_contact_region"; }
  EffectStage stage() const override { return EffectStage::Region; }
  EffectCall called_for(const EffectFacts& facts) const override {
    return {facts.loaded, facts.loaded ? "loaded teeth touch before and after the theoretical path" : "no load"};
  }
  void act(MeshBuilder& builder) const override { builder.with_extended_region = true; }
};

}  // namespace flankwright
