#pragma once

#include "core/effects/effect.hpp"

namespace flankwright {

/// Near a tip's corner there is less material to hold what is pressed on: Steward's factor M, see tip_factor().
class TipCornerEffect final : public Effect {
 public:
  std::string_view name() const override { return "tip_corner"; }
  EffectStage stage() const override { return EffectStage::ContactSite; }
  std::string_view needs() const override { return "hertzian_contact"; }
  EffectCall called_for(const EffectFacts& facts) const override {
    return {facts.loaded, facts.loaded ? "contact softens near the tips" : "no load"};
  }
  void act(MeshBuilder& builder) const override {
    for (std::size_t i = 0; i < builder.points.size(); ++i) {
      builder.tip_distances[i] = {builder.points[i].pinion_tip_distance, builder.points[i].wheel_tip_distance};
    }
  }
};

}  // namespace flankwright
