#include "optimize/assessment/validation.hpp"

#include "optimize/design/scatter/draws.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace flankwright {

std::vector<ValidatedDesign> validate_designs(const DesignTask& task, const std::vector<DesignScene>& scenes,
                                              const std::vector<NamedDesign>& designs) {
  DesignTask drawn = task;
  drawn.scenes = scenes;
  const DesignProblem problem(std::move(drawn));
  std::vector<ValidatedDesign> validated;
  for (const NamedDesign& design : designs) validated.push_back({design.name, std::vector<double>(scenes.size(), not_given)});
  const bool over_spectrum = task.combined_objective().over_spectrum();
  const auto by_draws = [&] {
    const auto draws = draws_of(scenes, over_spectrum);
    for (ValidatedDesign& design : validated) design.measures = draw_measures(draws, scenes, task.within_draw, design.measures);
    return validated;
  };
  if (over_spectrum) {  // all load cases of a spectrum at a time
    for (std::size_t d = 0; d < designs.size(); ++d) {
      try {
        validated[d].measures = problem.scene_measures(task.combined_objective(), problem.analyse_design(designs[d].modification));
      } catch (const std::runtime_error&) {  // not every mesh position converged: all stay NaN
      }
    }
    return by_draws();
  }
  tbb::parallel_for(0, problem.scenes(), [&](int s) {
    for (std::size_t d = 0; d < designs.size(); ++d) {
      try {
        const LoadedCycle cycle = problem.analyse_scene(s, designs[d].modification);
        validated[d].measures[static_cast<std::size_t>(s)] = problem.scene_measure(task.combined_objective(), cycle, s);
      } catch (const std::runtime_error&) {  // not every mesh position converged: stays NaN, which spread_of() counts
      }
    }
  });
  return by_draws();
}

Spread spread_of(const std::vector<double>& values) {
  std::vector<double> sorted;
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted), [](double v) { return !std::isnan(v); });
  std::sort(sorted.begin(), sorted.end());
  Spread spread{.count = static_cast<int>(sorted.size()), .failed = static_cast<int>(values.size() - sorted.size())};
  if (sorted.empty()) return spread;
  double sum = 0.0, squares = 0.0;
  for (const double v : sorted) sum += v;
  spread.mean = sum / spread.count;
  for (const double v : sorted) squares += (v - spread.mean) * (v - spread.mean);
  if (spread.count > 1) spread.deviation = std::sqrt(squares / (spread.count - 1));
  spread.least = sorted.front();
  spread.greatest = sorted.back();
  for (std::size_t q = 0; q < Spread::shares.size(); ++q) {
    const double place = Spread::shares[q] * (spread.count - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    spread.quantiles[q] = sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
  }
  return spread;
}

double share_below(const std::vector<double>& a, const std::vector<double>& b) {
  int below = 0, count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    ++count;
    constexpr double round_off = 1e-9;  // a is below b by more than this part of it: the same design analysed twice is not
    below += a[i] < b[i] - round_off * std::abs(b[i]) ? 1 : 0;
  }
  return count > 0 ? static_cast<double>(below) / count : not_given;
}

std::vector<int> histogram(const std::vector<double>& values, double low, double high, int bins) {
  std::vector<int> counts(static_cast<std::size_t>(bins), 0);
  for (const double v : values) {
    if (!(v >= low && v <= high)) continue;
    const double share = high > low ? (v - low) / (high - low) : 0.0;
    ++counts[std::min(static_cast<std::size_t>(share * bins), counts.size() - 1)];
  }
  return counts;
}

}  // namespace flankwright
