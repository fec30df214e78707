#pragma once

#include <string>
#include <vector>

#include "core/compliance/comparison/gear_fit.hpp"
#include "studies/base/progress.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// One gear's fit.
struct GearFit {
  Member member{Member::Pinion};
  GearFitResult result;
  bool several_teeth{true};   ///< form used
  double seconds{not_given};  ///< wall time
};
/// What the task finds: a fit for each gear.
using GearFits = std::vector<GearFit>;

/// Data of one gear of a study to be solved and fitted.
/// @throws InvalidInput  as influence_table_task()
GearFitTask gear_fit_task(const Study& study, const GearPair& pair, Member member);

/// Fits the gears that the study names, one after the other.
/// @throws InvalidInput  as gear_fit_task(), and under the study's keys where a gear cannot be meshed
GearFits fit_gears(const Study& study, const GearPair& pair, const ProgressReport& progress);

/// The requirement that is not met, in one line: finite elements that could not be factorised, or a fit that failed or did not
/// converge; empty where all was. The accuracy of a fit is no requirement, but can be made one by [expect].
std::string unmet_requirement(const GearFit& fit);

}  // namespace flankwright::studies
