#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimize/design_task.hpp"

namespace flankwright {

/// Value of a smooth function of the design and its gradient with respect to the design variables [per mm].
struct SmoothValue {
  double value{not_given};
  Eigen::VectorXd gradient;
};

/// A smooth function whose maximum over all candidates is an output: the stress at one contact point or one place of a
/// fillet at one position, the difference of f_t between two positions, or a harmonic itself. Smooth while the points keep
/// their contact.
struct PeakCandidate {
  int position{-1};  ///< index into the cycle; -1 for a harmonic
  int other{-1};     ///< contact point, place of a fillet, or the second position of a difference

  auto operator<=>(const PeakCandidate&) const = default;
};

/// Value of an output: the largest of its candidates.
/// @throws std::runtime_error where the cycle is not usable(): a solver survives and counts it
double output_value(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle);

/// Candidates whose value is at least (1 - margin) of the output's, largest first (ties by position), at most `most`.
/// @param margin  0 keeps the peak only
std::vector<PeakCandidate> leading_candidates(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle,
                                              double margin, std::size_t most);

/// Value and exact gradient of one candidate; the gradient stays empty where the cycle carries no derivatives. At a harmonic's
/// zero, where the amplitude has a kink, the gradient is 0, one of its subgradients.
SmoothValue candidate_value(const ObjectiveTerm& term, const PeakCandidate& candidate, const MeshModel& model,
                            const LoadedCycle& cycle);

}  // namespace flankwright
