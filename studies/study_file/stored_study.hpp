#pragma once

#include <string>
#include <vector>

#include "studies/base/json_format.hpp"
#include "studies/study/study.hpp"
#include "studies/study_file/override.hpp"

namespace flankwright::studies {

/// Which flanks of a results folder: those of the study file, or what an optimisation made of them.
enum class StoredFlanks { Final, Given };

/// What an optimisation made of the modifications: its variables and those tied to them, in the units of their keys; nothing of another task.
/// @throws nlohmann::json::exception  where the document is none of this program's
std::vector<Override> final_modifications(const Json& results);

/// Pair, flanks, material, torques and scenes of a study that has run, from `given` of its results.json; Final: with the variables
/// that an optimisation ended at. Task, fidelity, errors of teeth and shafts are left out, so that nothing is needed but the grids.
///
/// @param results  whole_results()
/// @param file     their path, for messages
/// @throws InvalidInput where it is none of this program's, StudyErrors where a grid that the study names is no longer there
Study stored_study(const Json& results, const std::string& file, StoredFlanks flanks);

}  // namespace flankwright::studies
