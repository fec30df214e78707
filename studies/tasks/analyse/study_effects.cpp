#include "studies/tasks/analyse/study_effects.hpp"

#include "studies/compliance/study_compliance.hpp"
#include "studies/tasks/analyse/drawn_scenes.hpp"
#include "studies/study_file/sweep_value.hpp"

namespace flankwright::studies {

FlankCondition condition_of(const Study& study, const Scene& scene) {
  return {study.pinion_modification, study.wheel_modification, scene.pinion_error, scene.wheel_error, scene.misalignment};
}

EffectFacts effect_facts(const Study& study) {
  EffectFacts facts;
  facts.coupled_teeth = facts.gear_bodies = couples_teeth(study.fidelity.compliance);
  facts.root_stress = wants_root_stress(study);
  facts.shafts = study.pinion_shaft || study.wheel_shaft;
  facts.whole_surface = study.fidelity.gap == GapModel::WholeSurface;
  for (const Scene& scene : study.scenes) {
    FlankCondition condition = condition_of(study, scene);
    for (double torque : scene.torques) {
      const bool rigid = torque == 0.0 || study.fidelity.compliance == ComplianceModel::Rigid;
      (rigid ? facts.unloaded : facts.loaded) = true;
    }
    // Variables count as modifications from the start, even where their first value is 0.
    if (study.task == Task::Optimise) {
      for (const DesignVariable& v : study.optimise.variables) {
        set(v.member == Member::Pinion ? condition.pinion_modification : condition.wheel_modification, v.parameter,
            v.upper != 0.0 ? v.upper : v.lower);
      }
    }
    facts.conditions.push_back(condition);
  }
  // What scatters counts as well; four scenes are enough to see a value other than 0.
  for (const Scene& scene : draw_scenes(study, {.samples = study.optimise.proof.tolerances.empty() ? 0 : 4})) {
    facts.conditions.push_back(condition_of(study, scene));
  }
  if (study.task == Task::Sweep) {
    for (const SweptCondition& extreme : extreme_conditions(study)) facts.conditions.push_back(extreme.flanks());
  }
  return facts;
}

EffectDecisions study_effects(const Study& study) {
  const EffectFacts facts = effect_facts(study);
  return study.fidelity.automatic_effects ? decide_effects(facts) : chosen_effects(facts, study.fidelity.effects);
}

void add_seconds(EffectDecisions& decisions, const MeshEffects& in_mesh, double unloaded_seconds) {
  for (EffectDecision& decision : decisions) {
    if (in_mesh.calls(decision.name) > 0) decision.seconds = in_mesh.seconds(decision.name);
    if (decision.name == "unloaded_contact" && decision.on) decision.seconds = unloaded_seconds;
  }
}

}  // namespace flankwright::studies
