#pragma once

#include <string>
#include <vector>

#include "core/flank/modifications/modification.hpp"
#include "core/gear/gear_pair.hpp"
#include "studies/results/drawn_flank.hpp"

namespace flankwright::studies {

/// What is written on the drawing of a flank: the amounts of the flank as it is ground, with what its process brings, the tolerances of amounts where
/// study or class give any and whether they were cut off at 0, diameters and roll lengths, the opposite flank where it is tied to this one, and the tolerances of the class.
///
/// The process brings a profile slope and a profile crowning at mid face and a twist, from what make_natural_twist_field() adds between the start of the
/// active profile, its middle in roll length and the tip. In the middle of the profile the lead is as asked for, see ContactShift.
/// @param t  of the class in `terms`
std::vector<std::string> drawing_lines(const GearPair& pair, Member member, const Modification& modification, const FlankTolerances& t,
                                       const DrawingTerms& terms);

}  // namespace flankwright::studies
