#pragma once

#include <optional>

#include "studies/exchange/rexs/rexs_stage.hpp"
#include "studies/exchange/rexs/study_text.hpp"

namespace flankwright::studies::rexs {

/// [lubricant]: the oil that is related to the stage, the casing or the gear unit, or the only one of the file, with its viscosities at 40 and 100 deg C
/// and its density. The roughness is the mean of both gears' flanks; where the file has none, that of ground flanks is taken and reported. A
/// lubricant without viscosities or temperature, and one that is no oil, is left out with the reason.
/// @param temperature  of the oil [deg C]
/// @throws StudyErrors where an attribute is no number or of a wrong unit
void write_lubricant(Reading& reading, const StageParts& parts, const std::optional<Taken>& temperature, StudyText& text);

}  // namespace flankwright::studies::rexs
