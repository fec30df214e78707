#include "core/fidelity/discretisation.hpp"

#include <algorithm>
#include <map>
#include <optional>

namespace flankwright {

namespace {

PerFigure sum(const PerFigure& a, const PerFigure& b) {
  PerFigure both{};
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = a[i] + b[i];
  return both;
}

void raise(PerFigure& worst, const PerFigure& other) {
  for (std::size_t i = 0; i < worst.size(); ++i) worst[i] = std::max(worst[i], other[i]);
}

/// A search under way; each step adds a level to the load cases that are still open.
class DiscretisationRun {
 public:
  DiscretisationRun(const std::vector<ResolutionCase>& cases, QuadratureRule rule, const DiscretisationSearch& search)
      : cases_(cases), rule_(rule), search_(search), levels_(cases.size()), failures_(cases.size(), 0) {
    for (std::size_t i = 0; i < cases.size(); ++i) open_.push_back(i);
  }

  Discretisation finish() {
    int intervals = search_.fewest_intervals, positions = search_.fewest_positions;
    while (!open_.empty()) {
      if (search_.starting) search_.starting(intervals, positions, static_cast<int>(open_.size()));
      solve_level(intervals, positions);
      for (const int failed : failures_) chosen_.failures += failed;
      if (chosen_.failures > 0) break;
      chosen_.quadrature = {rule_, intervals};
      chosen_.positions = positions;
      const ResolutionLevel& worst = *worst_level();
      std::erase_if(open_, [&](std::size_t i) { return keeps(levels_[i].back()); });
      const bool more_intervals = search_.choose_intervals && 2 * intervals <= search_.most_intervals;
      const bool more_positions = search_.choose_positions && 2 * positions <= search_.most_positions;
      if (!(more_intervals || more_positions)) break;
      if (!more_intervals && !mendable(worst, worst.quadrature_error)) break;
      if (!more_positions && !mendable(worst, worst.position_error)) break;
      const bool by_points = points_bring_most(worst);
      if (!open_.empty()) (more_intervals && (by_points || !more_positions) ? intervals : positions) *= 2;
    }
    for (const std::vector<ResolutionLevel>& of_case : levels_) {
      if (of_case.empty()) continue;
      raise(chosen_.quadrature_error, of_case.back().quadrature_error);
      raise(chosen_.position_error, of_case.back().position_error);
      raise(chosen_.total_error, of_case.back().error());
    }
    chosen_.kept = chosen_.failures == 0 && open_.empty();
    chosen_.levels = levels_[chosen_.governing];
    return std::move(chosen_);
  }

 private:
  double counted(const ResolutionLevel& level) const { return headline(root_sum_square(search_.spent, level.error())); }
  bool keeps(const ResolutionLevel& level) const { return counted(level) <= search_.accuracy; }

  /// Whether some figure exceeds the accuracy, though not by this part of its error alone, which cannot be reduced
  /// further.
  bool mendable(const ResolutionLevel& level, const PerFigure& fixed) const {
    PerFigure open = root_sum_square(search_.spent, level.error());
    const PerFigure alone = root_sum_square(search_.spent, fixed);
    for (std::size_t i = 0; i < open.size(); ++i) open[i] = alone[i] > search_.accuracy ? 0.0 : open[i];
    return headline(open) > search_.accuracy;
  }

  /// Of the figure that is farthest from being kept.
  bool points_bring_most(const ResolutionLevel& level) const {
    const PerFigure counted = root_sum_square(search_.spent, level.error());
    const auto figure = static_cast<std::size_t>(std::ranges::find(counted, headline(counted)) - counted.begin());
    return level.quadrature_error[figure] >= level.position_error[figure];
  }

  /// The largest error of the open load cases; its case governs.
  const ResolutionLevel* worst_level() {
    for (const std::size_t i : open_) {
      const bool larger = open_.front() == i || counted(levels_[i].back()) > counted(levels_[chosen_.governing].back());
      if (larger) chosen_.governing = i;
    }
    return &levels_[chosen_.governing].back();
  }

  struct Meshes {
    std::optional<MeshModel> fine, coarse;
  };

  void solve_level(int intervals, int positions) {
    const std::vector<double> phases = equally_spaced_phases(positions);
    std::map<int, std::size_t> first_case;  // of each placement
    for (const std::size_t i : open_) first_case.try_emplace(cases_[i].placement, i);
    const std::vector<std::pair<int, std::size_t>> placements(first_case.begin(), first_case.end());
    std::vector<Meshes> made(placements.size());
    run_for_each(search_.for_each, 2 * placements.size(), [&](std::size_t job) {
      const MeshOfResolution& mesh_for = cases_[placements[job / 2].second].mesh_for;
      if (job % 2 == 0) {
        made[job / 2].fine = mesh_for({{rule_, intervals}, phases});
      } else {
        made[job / 2].coarse = mesh_for({{rule_, std::max(1, intervals / 2)}, coarse_phases(phases)});
      }
    });
    const auto meshes_of = [&](std::size_t i) -> const Meshes& {
      const auto found = std::ranges::find(placements, cases_[i].placement, [](const auto& p) { return p.first; });
      return made[static_cast<std::size_t>(found - placements.begin())];
    };
    run_for_each(search_.for_each, open_.size(), [&](std::size_t j) {
      const std::size_t i = open_[j];
      solve(i, intervals, positions, *meshes_of(i).fine, *meshes_of(i).coarse);
    });
  }

  void solve(std::size_t i, int intervals, int positions, const MeshModel& model, const MeshModel& coarse_model) {
    const ResolutionCase& of = cases_[i];
    const LoadedCycle cycle = analyse_cycle(model, of.condition, of.pinion_torque, {}, {}, RootStresses::Later);
    const LoadedCycle coarse = analyse_cycle(coarse_model, of.condition, of.pinion_torque, {}, {}, RootStresses::Later);
    failures_[i] = cycle.failures + coarse.failures;
    if (failures_[i] > 0) return;
    const MeshWithParameters at = [&](const std::vector<double>& some, const std::vector<MeshParameter>&) {
      return of.mesh_for({{rule_, intervals}, some});
    };
    const MeshAt coarse_at = [&](const std::vector<double>& some) { return of.mesh_for({{rule_, std::max(1, intervals / 2)}, some}); };
    const bool seeks = search_.seek_extremes && rule_ == QuadratureRule::Graded;
    const auto level = [&](bool seek) {
      // Where extremes are yet to be sought they count as found.
      static const CycleExtremes found_at_positions;
      const CycleResolving resolving{.seek_extremes = seek, .coarse = &coarse, .coarse_at = coarse_at};
      const ResolvedCycle resolved = resolve_cycle(model, cycle, at, of.condition, of.pinion_torque, resolving);
      const CycleErrors by_positions =
          seek || !seeks ? resolved.error_parts.positions : estimate_errors(cycle, resolved.summary, coarse, &found_at_positions).positions;
      ResolutionLevel made{intervals, positions, figures_of(model, cycle, resolved.summary)};
      if (search_.choose_intervals) made.quadrature_error = error_shares(resolved.error_parts.points, made.figures);
      if (search_.choose_positions) made.position_error = error_shares(by_positions, made.figures);
      return made;
    };
    ResolutionLevel made = level(false);
    if (seeks && keeps(made)) made = level(true);
    levels_[i].push_back(made);
  }

  const std::vector<ResolutionCase>& cases_;
  const QuadratureRule rule_;
  const DiscretisationSearch& search_;
  std::vector<std::vector<ResolutionLevel>> levels_;  ///< of each load case
  std::vector<int> failures_;                         ///< of each at its last level
  std::vector<std::size_t> open_;                     ///< load cases that do not keep the accuracy yet
  Discretisation chosen_;
};

}  // namespace

PerFigure ResolutionLevel::error() const { return sum(quadrature_error, position_error); }

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

Discretisation choose_discretisation(const std::vector<ResolutionCase>& cases, QuadratureRule rule, const DiscretisationSearch& search) {
  return DiscretisationRun(cases, rule, search).finish();
}

Discretisation choose_discretisation(const MeshOfResolution& mesh_for, QuadratureRule rule, const FlankCondition& condition, double pinion_torque,
                                     const DiscretisationSearch& search) {
  return choose_discretisation({{mesh_for, condition, pinion_torque}}, rule, search);
}

}  // namespace flankwright
