#pragma once

#include <functional>
#include <vector>

#include "core/fidelity/resolved_cycle.hpp"

namespace flankwright {

/// The same mesh as finely as one likes.
using MeshOfResolution = std::function<MeshModel(const MeshResolution&)>;

/// What a resolution shows, and how sure it is.
struct ResolutionLevel {
  int intervals{0}, positions{0};
  CycleFigures figures;  ///< with extremes between the positions
  PerFigure quadrature_error{}, position_error{};  ///< estimated shares, as figure_errors() counts them
  PerFigure error() const;                         ///< their sum
};

struct DiscretisationSearch {
  /// Refined until ResolutionLevel::error() <= accuracy, of every figure [-], > 0.
  double accuracy{0.01};
  int fewest_intervals{6}, most_intervals{96};    ///< powers of two times the fewest; half of them must still say something
  int fewest_positions{16}, most_positions{256};  ///< powers of two times the fewest, >= 12
  bool choose_intervals{true}, choose_positions{true};  ///< false: the fewest stand, and count as exact
};

/// Points and positions that keep an accuracy, and the evidence.
struct Discretisation {
  Quadrature quadrature;
  int positions{0};
  PerFigure quadrature_error{}, position_error{};  ///< estimated shares at these; 0 of what was not to be chosen
  std::vector<ResolutionLevel> levels;  ///< what was solved, coarse to fine
  bool kept{false};       ///< error() <= accuracy
  int failures{0};        ///< positions without a usable load distribution; the search ends there

  PerFigure error() const;
};

/// Cheapest resolution of one load case whose estimated error is within an accuracy: a cycle and its embedded comparison
/// (estimate_errors()), refined by doubling what brings most of the largest error, intervals or positions, until the accuracy is kept. As a
/// level costs a multiple of the one before, all of them together cost less than two and a half of the last.
Discretisation choose_discretisation(const MeshOfResolution& mesh_for, QuadratureRule rule, const FlankCondition& condition, double pinion_torque,
                                     const DiscretisationSearch& search = {});

/// Figures of a resolved cycle, in the order of Figure.
CycleFigures figures_of(const MeshModel& model, const LoadedCycle& cycle, const CycleSummary& summary);
/// Estimated errors as shares, as figure_errors() counts them.
PerFigure error_shares(const CycleErrors& errors, const CycleFigures& figures);

}  // namespace flankwright
