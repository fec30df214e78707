#include "core/effects/effects.hpp"

#include <algorithm>
#include <array>

namespace flankwright {

namespace {

bool any(const Modification& m) {
  return m.topography || std::any_of(modification_parameters.begin(), modification_parameters.end(),
                                     [&](const NamedModificationParameter& p) { return get(m, p.parameter) != 0.0; });
}

bool any(const ManufacturingError& e) {
  const auto some = [](const std::vector<double>& list) { return std::ranges::any_of(list, [](double f) { return f != 0.0; }); };
  return e.helix_slope != 0.0 || e.profile_slope != 0.0 || e.twist != 0.0 || e.pitch_step != 0.0 || some(e.cumulative_pitch) ||
         std::ranges::any_of(e.topographies, [](const auto& field) { return field != nullptr; }) || some(e.helix_slopes) || some(e.profile_slopes) || some(e.twists);
}

bool any(const Misalignment& m) {
  return m.crossing != 0.0 || m.intersecting != 0.0 || m.centre_distance != 0.0 || m.axial_offset != 0.0 ||
         m.pinion_lead_angle != 0.0 || m.pinion_pressure_angle != 0.0 || m.mesh_misalignment != 0.0;
}

/// A rule: the effect is called for when the facts say so.
struct Rule {
  std::string_view name;
  bool (*called_for)(const EffectFacts&);
  const char* why_on;
  const char* why_off;
};

bool under_load(const EffectFacts& facts) { return facts.loaded; }

bool in_some_scene(const EffectFacts& facts, bool (*holds)(const FlankCondition&)) {
  return std::any_of(facts.conditions.begin(), facts.conditions.end(), holds);
}

constexpr std::array<Rule, 11> rules{{
    {"unloaded_contact", [](const EffectFacts& f) { return f.unloaded; }, "a torque of 0 asks for tooth contact analysis",
     "every torque is above 0"},
    {"misalignment",
     [](const EffectFacts& f) { return in_some_scene(f, [](const FlankCondition& c) { return any(c.misalignment); }); },
     "a scene is misaligned", "every scene is aligned"},
    {"modifications",
     [](const EffectFacts& f) {
       return in_some_scene(f, [](const FlankCondition& c) { return any(c.pinion_modification) || any(c.wheel_modification); });
     },
     "a flank is modified or will be", "no flank is modified"},
    {"manufacturing_errors",
     [](const EffectFacts& f) {
       return in_some_scene(f, [](const FlankCondition& c) { return any(c.pinion_error) || any(c.wheel_error); });
     },
     "a gear has manufacturing errors", "no manufacturing errors are given"},
    {"bending", under_load, "teeth bend under load", "no load"},
    {"adjacent_teeth", [](const EffectFacts& f) { return f.loaded && f.coupled_teeth; },
     "a loaded tooth moves its neighbours", "no load, or a compliance of teeth that do not know of each other"},
    {"shafts", [](const EffectFacts& f) { return f.loaded && f.shafts; }, "a gear's shaft is described",
     "no load, or no shaft is described: they are rigid"},
    {"hertzian_contact", under_load, "flanks flatten under load", "no load"},
    {"tip_corner", under_load, "contact softens near the tips", "no load"},
    {"extended_contact_region", under_load, "loaded teeth touch before and after the theoretical path", "no load"},
    {"root_stress", [](const EffectFacts& f) { return f.loaded && f.root_stress; },
     "finite elements tell the stress of the roots", "no load, or no finite elements and nothing asks for peak_root_stress"},
}};

}  // namespace

std::vector<std::string_view> effect_names() {
  std::vector<std::string_view> names;
  for (const Rule& rule : rules) names.push_back(rule.name);
  return names;
}

std::vector<Effect> decide_effects(const EffectFacts& facts) {
  std::vector<Effect> effects;
  for (const Rule& rule : rules) {
    const bool on = rule.called_for(facts);
    effects.push_back({std::string(rule.name), on, on ? rule.why_on : rule.why_off});
  }
  return effects;
}

std::vector<Effect> chosen_effects(const EffectFacts& facts, const std::vector<std::string>& names) {
  const std::vector<std::string_view> known = effect_names();
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InvalidInput("fidelity.effects", name, "one of the effect names");
    }
  }
  std::vector<Effect> effects = decide_effects(facts);
  for (Effect& effect : effects) {
    if (effect.name == "unloaded_contact") continue;  // what a torque of 0 means; nothing to leave out
    effect.on = std::find(names.begin(), names.end(), effect.name) != names.end();
    effect.why = effect.on ? "named in the study's list" : "not named in the study's list";
  }
  return effects;
}

bool is_on(const std::vector<Effect>& effects, std::string_view name) {
  return std::any_of(effects.begin(), effects.end(), [&](const Effect& e) { return e.on && e.name == name; });
}

MeshEffects mesh_effects(const std::vector<Effect>& effects) {
  return {is_on(effects, "bending"), is_on(effects, "adjacent_teeth"), is_on(effects, "hertzian_contact"), is_on(effects, "tip_corner"),
          is_on(effects, "extended_contact_region")};
}

FlankCondition apply_effects(const std::vector<Effect>& effects, FlankCondition condition) {
  if (!is_on(effects, "misalignment")) condition.misalignment = {};
  if (!is_on(effects, "modifications")) condition.pinion_modification = condition.wheel_modification = {};
  if (!is_on(effects, "manufacturing_errors")) condition.pinion_error = condition.wheel_error = {};
  return condition;
}

}  // namespace flankwright
