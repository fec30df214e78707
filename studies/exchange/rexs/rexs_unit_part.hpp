#pragma once

#include <set>
#include <string>

#include "studies/exchange/rexs/rexs_stage.hpp"

namespace flankwright::studies::rexs {

/// The part of a gear unit that turns with a stage: what meshes, shafts and bearings between shafts join to it. Ids of components.
struct UnitPart {
  std::set<int> gears, shafts;
};
/// @param stage  a stage of the file
UnitPart part_around(const Reading& reading, const Component& stage);

/// Whether a stage is to be read with the unit around it: its gears have other meshes, or its shafts carry other gears or run in other shafts. Where
/// only its own shafts lack sections, that is said.
bool is_in_unit(Reading& reading, const StageParts& parts);

}  // namespace flankwright::studies::rexs
