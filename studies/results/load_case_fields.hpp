#pragma once

#include <string>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// The columns by which every table names a load case. The bin counts the loads of a spectrum from 0, because two of them may have one torque. It is empty without a spectrum.
inline constexpr const char* load_case_columns = "scene,torque_Nm,design,bin";

/// These fields of one load case, without a comma behind them.
std::string load_case_fields(const LoadedResult& loaded);

}  // namespace flankwright::studies
