#pragma once

#include "core/effects/effect.hpp"

namespace flankwright {

/// Tooth contact analysis, see core/contact: an additional output, independent of the loaded mesh. What a torque of 0
/// means.
class UnloadedContactEffect final : public Effect {
 public:
  std::string_view name() const override { return "unloaded_contact"; }
  EffectStage stage() const override { return EffectStage::Unloaded; }
  bool listed() const override { return false; }
  EffectCall called_for(const EffectFacts& facts) const override {
    return {facts.unloaded, facts.unloaded ? "a torque of 0 asks for tooth contact analysis" : "every torque is above 0"};
  }
};

}  // namespace flankwright
