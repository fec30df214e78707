#include "core/compliance/model/compliance_model.hpp"

namespace flankwright {

const char* to_string(ComplianceModel model) {
  switch (model) {
    case ComplianceModel::Rigid:
      return "rigid";
    case ComplianceModel::ThinSlice:
      return "thin_slice";
    case ComplianceModel::Fitted:
      return "fitted";
    case ComplianceModel::Fe:
      return "fe";
  }
  __builtin_unreachable();
}

ComplianceModel compliance_model(std::string_view name) {
  for (const ComplianceModel model : {ComplianceModel::Rigid, ComplianceModel::ThinSlice, ComplianceModel::Fitted}) {
    if (name == to_string(model)) return model;
  }
  return ComplianceModel::Fe;
}

}  // namespace flankwright
