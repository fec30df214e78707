#include "studies/gear_structures.hpp"

#include "core/compliance/fitted/refined_compliance.hpp"
#include "core/compliance/fitted/refinement_library.hpp"

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

namespace {

/// A coarse table, completed from the library of fits.
std::shared_ptr<const FlankCompliance> refined_by_fits(const InfluenceTableTask& task,
                                                       std::shared_ptr<const InfluenceTable> coarse) {
  const GearFacts facts = facts_of(task.gear);
  return std::make_shared<const RefinedCompliance>(std::move(coarse), facts,
                                                   RefinementLibrary::shipped().coefficients(facts));
}

}  // namespace

GearStructures gear_structures(const Study& study, const GearPair& pair, const ProgressReport& progress) {
  GearStructures structures;
  const bool is_structural = couples_teeth(study.fidelity.compliance);
  if (!is_structural && !wants_root_stress(study)) return structures;
  structures.finite_elements = solve_finite_elements(study, pair, progress);
  const GearRun& pinion = (*structures.finite_elements)[Member::Pinion];
  const GearRun& wheel = (*structures.finite_elements)[Member::Wheel];
  if (is_structural) {
    const auto compliance = [&](Member member, const GearRun& run) -> std::shared_ptr<const FlankCompliance> {
      if (study.fidelity.compliance == ComplianceModel::Fe) return run.table;
      return refined_by_fits(influence_table_task(study, pair, member), run.table);
    };
    structures.pair = std::make_shared<const StructuralPair>(
        pair, GearStructure{compliance(Member::Pinion, pinion), study.pinion_material.youngs_modulus},
        GearStructure{compliance(Member::Wheel, wheel), study.wheel_material.youngs_modulus});
  }
  if (pinion.root_stress) {
    structures.root_stress = std::make_shared<const TabulatedRootStress>(pair, pinion.root_stress, wheel.root_stress);
  }
  return structures;
}

}  // namespace flankwright::studies
