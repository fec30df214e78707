#include "core/fidelity/discretisation.hpp"

#include <algorithm>

namespace flankwright {

namespace {

PerFigure sum(const PerFigure& a, const PerFigure& b) {
  PerFigure both{};
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = a[i] + b[i];
  return both;
}

/// A search under way; each step adds a level.
class DiscretisationRun {
 public:
  DiscretisationRun(const MeshOfResolution& mesh_for, QuadratureRule rule, const FlankCondition& condition, double torque,
                    const DiscretisationSearch& search)
      : mesh_for_(mesh_for), rule_(rule), condition_(condition), torque_(torque), search_(search) {}

  Discretisation finish() {
    int intervals = search_.fewest_intervals, positions = search_.fewest_positions;
    while (true) {
      if (!add_level(intervals, positions)) break;
      const ResolutionLevel& level = chosen_.levels.back();
      chosen_.quadrature = {rule_, intervals};
      chosen_.positions = positions;
      chosen_.quadrature_error = level.quadrature_error;
      chosen_.position_error = level.position_error;
      chosen_.kept = largest(level.error()) <= search_.accuracy;
      const bool more_intervals = search_.choose_intervals && 2 * intervals <= search_.most_intervals;
      const bool more_positions = search_.choose_positions && 2 * positions <= search_.most_positions;
      if (chosen_.kept || !(more_intervals || more_positions)) break;
      const bool by_points = largest(level.quadrature_error) >= largest(level.position_error);
      (more_intervals && (by_points || !more_positions) ? intervals : positions) *= 2;
    }
    return std::move(chosen_);
  }

 private:
  bool add_level(int intervals, int positions) {
    const std::vector<double> phases = equally_spaced_phases(positions);
    const MeshModel model = mesh_for_({{rule_, intervals}, phases});
    const LoadedCycle cycle = analyse_cycle(model, condition_, torque_, {}, {}, RootStresses::Later);
    const MeshModel coarse_model = mesh_for_({{rule_, std::max(1, intervals / 2)}, coarse_phases(phases)});
    const LoadedCycle coarse = analyse_cycle(coarse_model, condition_, torque_, {}, {}, RootStresses::Later);
    chosen_.failures += cycle.failures + coarse.failures;
    if (chosen_.failures > 0) return false;
    const MeshWithParameters at = [&](const std::vector<double>& some, const std::vector<MeshParameter>&) { return mesh_for_({{rule_, intervals}, some}); };
    const ResolvedCycle resolved =
        resolve_cycle(model, cycle, at, condition_, torque_, {.seek_extremes = rule_ == QuadratureRule::Graded, .coarse = &coarse});
    ResolutionLevel level{intervals, positions, figures_of(model, cycle, resolved.summary)};
    if (search_.choose_intervals) level.quadrature_error = error_shares(resolved.error_parts.points, level.figures);
    if (search_.choose_positions) level.position_error = error_shares(resolved.error_parts.positions, level.figures);
    chosen_.levels.push_back(level);
    return true;
  }

  const MeshOfResolution& mesh_for_;
  const QuadratureRule rule_;
  const FlankCondition& condition_;
  const double torque_;
  const DiscretisationSearch& search_;
  Discretisation chosen_;
};

}  // namespace

PerFigure ResolutionLevel::error() const { return sum(quadrature_error, position_error); }

PerFigure Discretisation::error() const { return sum(quadrature_error, position_error); }

CycleFigures figures_of(const MeshModel& model, const LoadedCycle& cycle, const CycleSummary& summary) {
  CycleFigures figures = SampledCycle(model, cycle).figures();
  figures[Figure::TePeakToPeak] = summary.te_peak_to_peak;
  figures[Figure::PeakContactStress] = summary.peak_contact_stress;
  figures[Figure::PeakLineLoad] = summary.peak_line_load;
  figures[Figure::LoadFactor] = summary.load_factor;
  return figures;
}

PerFigure error_shares(const CycleErrors& errors, const CycleFigures& figures) {
  CycleFigures moved = figures;
  moved[Figure::TeMean] += errors.te_mean;
  moved[Figure::TePeakToPeak] += errors.te_peak_to_peak;
  for (std::size_t k = 0; k < std::min<std::size_t>(figure_harmonics, errors.te_harmonics.size()); ++k) {
    moved.value[static_cast<std::size_t>(Figure::TeHarmonic1) + k] += errors.te_harmonics[k];
  }
  moved[Figure::PeakContactStress] += errors.peak_contact_stress;
  moved[Figure::PeakLineLoad] += errors.peak_line_load;
  moved[Figure::LoadFactor] += errors.load_factor;
  return figure_errors(moved, figures);
}

Discretisation choose_discretisation(const MeshOfResolution& mesh_for, QuadratureRule rule, const FlankCondition& condition, double pinion_torque,
                                     const DiscretisationSearch& search) {
  return DiscretisationRun(mesh_for, rule, condition, pinion_torque, search).finish();
}

}  // namespace flankwright
