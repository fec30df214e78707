#include "core/load/discretisation.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/base/limit_estimate.hpp"

namespace flankwright {

namespace {

/// Estimates by differences are multiplied by this before they are called an error: sequences are not regular, and the largest of ten
/// figures is asked for.
constexpr double safety = 1.5;
constexpr double quadrature_share = 0.5;  ///< of the accuracy, for the intervals

/// Error of the last level by the last three; infinite where there are fewer: two may agree by chance.
PerFigure error_of_last(const std::vector<ResolutionLevel>& levels) {
  PerFigure error{};
  const std::size_t n = levels.size();
  if (n < 3) {
    error.fill(std::numeric_limits<double>::infinity());
    return error;
  }
  const CycleFigures& fine = levels[n - 1].figures;
  CycleFigures limit = fine;
  for (std::size_t i = 0; i < error.size(); ++i) {
    limit.value[i] += safety * estimate_limit(levels[n - 3].figures.value[i], levels[n - 2].figures.value[i], fine.value[i]).error;
  }
  return figure_errors(limit, fine);
}

PerFigure sum(const PerFigure& a, const PerFigure& b) {
  PerFigure both{};
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = a[i] + b[i];
  return both;
}

/// Gives every level its error by the finest one, whose own is known, and finds the coarsest within the budget; the finest where none is.
std::size_t coarsest_within(std::vector<ResolutionLevel>& levels, double budget) {
  for (ResolutionLevel& level : levels) level.error = sum(figure_errors(level.figures, levels.back().figures), levels.back().error);
  const auto enough = std::ranges::find_if(levels, [&](const ResolutionLevel& level) { return largest(level.error) <= budget; });
  return enough == levels.end() ? levels.size() - 1 : static_cast<std::size_t>(enough - levels.begin());
}

}  // namespace

PerFigure Discretisation::error() const { return sum(quadrature_error, position_error); }

Discretisation choose_discretisation(const MeshOfResolution& mesh_for, QuadratureRule rule, const FlankCondition& condition, double pinion_torque,
                                     const DiscretisationSearch& search) {
  Discretisation chosen;
  chosen.quadrature = {rule, search.fewest_intervals};
  chosen.positions = search.fewest_positions;
  const auto solve = [&](int intervals, const std::vector<double>& phases) {
    const MeshModel model = mesh_for({{rule, intervals}, phases});
    SampledCycle cycle(model, analyse_cycle(model, condition, pinion_torque));
    chosen.failures += cycle.failures();
    return cycle;
  };
  // The level before the last is within the budget: what is chosen has been held against something finer.
  const auto settled = [](std::vector<ResolutionLevel>& levels, double budget, const SampledCycle* between = nullptr) {
    ResolutionLevel& last = levels.back();
    last.error = error_of_last(levels);
    if (between) {
      CycleFigures raised = last.figures;
      const PerFigure unseen = between->unseen();
      for (std::size_t i = 0; i < unseen.size(); ++i) raised.value[i] += unseen[i];
      const PerFigure rise = figure_errors(raised, last.figures);
      for (std::size_t i = 0; i < rise.size(); ++i) last.error[i] = std::max(last.error[i], rise[i]);
    }
    if (levels.size() < 2) return false;
    return largest(sum(figure_errors(levels[levels.size() - 2].figures, last.figures), last.error)) <= budget;
  };

  if (search.choose_intervals) {
    const std::vector<double> phases = equally_spaced_phases(search.fewest_positions);
    const double budget = quadrature_share * search.accuracy;
    for (int n = search.fewest_intervals; n <= search.most_intervals; n *= 2) {
      const SampledCycle cycle = solve(n, phases);
      if (chosen.failures > 0) return chosen;
      chosen.by_intervals.push_back({n, cycle.positions(), cycle.figures()});
      if (settled(chosen.by_intervals, budget)) break;
    }
    const ResolutionLevel& level = chosen.by_intervals[coarsest_within(chosen.by_intervals, budget)];
    chosen.quadrature.intervals = level.intervals;
    chosen.quadrature_error = level.error;
  }
  if (search.choose_positions) {
    const double budget = std::max(search.accuracy - largest(chosen.quadrature_error), 0.0);
    std::optional<SampledCycle> cycle;
    for (int n = search.fewest_positions; n <= search.most_positions; n *= 2) {
      std::vector<double> phases = equally_spaced_phases(n);
      if (cycle) {
        std::vector<double> odd;
        for (std::size_t i = 1; i < phases.size(); i += 2) odd.push_back(phases[i]);
        cycle = cycle->joined(solve(chosen.quadrature.intervals, odd));
      } else {
        cycle = solve(chosen.quadrature.intervals, phases);
      }
      if (chosen.failures > 0) return chosen;
      chosen.by_positions.push_back({chosen.quadrature.intervals, n, cycle->figures()});
      if (settled(chosen.by_positions, budget, &*cycle)) break;
    }
    const ResolutionLevel& level = chosen.by_positions[coarsest_within(chosen.by_positions, budget)];
    chosen.positions = level.positions;
    chosen.position_error = level.error;
  }
  chosen.kept = largest(chosen.error()) <= search.accuracy;
  return chosen;
}

}  // namespace flankwright
