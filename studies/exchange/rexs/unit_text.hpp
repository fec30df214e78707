#pragma once

#include "studies/exchange/rexs/rexs_unit.hpp"
#include "studies/exchange/rexs/study_text.hpp"

namespace flankwright::studies::rexs {

/// [pinion.shaft], [wheel.shaft] and [unit] of a study.
void write_unit(const ImportedUnit& unit, StudyText& text);

}  // namespace flankwright::studies::rexs
