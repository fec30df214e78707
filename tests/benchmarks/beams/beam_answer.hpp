#pragma once

#include <filesystem>
#include <vector>

#include "tests/benchmarks/beams/beam_cases.hpp"

namespace flankwright::beam_truth {

struct BeamAnswer {
  bool solved{false};
  int elements{0};                 ///< of CalculiX
  std::vector<double> deflection;  ///< along x at the stations [mm]
  std::vector<double> reaction;    ///< along x on the shaft at the supports [N]
};

/// The project's beams: BeamSystem of shaft_pieces().
BeamAnswer own_answer(const BeamCase& of);

/// CalculiX' beam elements of three nodes (B32), which it expands to bricks of 20 nodes. The section's two dimensions are its diameters. Supports and the force
/// act at nodes on the axis, where CalculiX holds the translations of the section's middle. A rotation that is held at such a node would hold the bending as
/// well, so the turn about the axis is held by a short arm across the last end, whose tip does not move along y: there no force arises. Where sections of two
/// diameters meet, CalculiX joins them rigidly.
/// @param length  of an element over the diameter, at most [-]
BeamAnswer run_calculix(const BeamCase& of, double length, const std::filesystem::path& folder);

/// The largest difference between two answers' deflections over the largest deflection, and the same of reactions [-].
struct BeamDifference {
  double deflection, reaction;
};
BeamDifference difference(const BeamAnswer& one, const BeamAnswer& other);

}  // namespace flankwright::beam_truth
