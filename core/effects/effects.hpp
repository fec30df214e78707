#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/contact/gap.hpp"
#include "core/load/mesh_model.hpp"

namespace flankwright {

/// One physical effect: whether it entered the run, why, and what it cost.
struct Effect {
  std::string name;
  bool on{false};
  std::string why;
  double seconds{not_given};  ///< time spent on it; NaN where it cannot be told apart
};

/// What a study asks of the analysis, as far as effects depend on it.
struct EffectFacts {
  bool loaded{false};       ///< some torque is above zero
  bool unloaded{false};     ///< some torque is zero
  std::vector<FlankCondition> conditions{};  ///< of all scenes
  bool coupled_teeth{false};  ///< the compliance model knows how one tooth moves another
  bool shafts{false};         ///< a gear's shaft is described
  bool root_stress{false};    ///< finite elements are made anyway, or something asks for peak_root_stress
};

/// Names of all effects, in the order of the flow.
std::vector<std::string_view> effect_names();

/// Which effects the scenes call for, each with its reason.
std::vector<Effect> decide_effects(const EffectFacts& facts);

/// Effects switched by hand: exactly those named.
/// @throws InvalidInput for an unknown name
std::vector<Effect> chosen_effects(const EffectFacts& facts, const std::vector<std::string>& names);

/// True where the effect of that name is on.
bool is_on(const std::vector<Effect>& effects, std::string_view name);

/// The part of the effects that the loaded mesh model knows.
MeshEffects mesh_effects(const std::vector<Effect>& effects);

/// The condition with everything cleared whose effect is off (misalignment, modifications, manufacturing_errors).
FlankCondition apply_effects(const std::vector<Effect>& effects, FlankCondition condition);

}  // namespace flankwright
