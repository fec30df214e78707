#include "studies/gear_structures.hpp"

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
  const bool is_fe = study.fidelity.compliance == ComplianceModel::Fe;
  if (!is_fe && !wants_root_stress(study)) return structures;
  structures.finite_elements = solve_finite_elements(study, pair, progress);
  const GearRun& pinion = (*structures.finite_elements)[Member::Pinion];
  const GearRun& wheel = (*structures.finite_elements)[Member::Wheel];
  if (is_fe) {
    structures.pair = std::make_shared<const StructuralPair>(
        pair, GearStructure{pinion.table, study.pinion_material.youngs_modulus},
        GearStructure{wheel.table, study.wheel_material.youngs_modulus});
  }
  if (pinion.root_stress) {
    structures.root_stress = std::make_shared<const TabulatedRootStress>(pair, pinion.root_stress, wheel.root_stress);
  }
  return structures;
}

}  // namespace flankwright::studies
