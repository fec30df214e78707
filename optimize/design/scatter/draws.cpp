#include "optimize/design/scatter/draws.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace flankwright {

std::vector<std::vector<int>> draws_of(const std::vector<DesignScene>& scenes, bool over_spectrum) {
  std::vector<std::vector<int>> draws;
  std::map<int, std::size_t> known;
  std::set<int> spectra;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (over_spectrum && !spectra.insert(scenes[s].spectrum).second) continue;
    const int scene = static_cast<int>(s);
    if (scenes[s].draw < 0) {
      draws.push_back({scene});
      continue;
    }
    const auto [at, is_new] = known.try_emplace(scenes[s].draw, draws.size());
    if (is_new) draws.emplace_back();
    draws[at->second].push_back(scene);
  }
  return draws;
}

std::vector<double> draw_measures(const std::vector<std::vector<int>>& draws, const std::vector<DesignScene>& scenes, const Aggregation& within,
                                  const std::vector<double>& measures) {
  std::vector<double> values;
  for (const std::vector<int>& draw : draws) {
    std::vector<double> of_cases, weights;
    for (const int scene : draw) {
      of_cases.push_back(measures[static_cast<std::size_t>(scene)]);
      weights.push_back(scenes[static_cast<std::size_t>(scene)].weight);
    }
    const bool is_known = std::ranges::none_of(of_cases, [](double m) { return std::isnan(m); });
    const double only = of_cases.front();  // without the round-off of a mean
    values.push_back(!is_known ? not_given : of_cases.size() == 1 ? only : aggregate(within, of_cases, weights));
  }
  return values;
}

double statistic_over_draws(const DesignProblem& problem, const Objective& objective, const DesignAnalysis& analysis) {
  const DesignTask& task = problem.task();
  const auto draws = draws_of(task.scenes, objective.over_spectrum());
  std::vector<double> weights;
  for (const std::vector<int>& draw : draws) weights.push_back(task.scenes[static_cast<std::size_t>(draw.front())].weight);
  return aggregate(objective.over, draw_measures(draws, task.scenes, task.within_draw, problem.scene_measures(objective, analysis)), weights);
}

}  // namespace flankwright
