#pragma once

#include <string>

#include "studies/exchange/rexs/rexs_modification.hpp"

namespace flankwright::studies::rexs {

/// [pinion.modification] or [wheel.modification] of a study.
/// @param grid_file  name under which the grid will be stored; not used where there is none
void write_modification(const ImportedModification& modification, Member member, const std::string& grid_file, StudyText& text);

}  // namespace flankwright::studies::rexs
