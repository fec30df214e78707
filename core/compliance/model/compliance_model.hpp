#pragma once

#include <string_view>

namespace flankwright {

/// Models of a pair's structural compliance, from the coarsest to the finest.
enum class ComplianceModel { Rigid, ThinSlice, Fitted, Fe };

/// "rigid", "thin_slice", "fitted", "fe".
const char* to_string(ComplianceModel model);
/// The model of one of these names.
ComplianceModel compliance_model(std::string_view name);

/// Whether the model couples teeth and has the gear's body; such models solve finite elements.
inline bool couples_teeth(ComplianceModel model) { return model == ComplianceModel::Fitted || model == ComplianceModel::Fe; }

}  // namespace flankwright
