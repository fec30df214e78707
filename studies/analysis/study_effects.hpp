#pragma once

#include "core/effects/decision.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// The flanks of a scene as the study has them, whatever effects are on.
FlankCondition condition_of(const Study& study, const Scene& scene);

/// The flanks of all the study's scenes.
std::vector<FlankCondition> conditions_of(const Study& study);

/// What a study asks of its effects: its scenes, and what its task brings beside them.
EffectFacts effect_facts(const Study& study);

/// The effects of a study, by themselves or as its list names them.
/// @throws InvalidInput  as chosen_effects()
EffectDecisions study_effects(const Study& study);

/// Fills in what the effects on have cost, as far as it can be told apart: what they did to the meshes, and tooth contact analysis.
/// @param unloaded_seconds  spent on contact without load [s]
void add_seconds(EffectDecisions& decisions, const MeshEffects& in_mesh, double unloaded_seconds);

}  // namespace flankwright::studies
