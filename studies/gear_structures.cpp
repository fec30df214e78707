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
  switch (study.fidelity.compliance) {
    case ComplianceModel::Rigid:
    case ComplianceModel::ThinSlice:
    case ComplianceModel::Fitted: return {};
    case ComplianceModel::Fe: {
      FiniteElementRuns runs = solve_finite_elements(study, pair, progress);
      auto structure = std::make_shared<const StructuralPair>(
          pair, GearStructure{runs[Member::Pinion].table, study.pinion_material.youngs_modulus},
          GearStructure{runs[Member::Wheel].table, study.wheel_material.youngs_modulus});
      return {std::move(structure), std::move(runs)};
    }
  }
  __builtin_unreachable();
}

}  // namespace flankwright::studies
