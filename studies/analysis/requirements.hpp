#pragma once

#include <optional>
#include <string>

#include "studies/analysis/study_results.hpp"

namespace flankwright::studies {

/// Adds to the requirements that were not met (exit code 1), one line each: load cases in which nothing touches, or whose loads did not converge.
void add_unmet_by_load_cases(StudyResults& results);

/// How far shafts and bearings move the flanks of the pair and of the unit's other meshes in a load case, in the plane of action [mm]. Teeth cannot mesh over more than the limit:
///
/// - of the misalignment over the common face a normal module, which is half the working depth of usual teeth,
/// - of the motion at mid face the working depth, r_a1 + r_a2 - a. Beyond it the teeth no longer reach each other.
struct FlankMotion {
  std::string mesh;      ///< "the pair", or the name of another mesh
  bool is_misalignment;  ///< else the motion at mid face
  double motion, limit;  ///< [mm], >= 0, > 0
  double excess() const { return motion / limit; }
};

/// The largest of them over its limit; nothing without shafts, or where the load distribution is not known.
std::optional<FlankMotion> largest_flank_motion(const StudyResults& results, const LoadedResult& loaded);

/// Adds the load case in which shafts and bearings move flanks most, where that is more than teeth can mesh over.
void add_unmet_by_shafts(StudyResults& results);

}  // namespace flankwright::studies
