#pragma once

#include <string>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// load_factors.csv: K_Hbeta, K_Halpha, K_H of every load case by each definition, four rows a case: by contact stress without spikes and with
/// spikes, by line loads without spikes, by ISO 6336.
std::string load_factors_csv(const StudyResults& results);

/// load_sharing.csv: every tooth's share of the force at every position.
std::string load_sharing_csv(const StudyResults& results);

/// The same factors as load_factors.csv, for reading; empty where no case was rated.
/// @param width  of the first column
std::string load_factors_table(const StudyResults& results, std::size_t width);

}  // namespace flankwright::studies
