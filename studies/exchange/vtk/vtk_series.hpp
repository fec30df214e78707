#pragma once

#include <string>
#include <vector>

#include "studies/base/json_format.hpp"
#include "studies/base/results_folder.hpp"

namespace flankwright::studies {

/// The loaded contact of a results folder for ParaView: for every load case a collection NAME.pvd, its time the phase of the mesh
/// position, of VTK XML files of three parts each: contact lines (.vtp, with load, stress, gap and deflections at their points), and
/// the teeth in mesh of pinion and wheel as surfaces with what is removed from them.
///
/// Housing coordinates in mm: the pinion's axis is z, x points to the wheel. Contact points lie where the undisturbed flanks
/// touch, or where a tip edge meets the mate beyond them; flanks are drawn without their deviations (micrometres would not be seen), those of
/// teeth that touch with their tip edge only are not.
///
/// @return files with their paths below the folder
/// @param results  whole_results()
/// @param file     their path, for messages
/// @throws InvalidInput where it is no results.json, or one without loaded contact
std::vector<NamedText> vtk_series(const Json& results, const std::string& file);

}  // namespace flankwright::studies
