#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/fidelity/resolved_cycle.hpp"
#include "optimize/design/design_task.hpp"

namespace flankwright {

/// Value of a smooth function of the design and its gradient with respect to the design variables [per mm].
struct SmoothValue {
  double value{not_given};
  Eigen::VectorXd gradient;
};

/// A smooth function whose maximum over all candidates is an output: the stress at one contact point or one place of a
/// fillet at one position, the difference of f_t between two positions, one of harmonic_directions projections of a harmonic's
/// phasor, or an output that is smooth itself. Smooth while the points keep their contact.
///
/// A harmonic's amplitude |c| has a kink where c passes through zero; Re(c e^(-i theta)) has none. The projections' largest is |c| at
/// c = 0 and less than 0.5 % below it elsewhere; there the amplitude itself, exact and smooth, is a candidate as well (whole_output).
struct PeakCandidate {
  int position{-1};  ///< index into the cycle; -1 for a harmonic or a smooth output
  int other{-1};     ///< contact point, place of a fillet, second position of a difference, or direction; -1: the whole output

  auto operator<=>(const PeakCandidate&) const = default;
};

inline constexpr int harmonic_directions = 32;  ///< cos(pi / 32) = 0.9952
inline constexpr PeakCandidate whole_output{-1, -1};

/// Value of an output: the largest of its candidates.
/// @throws std::runtime_error where the cycle is not usable(): a solver survives and counts it
double output_value(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle);

/// The same with extremes between the positions, and its estimated error, inside unit; the error is NaN where none was estimated. What
/// has no figure of its own in a summary is that of the positions.
struct ResolvedValue {
  double value{not_given}, error{not_given};
};
ResolvedValue resolved_value(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle, const ResolvedCycle& resolved);

/// Candidates whose value is at least (1 - margin) of the output's, largest first (ties by position), at most `most`.
/// A harmonic's are its directions, all of them; with margin 0 the amplitude itself.
/// @param margin  0 keeps the peak only
std::vector<PeakCandidate> leading_candidates(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle,
                                              double margin, std::size_t most);

/// Value and exact gradient of one candidate; the gradient stays empty where the cycle carries no derivatives. At a harmonic's
/// zero, where the amplitude (whole_output) has a kink, its gradient is 0, one of its subgradients.
SmoothValue candidate_value(const ObjectiveTerm& term, const PeakCandidate& candidate, const MeshModel& model,
                            const LoadedCycle& cycle);

}  // namespace flankwright
