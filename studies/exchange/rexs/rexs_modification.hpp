#pragma once

#include <string>

#include "core/gear/gear_pair.hpp"
#include "core/flank/modifications/modification.hpp"
#include "studies/exchange/rexs/rexs_pair.hpp"

namespace flankwright::studies::rexs {

/// End of the face at which a positive helix_slope removes material. The format does not say; programs differ.
enum class SlopeEnd { NonDatumFace, DatumFace };

/// The modification of one gear's working flank.
struct ImportedModification {
  Modification modification;  ///< without topography
  Remarks remarks;            ///< by key below [pinion.modification]
  std::string grid;           ///< measurement grid (see grid_file.hpp) of a topographical_modification; empty: none
};

/// Reads the modifications of a flank, states them in the terms of Modification, and warns of all that these cannot say.
///
/// Amounts of the format are taken as material removed along the transverse base tangent, crownings and slopes as those of the whole
/// flank where no range is given; a slope or crowning of another range is carried on to the borders of the flank.
/// @throws StudyErrors where an attribute is no number or of a wrong unit
ImportedModification read_modification(Reading& reading, const GearParts& parts, const GearPair& pair, Member member, SlopeEnd slope_end);

}  // namespace flankwright::studies::rexs
