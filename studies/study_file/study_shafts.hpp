#pragma once

#include <memory>

#include "core/compliance/shaft/shaft_pair.hpp"
#include "studies/study_file/study_reading.hpp"

namespace flankwright::studies {

/// Reads what [pinion.shaft], [wheel.shaft] and [unit] leave to the rest of the study: the gear's material where the shaft has none
/// of its own, the first bearing as the one that holds axially where none does. Refuses shafts and units that cannot be.
void read_shafts(StudyReading& reading);

/// The shafts of a study as part of the influence matrix; null where it describes none.
/// @throws InvalidInput  as ShaftPair
std::shared_ptr<const ShaftPair> make_shafts(const Study& study, const GearPair& pair);

}  // namespace flankwright::studies
