#pragma once

#include "core/effects/effect.hpp"

namespace flankwright {

/// The stress of the loads in the fillets, see PairRootStress: an additional output, which changes no load.
class RootStressEffect final : public Effect {
 public:
  std::string_view name() const override { return "root_stress"; }
  EffectStage stage() const override { return EffectStage::Roots; }
  EffectCall called_for(const EffectFacts& facts) const override {
    const bool on = facts.loaded && facts.root_stress;
    return {on, on ? "root stress by finite elements" : "no load, or no finite elements and nothing asks for peak_root_stress"};
  }
  void act(MeshBuilder& builder) const override {
    if (builder.parts.root_stress) builder.root_stress = builder.parts.root_stress->influence(builder.points, builder.parts.axial_offset());
  }
};

}  // namespace flankwright
