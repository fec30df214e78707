#include "optimize/design/scatter/draw_analyses.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace flankwright {

namespace {

constexpr std::size_t scenes_held = 64;  // scenes whose cycles are held at the same time, >= 1; a unit is not divided

}  // namespace

DrawAnalyses::DrawAnalyses(const DesignProblem& full, std::vector<const StatisticModel*> models) : models_(std::move(models)) {
  of_spectrum_ = std::ranges::any_of(models_, [](const StatisticModel* m) { return m->objective().over_spectrum(); });
  number_units(full);
}

/// Scenes that are analysed together have the same number, that of their first: the load cases of a draw or of a spectrum, else each on its own.
void DrawAnalyses::number_units(const DesignProblem& full) {
  std::map<std::pair<bool, int>, int> first;
  for (int s = 0; s < full.scenes(); ++s) {
    const DesignScene& scene = full.task().scenes[static_cast<std::size_t>(s)];
    const bool is_drawn = scene.draw >= 0, is_alone = !is_drawn && !(of_spectrum_ && scene.spectrum >= 0);
    units_.push_back(is_alone ? s : first.try_emplace({is_drawn, is_drawn ? scene.draw : scene.spectrum}, s).first->second);
  }
}

std::int64_t DrawAnalyses::add(AnalysedDraws& analysed, const StatisticModel& of, const std::vector<int>& draws, bool with_derivatives) const {
  std::set<int> units;
  for (const int draw : draws) units.insert(unit_of(of, draw));
  std::erase_if(units, [&](int unit) { return analysed.units.contains(unit); });
  std::vector<int> scenes;
  for (int s = 0; s < analysed.problem->scenes(); ++s) {
    if (units.contains(unit_of(s))) scenes.push_back(s);
  }
  for (std::size_t from = 0; from < scenes.size();) {
    std::size_t to = std::min(from + scenes_held, scenes.size());
    while (to < scenes.size() && unit_of(scenes[to]) == unit_of(scenes[to - 1])) ++to;
    linearise(analysed, {scenes.begin() + static_cast<std::ptrdiff_t>(from), scenes.begin() + static_cast<std::ptrdiff_t>(to)}, with_derivatives);
    from = to;
  }
  analysed.units.merge(units);
  return std::ssize(scenes);
}

std::vector<double> DrawAnalyses::measures(const AnalysedDraws& analysed, const StatisticModel& of, const std::vector<int>& draws) const {
  std::vector<double> measures;
  const auto number = static_cast<std::size_t>(std::ranges::find(models_, &of) - models_.begin());
  for (const int draw : draws) measures.push_back(of.unseen(of.seen(analysed.linear.at({number, draw}), analysed.x).value));
  return measures;
}

void DrawAnalyses::linearise(AnalysedDraws& analysed, const std::vector<int>& scenes, bool with_derivatives) const {
  const DesignProblem& problem = *analysed.problem;
  const DesignAnalysis analysis = problem.analyse_some(analysed.x, scenes, with_derivatives);
  struct Asked {
    std::size_t model;
    int draw;
    LinearDraw linear;
  };
  std::vector<Asked> asked;
  const std::set<int> some(scenes.begin(), scenes.end());
  for (std::size_t m = 0; m < models_.size(); ++m) {
    for (int i = 0; i < models_[m]->draws(); ++i) {
      if (some.contains(models_[m]->first_scene(i))) asked.push_back({m, i, {}});
    }
  }
  tbb::parallel_for(std::size_t{0}, asked.size(),
                    [&](std::size_t i) { asked[i].linear = models_[asked[i].model]->linear(problem, analysis, asked[i].draw, analysed.x); });
  for (Asked& a : asked) analysed.linear[{a.model, a.draw}] = std::move(a.linear);
}

}  // namespace flankwright
