#pragma once

#include <string_view>

namespace flankwright {

/// How the structure of a pair yields, from the coarsest model to the finest.
enum class ComplianceModel { Rigid, ThinSlice, Fitted, Fe };

/// "rigid", "thin_slice", "fitted", "fe".
const char* to_string(ComplianceModel model);
/// The model of one of these names.
ComplianceModel compliance_model(std::string_view name);

/// Whether the model knows how a load on one tooth moves another, and the gear's body: both solve finite elements.
inline bool couples_teeth(ComplianceModel model) { return model == ComplianceModel::Fitted || model == ComplianceModel::Fe; }

}  // namespace flankwright
