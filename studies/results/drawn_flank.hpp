#pragma once

#include <string>
#include <vector>

#include "core/gear/flank_tolerances.hpp"

namespace flankwright::studies {

/// One measured line of a flank: its deviation along it, and the band about it that a gear may fill.
struct FlankTrace {
  double at{not_given};           ///< z of a profile trace, radius of a helix trace [mm]
  std::vector<double> along;      ///< roll length from the base circle of a profile trace, z of a helix trace [mm]
  std::vector<double> deviation;  ///< along the transverse base tangent, + = metal added: modifications are negative [mm]
  std::vector<double> low, high;  ///< ends of the band, as `deviation` [mm]
};

/// By how much a number of a modification may differ from its design.
struct AmountTolerance {
  std::string key;                         ///< of ModificationDescriptor
  double low{not_given}, high{not_given};  ///< least and largest difference, low <= high [mm; parabolic_te 1/rad]
};

/// What a drawing of one gear's flank is made for.
struct DrawingTerms {
  int tolerance_class{0};                  ///< of ISO 1328-1:2013
  std::vector<AmountTolerance> amounts{};  ///< tolerances that the study gives beside the class
  GrindingProcess process{};               ///< that finishes the flanks, with the compensation of its twist that the design needs
  bool ties_flanks{false};                 ///< the opposite flank has what the same tool leaves there in the same setting, see on_opposite_flank()
};

/// What a drawing says of one gear's flank: the design traces, three profiles over the face and three helices over the depth, each with its own band
/// (K-chart). ISO 1328-1:2013 defines a total deviation as the distance of two facsimiles of the design trace that enclose the measured one: the band is
/// the design trace +- half of F_alphaT or F_betaT. The tolerance of an amount widens it by what that amount may remove more or less there.
struct FlankDrawing {
  std::string gear;
  int tolerance_class{0};
  FlankTolerances tolerances;
  std::vector<FlankTrace> profiles;  ///< at -0.4 b, 0 and 0.4 b; from the start of the active profile to the tip
  std::vector<FlankTrace> helices;   ///< at 0.1, 0.5 and 0.9 of the active profile, in roll length
  double base_radius{not_given};     ///< r_b, between roll lengths and diameters [mm]
  std::vector<std::string> lines;    ///< amounts and tolerances, as text
};

}  // namespace flankwright::studies
