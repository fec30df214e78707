#pragma once

#include <algorithm>

#include "core/effects/effect.hpp"

namespace flankwright {

/// Material removed from the flanks on purpose, see Modification.
class ModificationsEffect final : public Effect {
 public:
  std::string_view name() const override { return "modifications"; }
  EffectStage stage() const override { return EffectStage::Condition; }
  EffectCall called_for(const EffectFacts& facts) const override {
    const bool any = std::ranges::any_of(facts.conditions,
                                         [](const FlankCondition& c) { return modified(c.modification.pinion) || modified(c.modification.wheel); });
    return {any, any ? "a flank is modified or will be" : "no flank is modified"};
  }
  void clear_from(FlankCondition& condition) const override { condition.modification.pinion = condition.modification.wheel = {}; }

 private:
  static bool modified(const Modification& m) {
    return m.topography || std::ranges::any_of(modification_parameters, [&](const ModificationDescriptor& p) { return p.get(m) != 0.0; });
  }
};

}  // namespace flankwright
