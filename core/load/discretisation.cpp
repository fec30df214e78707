#include "core/load/discretisation.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/limit_estimate.hpp"

namespace flankwright {

namespace {

/// Differences and estimates by differences are multiplied by this before they are called an error: sequences are not regular, and the
/// largest of ten figures is asked for.
constexpr double safety = 1.5;
constexpr double quadrature_share = 0.5;  ///< of the accuracy, for the intervals
/// An estimate of more than this many times the difference that was measured is held against one more level.
constexpr double most_over_measured = 3.0;
/// No estimate is more than this many times the difference from both doubled: from a first order on, twice that difference is the error.
constexpr double most_over_doubled = 5.0;

PerFigure sum(const PerFigure& a, const PerFigure& b) {
  PerFigure both{};
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = a[i] + b[i];
  return both;
}

PerFigure times(double factor, PerFigure errors) {
  for (double& error : errors) error *= factor;
  return errors;
}

PerFigure larger(const PerFigure& a, const PerFigure& b) {
  PerFigure both{};
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = std::max(a[i], b[i]);
  return both;
}

/// What figures change by when each moves by so much, in its unit.
PerFigure change(const CycleFigures& figures, const PerFigure& moved) {
  CycleFigures changed = figures;
  for (std::size_t i = 0; i < moved.size(); ++i) changed.value[i] += moved[i];
  return figure_errors(changed, figures);
}

/// Error of the last level by the last three; infinite where there are fewer: two may agree by chance.
PerFigure error_of_last(const std::vector<ResolutionLevel>& levels) {
  PerFigure error{};
  error.fill(std::numeric_limits<double>::infinity());
  const std::size_t n = levels.size();
  if (n < 3) return error;
  for (std::size_t i = 0; i < error.size(); ++i) {
    error[i] = estimate_limit(levels[n - 3].figures.value[i], levels[n - 2].figures.value[i], levels[n - 1].figures.value[i]).error;
  }
  return times(safety, change(levels[n - 1].figures, error));
}

/// Gives every level its error by the last one, whose own stands in it, and finds the coarsest within the budget; the last where none is.
std::size_t coarsest_within(std::vector<ResolutionLevel>& levels, double budget) {
  for (ResolutionLevel& level : levels) level.error = sum(figure_errors(level.figures, levels.back().figures), levels.back().error);
  const auto enough = std::ranges::find_if(levels, [&](const ResolutionLevel& level) { return largest(level.error) <= budget; });
  return enough == levels.end() ? levels.size() - 1 : static_cast<std::size_t>(enough - levels.begin());
}

/// Of so many positions those between half as many.
std::vector<double> every_other(int positions) {
  const std::vector<double> phases = equally_spaced_phases(positions);
  std::vector<double> odd;
  for (std::size_t i = 1; i < phases.size(); i += 2) odd.push_back(phases[i]);
  return odd;
}

/// A search under way; each step adds to what is chosen.
class DiscretisationRun {
 public:
  DiscretisationRun(const MeshOfResolution& mesh_for, QuadratureRule rule, const FlankCondition& condition, double pinion_torque,
                   const DiscretisationSearch& search)
      : mesh_for_(mesh_for), rule_(rule), condition_(condition), torque_(pinion_torque), search_(search) {
    chosen_.quadrature = {rule, search.fewest_intervals};
    chosen_.positions = search.fewest_positions;
  }

  Discretisation finish() {
    if (search_.choose_intervals) search_intervals();
    // Intervals whose error is large between the fewest positions may do at more of them: these have their share whatever is left.
    settle(std::max(left(), (1 - quadrature_share) * search_.accuracy));
    const bool both = search_.choose_intervals && search_.choose_positions;
    if (both && !chosen_.kept && left() > 0) settle(left());
    return std::move(chosen_);
  }

 private:
  /// Of the accuracy, by the intervals.
  double left() const { return search_.accuracy - largest(chosen_.quadrature_error); }

  /// Positions within a budget, and the intervals at these.
  void settle(double budget) {
    if (search_.choose_positions && chosen_.failures == 0) search_positions(budget);
    if (search_.choose_intervals && chosen_.failures == 0) confirm_intervals();
    chosen_.kept = chosen_.failures == 0 && largest(chosen_.error()) <= search_.accuracy;
  }

  SampledCycle solve(int intervals, const std::vector<double>& phases) {
    const MeshModel model = mesh_for_({{rule_, intervals}, phases});
    SampledCycle cycle(model, analyse_cycle(model, condition_, torque_));
    chosen_.failures += cycle.failures();
    return cycle;
  }

  /// At the fewest positions.
  void search_intervals() {
    const std::vector<double> phases = equally_spaced_phases(search_.fewest_positions);
    const double budget = quadrature_share * search_.accuracy;
    std::vector<ResolutionLevel>& levels = chosen_.by_intervals;
    std::size_t taken = 0;
    for (int n = search_.fewest_intervals; n <= 2 * search_.most_intervals; n *= 2) {
      const SampledCycle cycle = solve(n, phases);
      if (chosen_.failures > 0) return;
      levels.push_back({n, cycle.positions(), cycle.figures()});
      levels.back().error = error_of_last(levels);
      taken = coarsest_within(levels, budget);
      if (taken + 1 < levels.size()) break;
    }
    while (levels[taken].intervals > search_.most_intervals) --taken;
    take_intervals(levels[taken]);
  }

  void take_intervals(const ResolutionLevel& level) {
    chosen_.quadrature.intervals = level.intervals;
    chosen_.quadrature_error = level.error;
  }

  /// At the intervals chosen.
  void search_positions(double budget) {
    std::vector<ResolutionLevel>& levels = chosen_.by_positions;
    levels.clear();
    const int intervals = chosen_.quadrature.intervals;
    std::optional<SampledCycle> cycle;
    std::size_t taken = 0;
    for (int n = search_.fewest_positions; n <= 2 * search_.most_positions; n *= 2) {
      cycle = cycle ? cycle->joined(solve(intervals, every_other(n))) : solve(intervals, equally_spaced_phases(n));
      if (chosen_.failures > 0) return;
      levels.push_back({intervals, n, cycle->figures()});
      levels.back().error = larger(error_of_last(levels), change(cycle->figures(), cycle->unseen()));
      taken = coarsest_within(levels, budget);
      const double measured = largest(figure_errors(levels[taken].figures, levels.back().figures));
      if (taken + 1 < levels.size() && largest(levels[taken].error) <= most_over_measured * measured) break;
    }
    while (levels[taken].positions > search_.most_positions) --taken;
    chosen_.positions = levels[taken].positions;
    chosen_.position_error = levels[taken].error;
  }

  /// At the positions chosen: where lines end shows between the fewest.
  void confirm_intervals() {
    const int positions = chosen_.positions;
    SampledCycle coarse = solve(chosen_.quadrature.intervals, equally_spaced_phases(positions));
    for (int n = chosen_.quadrature.intervals; n <= search_.most_intervals; n *= 2) {
      const SampledCycle fine = solve(2 * n, equally_spaced_phases(positions));
      if (chosen_.failures > 0) return;
      chosen_.by_intervals.push_back({n, positions, coarse.figures(), times(safety, figure_errors(coarse.figures(), fine.figures()))});
      take_intervals(chosen_.by_intervals.back());
      const bool enough = largest(sum(chosen_.quadrature_error, chosen_.position_error)) <= search_.accuracy || 2 * n > search_.most_intervals;
      if (enough && search_.choose_positions) double_positions(coarse, fine);
      if (enough) return;
      coarse = fine;
    }
  }

  /// Of a cycle with twice the intervals of the one chosen.
  void double_positions(const SampledCycle& chosen, const SampledCycle& fine) {
    const SampledCycle doubled = fine.joined(solve(2 * chosen_.quadrature.intervals, every_other(2 * chosen_.positions)));
    if (chosen_.failures == 0) chosen_.doubled_difference = largest(figure_errors(chosen.figures(), doubled.figures()));
  }

  const MeshOfResolution& mesh_for_;
  const QuadratureRule rule_;
  const FlankCondition& condition_;
  const double torque_;
  const DiscretisationSearch& search_;
  Discretisation chosen_;
};

}  // namespace

PerFigure Discretisation::error() const {
  PerFigure error = sum(quadrature_error, position_error);
  for (double& of_figure : error) of_figure = std::min(of_figure, most_over_doubled * doubled_difference);
  return error;
}

Discretisation choose_discretisation(const MeshOfResolution& mesh_for, QuadratureRule rule, const FlankCondition& condition, double pinion_torque,
                                     const DiscretisationSearch& search) {
  return DiscretisationRun(mesh_for, rule, condition, pinion_torque, search).finish();
}

}  // namespace flankwright
