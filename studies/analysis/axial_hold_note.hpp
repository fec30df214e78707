#pragma once

#include <string>
#include <vector>

#include "studies/study/study.hpp"

namespace flankwright::studies {

/// Shafts under axial forces, of a helical mesh or of a load, that no given bearing holds along their axis, a note for each: which bearing holds them rigidly instead, as the
/// defaults have it. @pre the study was read, see read_shafts()
std::vector<std::string> axial_hold_notes(const Study& study);

}  // namespace flankwright::studies
