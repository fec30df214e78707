#pragma once

#include <vector>

#include "studies/exchange/rexs/rexs_unit_part.hpp"
#include "studies/study/study_errors.hpp"

namespace flankwright::studies::rexs {

/// What cannot be in a part of a gear unit, each with component, value and line:
/// a gear on no shaft, where the file has several stages and others of the gears are on shafts;
/// bearings at one place on a shaft, or off its sections;
/// a shaft that one bearing or none holds, which can move as a rigid body; nothing is said where no shaft of the part has a bearing;
/// gears that overlap along their shaft, where it has sections.
/// Planetary gear sets are not checked, as planets run on their bearings.
/// @throws StudyErrors where an attribute is no number or of a wrong unit
std::vector<StudyProblem> find_defects(const Reading& reading, const UnitPart& part);

/// Of the parts around all cylindrical stages, each defect once.
std::vector<StudyProblem> find_defects(const Reading& reading);

}  // namespace flankwright::studies::rexs
