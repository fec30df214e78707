#pragma once

#include <algorithm>

#include "core/effects/effect.hpp"

namespace flankwright {

/// Shafts that are not where they should be, see Misalignment and plane_of_action_gap().
class MisalignmentEffect final : public Effect {
 public:
  std::string_view name() const override { return "misalignment"; }
  EffectStage stage() const override { return EffectStage::Condition; }
  EffectCall called_for(const EffectFacts& facts) const override {
    const bool any = std::ranges::any_of(facts.conditions, [](const FlankCondition& c) { return c.misalignment != Misalignment{}; });
    return {any, any ? "a scene is misaligned" : "every scene is aligned"};
  }
  void clear_from(FlankCondition& condition) const override { condition.misalignment = {}; }
};

}  // namespace flankwright
