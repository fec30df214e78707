#include "core/effects/decision.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace flankwright {

std::vector<std::string> listed_effect_names() {
  std::vector<std::string> names;
  for (const Effect* effect : registered_effects()) {
    if (effect->listed()) names.emplace_back(effect->name());
  }
  return names;
}

EffectDecisions decide_effects(const EffectFacts& facts, const EffectList& effects) {
  EffectDecisions decisions;
  for (const Effect* effect : in_order_of_flow(effects)) {
    const EffectCall call = effect->called_for(facts);
    decisions.push_back({std::string(effect->name()), call.on, call.why});
  }
  return decisions;
}

EffectDecisions chosen_effects(const EffectFacts& facts, const std::vector<std::string>& names, const EffectList& effects) {
  const auto is_named = [&](std::string_view name) { return std::ranges::find(names, name) != names.end(); };
  for (const std::string& name : names) {
    if (std::ranges::none_of(effects, [&](const Effect* e) { return e->name() == name; })) {
      throw InvalidInput("fidelity.effects", name, "one of the effect names");
    }
  }
  EffectDecisions decisions = decide_effects(facts, effects);
  const EffectList in_order = in_order_of_flow(effects);
  for (std::size_t i = 0; i < decisions.size(); ++i) {
    if (!in_order[i]->listed()) continue;  // what a torque of 0 or another key means; nothing to choose
    decisions[i].on = is_named(decisions[i].name);
    decisions[i].why = decisions[i].on ? "named in the study's list" : "not named in the study's list";
    const std::string needed(in_order[i]->needs());
    if (needed.empty() || is_named(needed) || !decisions[i].on) continue;
    decisions[i].on = false;
    decisions[i].why = "named in the study's list, but nothing without " + needed + ", which is not";
  }
  return decisions;
}

bool is_on(const EffectDecisions& decisions, std::string_view name) {
  return std::ranges::any_of(decisions, [&](const EffectDecision& d) { return d.on && d.name == name; });
}

EffectDecisions without(EffectDecisions decisions, std::string_view name, const std::string& why) {
  for (EffectDecision& decision : decisions) {
    if (decision.name != name || !decision.on) continue;
    decision.on = false;
    decision.why = why;
  }
  for (const Effect* effect : registered_effects()) {
    if (effect->needs() != name || !is_on(decisions, effect->name())) continue;
    decisions = without(std::move(decisions), effect->name(), "nothing without " + std::string(name) + ", which is off");
  }
  return decisions;
}

MeshEffects mesh_effects(const EffectDecisions& decisions, const EffectList& effects) {
  EffectList on;
  std::ranges::copy_if(effects, std::back_inserter(on), [&](const Effect* effect) { return is_on(decisions, effect->name()); });
  return MeshEffects(std::move(on));
}

FlankCondition apply_effects(const EffectDecisions& decisions, FlankCondition condition, const EffectList& effects) {
  for (const Effect* effect : effects) {
    if (!is_on(decisions, effect->name())) effect->clear_from(condition);
  }
  return condition;
}

std::vector<std::string> effects_missing_for(const EffectDecisions& decisions, const FlankCondition& condition, const EffectList& effects) {
  std::vector<std::string> missing;
  for (const Effect* effect : in_order_of_flow(effects)) {
    if (!effect->listed() || is_on(decisions, effect->name())) continue;
    FlankCondition rest = condition;
    effect->clear_from(rest);
    if (!(rest == condition)) missing.emplace_back(effect->name());
  }
  return missing;
}

GapModel gap_model(const EffectDecisions& decisions) {
  return is_on(decisions, "whole_surface_gap") ? GapModel::WholeSurface : GapModel::PlaneOfAction;
}

}  // namespace flankwright
