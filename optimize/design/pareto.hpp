#pragma once

#include <functional>
#include <string>
#include <vector>

#include "optimize/design/between_positions.hpp"
#include "optimize/design/design_optimiser.hpp"
#include "optimize/design/resolved_design.hpp"

namespace flankwright {

/// One compromise between several objectives.
struct ParetoPoint {
  Eigen::VectorXd x;           ///< scaled design
  std::vector<double> values;  ///< of the objectives, outside units
  SolverStatus status{SolverStatus::NotRun};
  double constraint_violation{not_given};  ///< [-]
  std::vector<double> errors{};  ///< estimated discretisation errors of the values, NaN where none was estimated; empty before resolve_front()
  bool dominated{false};         ///< another point is no worse in every objective and better in one, beyond `same`
  std::vector<double> constraint_values{}, modification_values{};  ///< as DesignReport's; empty before resolve_front()
};

/// Designs whose objectives cannot be improved without loss in another.
struct ParetoFront {
  std::vector<Objective> objectives;
  std::vector<ParetoPoint> points;  ///< of two objectives along the front, from the best of the first to the best of the second
  std::vector<double> ideal,
      worst;  ///< per objective over the points where each one alone is best, outside units; empty where the budget left one out
  int evaluations{0}, failures{0};
  double seconds{not_given};
  std::string message;      ///< why there are fewer points than wanted, or what was not sought; empty: nothing is missing
  bool ended_early{false};  ///< the budget left points out

  static constexpr double same = 1e-4;  ///< of an objective's range [-]
  /// Longest over shortest distance between neighbours of a front of two objectives, scaled to their ranges; 1 is even;
  /// NaN below 3 points.
  double unevenness() const;

  /// The point where an objective alone is best: of two the ends, of three one of the first three.
  ParetoPoint& anchor(std::size_t objective);
  /// Sets ideal and worst from the points where one objective alone is best.
  void choose_ranges();
  /// Worst less ideal, > 0.
  double range(std::size_t objective) const;
  /// A point's values, 0 at ideal and 1 at worst.
  Eigen::VectorXd normalised(const ParetoPoint& point) const;
  /// Sets ParetoPoint::dominated. A point beyond a limit dominates none that keeps it.
  void mark_dominated();
};

/// Traces a front: each objective alone first, from options.starts, from the known designs and from the others' best, every other held to the
/// least value that allows it; then compromises
///
///     minimise tau   subject to   (goal_i(x) - ideal_i) / range_i - a_i <= tau         [Pascoletti, Serafini, JOTA 42 (1984)]
///
/// from reference points a. With two objectives a is the middle of the widest gap between neighbours so far; then the
/// points between the ends are sought once more from equal steps of arc length along the front found, where that makes
/// the spacing more even. With three, the points a are a regular grid on the triangle of the single optima. Each search
/// starts from the nearest design found before, and each compromise is sought once more from the designs of its neighbours.
/// @param objectives    two or three
/// @param points   >= number of objectives; for three the largest triangular number within it
/// @param options  a solver that takes gradients and constraints; its budget is that of the whole front
/// @param known    scaled designs from which each objective is sought as well, such as an optimum found before
/// @throws InvalidInput for another number of objectives, or an unsuitable solver
ParetoFront trace_front(const DesignProblem& problem, const std::vector<Objective>& objectives, int points, const DesignOptions& options,
                        const std::vector<Eigen::VectorXd>& known = {});
inline ParetoFront trace_front(const DesignProblem& problem, const std::vector<Objective>& objectives, int points, const SolverOptions& options) {
  return trace_front(problem, objectives, points, DesignOptions{options});
}

/// FurtherError of a design by its resolved cycles, one a scene.
using FurtherErrorsOf = std::function<FurtherError(const DesignAnalysis&, const std::vector<ResolvedCycle>&)>;

/// Gives the points of a front their values with the extremes between positions, as the designs before and after an optimisation have them, and judges anew which
/// are dominated and which exceed a limit. The designs stay where they are, but a known one takes the place of the best of an objective that it is below.
/// @param asked  the constraints of the task with the limits asked for, by which points are judged; those of the problem may be tighter
/// @param known  scaled designs, as for trace_front()
/// @param further_errors_of  nothing: what resolved cycles do not state is not estimated
void resolve_front(const DesignProblem& problem, const std::vector<OutputConstraint>& asked, const DesignResolver& resolve,
                   const std::vector<Eigen::VectorXd>& known, ParetoFront& front, const FurtherErrorsOf& further_errors_of = {});

}  // namespace flankwright
