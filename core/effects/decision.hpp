#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/effects/mesh_effects.hpp"

namespace flankwright {

/// Whether an effect entered a run, why, and what it cost.
struct EffectDecision {
  std::string name;
  bool on{false};
  std::string why;
  double seconds{not_given};  ///< time spent on it; NaN where it cannot be separated
};
using EffectDecisions = std::vector<EffectDecision>;

/// Names of the effects that a study's list switches, in the order of the flow.
std::vector<std::string> listed_effect_names();

/// Which effects the scenes call for, each with its reason.
EffectDecisions decide_effects(const EffectFacts& facts, const EffectList& effects = registered_effects());

/// Effects switched by hand: exactly those named whose requirements are named too. Effects that other keys switch stay
/// as called for.
/// @throws InvalidInput for an unknown name
EffectDecisions chosen_effects(const EffectFacts& facts, const std::vector<std::string>& names, const EffectList& effects = registered_effects());

/// True where the effect of that name is on.
bool is_on(const EffectDecisions& decisions, std::string_view name);

/// The decisions with one effect, and what needs it, switched off.
EffectDecisions without(EffectDecisions decisions, std::string_view name, const std::string& why);

/// The effects that are on, for the loaded mesh.
MeshEffects mesh_effects(const EffectDecisions& decisions, const EffectList& effects = registered_effects());

/// The condition without everything whose effect is off.
FlankCondition apply_effects(const EffectDecisions& decisions, FlankCondition condition, const EffectList& effects = registered_effects());

/// Names of the effects of a study's list that are off and hold a part of a condition, which apply_effects() takes from it.
std::vector<std::string> effects_missing_for(const EffectDecisions& decisions, const FlankCondition& condition,
                                             const EffectList& effects = registered_effects());

/// The gap model with these effects.
GapModel gap_model(const EffectDecisions& decisions);

}  // namespace flankwright
