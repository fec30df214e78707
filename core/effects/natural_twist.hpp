#pragma once

#include <algorithm>

#include "core/effects/effect.hpp"

namespace flankwright {

/// Lead modifications that grinding moves over the flank, see ContactShift. Off, they are as drawn.
class NaturalTwistEffect final : public Effect {
 public:
  std::string_view name() const override { return "natural_twist"; }
  EffectStage stage() const override { return EffectStage::Condition; }
  std::string_view needs() const override { return "modifications"; }
  EffectCall called_for(const EffectFacts& facts) const override {
    if (!facts.helical) return {false, "a spur gear's flank is not twisted by its grinding"};
    if (!some(facts, [](const Modification& m) { return m.process.twists(); })) return {false, "no flank is ground by a process that twists it"};
    const bool on = some(facts, [](const Modification& m) { return m.process.twists() && has_lead_modification(m); });
    return {on, on ? "grinding twists the lead modification of a flank" : "no flank so ground has a lead modification"};
  }
  void clear_from(FlankCondition& condition) const override { condition.modification.pinion.process = condition.modification.wheel.process = {}; }

 private:
  template <class Holds>
  static bool some(const EffectFacts& facts, const Holds& holds) {
    return std::ranges::any_of(facts.conditions,
                               [&](const FlankCondition& c) { return holds(c.modification.pinion) || holds(c.modification.wheel); });
  }
};

}  // namespace flankwright
