#pragma once

#include <string>
#include <vector>

#include "core/flank/modifications/modification.hpp"
#include "core/gear/flank_tolerances.hpp"
#include "core/gear/gear_pair.hpp"
#include "studies/analysis/study_results.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// One measured line of a flank: its deviation along it.
struct FlankTrace {
  double at{not_given};           ///< z of a profile trace, radius of a helix trace [mm]
  std::vector<double> along;      ///< roll length from the base circle of a profile trace, z of a helix trace [mm]
  std::vector<double> deviation;  ///< along the transverse base tangent, + = metal added: modifications are negative [mm]
};

/// What a drawing says of one gear's flank: the design traces, three profiles over the face and three helices over the depth, with the band of
/// a tolerance class about the middle ones (K-chart). ISO 1328-1:2013 defines a total deviation as the distance of two facsimiles of the design
/// trace that enclose the measured one: the band is the design trace +- half of F_alphaT or F_betaT.
struct FlankDrawing {
  std::string gear;
  int tolerance_class{0};
  FlankTolerances tolerances;
  std::vector<FlankTrace> profiles;  ///< at -0.4 b, 0 and 0.4 b; from the start of the active profile to the tip
  std::vector<FlankTrace> helices;   ///< at 0.1, 0.5 and 0.9 of the active depth
  std::vector<std::string> lines;    ///< amounts and tolerances, as text
};

/// @throws InvalidInput where ISO 1328-1 does not cover the gear
FlankDrawing make_drawing(const GearPair& pair, Member member, const Modification& modification, int tolerance_class);

/// The sheet: both K-charts and the lines beside them, a picture of its own.
std::string drawing_svg(const FlankDrawing& drawing);

/// Both gears' drawings of what is to be ground, where the study names a class.
std::vector<FlankDrawing> drawings_of(const StudyResults& results);

/// An entry of `drawing` in results.json: traces, band widths and the sheet.
Json drawing_json(const FlankDrawing& drawing);

}  // namespace flankwright::studies
