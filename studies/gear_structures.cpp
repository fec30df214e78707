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

std::shared_ptr<const PairCompliance> gear_structures(const Study& study, const GearPair&, const ProgressReport&) {
  switch (study.fidelity.compliance) {
    case ComplianceModel::Rigid:
    case ComplianceModel::ThinSlice:
    case ComplianceModel::Fitted:
    case ComplianceModel::Fe: return nullptr;
  }
  __builtin_unreachable();
}

}  // namespace flankwright::studies
