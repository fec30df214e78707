#pragma once

#include <string>
#include <vector>

#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"

/// The studies of this folder, read and run as `flankwright run` does, with floating-point traps set.
namespace flankwright::hard_cases {

using Settings = std::vector<studies::Override>;

/// @param name  of the file, without .toml
studies::Study study(const std::string& name, const Settings& settings = {});
studies::StudyResults run(const std::string& name, const Settings& settings = {});

/// A value of --set.
std::string in_digits(double value);

/// Every loaded position has an answer, and it is that of the problem as it is posed: force balance with the torque, equal approach where
/// loaded, no penetration elsewhere, worked out anew from influence matrix, contact laws and gaps.
void check_balances(const studies::StudyResults& results);

/// Sum of the forces on each tooth's points at a position, relative to all [-], in the order of the teeth; 0 where it touches nowhere.
std::vector<double> shares(const MeshModel& model, const LoadedCycle& cycle, std::size_t position);

}  // namespace flankwright::hard_cases
