#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/fidelity/resolved_cycle.hpp"
#include "optimize/design/outputs/design_output.hpp"

namespace flankwright {

/// Value of an output: the largest of its candidates, or the least where the row says so; the reciprocal of that where the term means it.
/// @throws std::runtime_error where the cycle is not usable(): a solver counts it and goes on
double output_value(const ObjectiveTerm& term, const LoadedScene& scene);

/// The same with extremes between the positions, and its estimated error, inside unit; the error is NaN where none was
/// estimated. Outputs without a figure in the summary are those of the positions and, of film and temperatures, of the extremes between.
struct ResolvedValue {
  double value{not_given}, error{not_given};
};
ResolvedValue resolved_value(const ObjectiveTerm& term, const LoadedScene& scene, const ResolvedCycle& resolved);

/// The load case at its extremes between the positions, where an output of film or temperature has its value there; nothing where it has it at a position.
std::optional<LoadedScene> between_positions(const ObjectiveTerm& term, const LoadedScene& scene, const ResolvedCycle& resolved);

/// Candidates whose value is at least (1 - margin) of the output's, largest first (equals by position), at most `most`; of an output that is the
/// least of them those up to (1 + margin), least first.
/// A harmonic's are its directions, all of them; with margin 0 the amplitude itself.
/// @param margin  0 keeps the peak only; of a reciprocal < 1
std::vector<PeakCandidate> leading_candidates(const ObjectiveTerm& term, const LoadedScene& scene, double margin, std::size_t most);

/// The candidate that takes a candidate's place in another mesh at the same positions. A harmonic's direction and a difference of positions stay. Of
/// points, which differ between meshes, it is the leading one at that position, or of all positions where none there comes near the output's value.
/// @param scene  of the other mesh
PeakCandidate counterpart(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene);

/// Value and exact gradient of one candidate; the gradient stays empty where the cycle carries no derivatives. At a harmonic's
/// zero, where the amplitude (whole_output) has a kink, its gradient is 0, one of its subgradients.
SmoothValue candidate_value(const ObjectiveTerm& term, const PeakCandidate& candidate, const LoadedScene& scene);

}  // namespace flankwright
