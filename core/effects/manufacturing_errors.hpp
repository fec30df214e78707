#pragma once

#include <algorithm>

#include "core/effects/effect.hpp"

namespace flankwright {

/// Flanks that are not as they should be, tooth by tooth or all alike, see ManufacturingError.
class ManufacturingErrorsEffect final : public Effect {
 public:
  std::string_view name() const override { return "manufacturing_errors"; }
  EffectStage stage() const override { return EffectStage::Condition; }
  EffectCall called_for(const EffectFacts& facts) const override {
    const bool any = std::ranges::any_of(facts.conditions, [](const FlankCondition& c) { return faulty(c.error.pinion) || faulty(c.error.wheel); });
    return {any, any ? "a gear has manufacturing errors" : "no manufacturing errors are given"};
  }
  void clear_from(FlankCondition& condition) const override { condition.error.pinion = condition.error.wheel = {}; }

 private:
  static bool faulty(const ManufacturingError& e) {
    const auto some = [](const std::vector<double>& list) { return std::ranges::any_of(list, [](double f) { return f != 0.0; }); };
    return e.helix_slope != 0.0 || e.profile_slope != 0.0 || e.twist != 0.0 || e.pitch_step != 0.0 || some(e.cumulative_pitch) ||
           std::ranges::any_of(e.topographies, [](const auto& field) { return field != nullptr; }) || some(e.helix_slopes) ||
           some(e.profile_slopes) || some(e.twists);
  }
};

}  // namespace flankwright
