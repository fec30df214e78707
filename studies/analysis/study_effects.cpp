#include "studies/analysis/study_effects.hpp"

#include "studies/compliance/study_compliance.hpp"

namespace flankwright::studies {

FlankCondition condition_of(const Study& study, const Scene& scene) {
  DesignScene of_design;
  of_design.condition.error = scene.error;
  of_design.condition.misalignment = scene.misalignment;
  of_design.condition.other_flanks = loads_other_flanks(study, scene);
  of_design.deviations = scene.deviations;
  return of_design.with_design(study.modification);
}

Scene under_load(Scene scene, const SpectrumBin& load) {
  scene.misalignment.mesh_misalignment += load.mesh_misalignment;
  return scene;
}

std::vector<FlankCondition> conditions_of(const Study& study) {
  std::vector<FlankCondition> conditions;
  for (const Scene& scene : study.scenes) {
    conditions.push_back(condition_of(study, scene));
    for (const SpectrumBin& load : study.spectrum) {
      if (load.mesh_misalignment != 0.0) conditions.push_back(condition_of(study, under_load(scene, load)));
    }
  }
  return conditions;
}

PerGear<Modification> analysed_modification(const Study& study, const EffectDecisions& effects) {
  PerGear<Modification> modification = study.modification;
  const FlankCondition analysed = apply_effects(effects, {study.modification, {}, {}});
  for (const Member m : {Member::Pinion, Member::Wheel}) modification[m].process = analysed.modification[m].process;
  return modification;
}

EffectFacts effect_facts(const Study& study) {
  EffectFacts facts;
  facts.coupled_teeth = facts.gear_bodies = couples_teeth(study.fidelity.compliance);
  facts.root_stress = wants_root_stress(study);
  facts.helical = study.pair.helix_angle != 0.0;
  facts.rounded_tips = study.pair.pinion.tip_edge_radius() > 0.0 || study.pair.wheel.tip_edge_radius() > 0.0;
  facts.shafts = study.shaft.pinion || study.shaft.wheel;
  facts.whole_surface = study.fidelity.gap == GapModel::WholeSurface;
  for (const Scene& scene : study.scenes) {
    for (double torque : scene.torques) {
      const bool rigid = torque == 0.0 || study.fidelity.compliance == ComplianceModel::Rigid;
      (rigid ? facts.unloaded : facts.loaded) = true;
    }
  }
  facts.conditions = study.task->conditions != nullptr ? study.task->conditions(study) : conditions_of(study);
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
