#include "studies/compliance/gear_structures.hpp"

namespace flankwright::studies {

const char* to_string(ComplianceModel model) {
  switch (model) {
    case ComplianceModel::Rigid: return "rigid";
    case ComplianceModel::ThinSlice: return "thin_slice";
    case ComplianceModel::Fitted: return "fitted";
    case ComplianceModel::Fe: return "fe";
  }
  __builtin_unreachable();
}

ComplianceModel compliance_model(std::string_view name) {
  for (const ComplianceModel model : {ComplianceModel::Rigid, ComplianceModel::ThinSlice, ComplianceModel::Fitted}) {
    if (name == to_string(model)) return model;
  }
  return ComplianceModel::Fe;
}

GearStructures gear_structures(const Study& study, const GearPair& pair, const ProgressReport& progress) {
  GearStructures structures;
  const bool is_structural = couples_teeth(study.fidelity.compliance);
  if (!is_structural && !wants_root_stress(study)) return structures;
  structures.finite_elements = solve_finite_elements(study, pair, progress);
  FiniteElementRuns& runs = *structures.finite_elements;
  if (is_structural) {
    const auto structure = [&](Member member, const Material& material) {
      GearStructure result{runs[member].table, material.youngs_modulus};
      if (const auto& rigid = runs.rigid_body_run(member)) result.on_rigid_body = rigid->table;
      if (study.fidelity.compliance == ComplianceModel::Fitted) {
        auto& refinement = structures.refinements[member == Member::Pinion ? 0 : 1];
        refinement = gear_refinement(study, influence_table_task(study, pair, member), runs, member, runs.notes, progress);
        result.compliance = refinement->compliance;
        if (result.on_rigid_body) result.on_rigid_body = refinement->completed(result.on_rigid_body);
      }
      return result;
    };
    const GearStructure pinion = structure(Member::Pinion, study.pinion_material);
    const GearStructure wheel = structure(Member::Wheel, study.wheel_material);
    structures.pair = std::make_shared<const StructuralPair>(pair, pinion, wheel);
  }
  if (const auto& pinion = runs.root_stress(Member::Pinion)) {
    structures.root_stress = std::make_shared<const TabulatedRootStress>(pair, pinion, runs.root_stress(Member::Wheel));
  }
  return structures;
}

}  // namespace flankwright::studies
