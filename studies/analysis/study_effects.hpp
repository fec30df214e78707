#pragma once

#include "core/effects/decision.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// The flanks of a scene as the study has them, of drawn gears with what they differ by from the design, whatever effects are on.
FlankCondition condition_of(const Study& study, const Scene& scene);

/// A scene under a load of the spectrum, whose own misalignment comes on top.
Scene under_load(Scene scene, const SpectrumBin& load);

/// The flanks of all the study's scenes, and under each load of the spectrum that misaligns them further.
std::vector<FlankCondition> conditions_of(const Study& study);

/// The modifications of a study with their processes as they are analysed: without one where the effect of it is off.
PerGear<Modification> analysed_modification(const Study& study, const EffectDecisions& effects);

/// The part of a study that its effects depend on: its scenes, and the needs of its task.
EffectFacts effect_facts(const Study& study);

/// The effects of a study, by themselves or as its list names them.
/// @throws InvalidInput  as chosen_effects()
EffectDecisions study_effects(const Study& study);

/// Fills in the times of the effects that are on, where they can be separated: work on the meshes, and tooth contact analysis.
/// @param unloaded_seconds  spent on contact without load [s]
void add_seconds(EffectDecisions& decisions, const MeshEffects& in_mesh, double unloaded_seconds);

}  // namespace flankwright::studies
