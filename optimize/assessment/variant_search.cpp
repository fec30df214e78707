#include "optimize/assessment/variant_search.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/stopwatch.hpp"

namespace flankwright {

namespace {

constexpr std::int64_t batch_size = 64;  // designs held in memory at a time, each only its numbers

std::int64_t product(const std::vector<int>& levels) {
  std::int64_t result = 1;
  for (int n : levels) result *= n;
  return result;
}

/// Combination number `index` of the levels, the last variable running fastest.
Eigen::VectorXd combination(LevelPlacement placement, const std::vector<int>& levels, std::int64_t index) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(levels.size()));
  for (Eigen::Index i = x.size() - 1; i >= 0; --i) {
    const int n = levels[static_cast<std::size_t>(i)];
    x[i] = level_value(placement, static_cast<int>(index % n), n);
    index /= n;
  }
  return x;
}

}  // namespace

const char* to_string(LevelPlacement placement) { return placement == LevelPlacement::BoundToBound ? "bound to bound" : "middles of equal parts"; }

std::vector<int> levels_for(int variables, std::int64_t budget) {
  std::vector<int> levels(static_cast<std::size_t>(variables), 1);
  for (bool raised = true; raised;) {
    raised = false;
    for (int& n : levels) {
      if (product(levels) / n * (n + 1) > budget) return levels;
      ++n;
      raised = true;
    }
  }
  return levels;
}

double level_value(LevelPlacement placement, int k, int n) {
  if (n == 1 || placement == LevelPlacement::Middles) return (k + 0.5) / n;
  return static_cast<double>(k) / (n - 1);
}

VariantSearch search_variants(const DesignProblem& problem, LevelPlacement placement, std::int64_t budget,
                              const std::function<void(int, int)>& done) {
  const Stopwatch clock;
  VariantSearch search{.placement = placement, .levels = levels_for(problem.variables(), budget), .x = {}, .best = {}};
  const std::int64_t count = product(search.levels);
  for (std::int64_t first = 0; first < count; first += batch_size) {
    std::vector<NamedDesign> batch;
    for (std::int64_t i = first; i < std::min(count, first + batch_size); ++i) {
      NamedDesign design{"variant " + std::to_string(i + 1), "", {}};
      design.modification = problem.modification(combination(placement, search.levels, i));
      batch.push_back(std::move(design));
    }
    const std::vector<ComparedDesign> compared = compare_designs(problem, batch);
    for (std::size_t k = 0; k < compared.size(); ++k) {
      ++search.tried;
      search.failed += compared[k].failure.empty() ? 0 : 1;
      if (!compared[k].feasible()) continue;
      ++search.feasible;
      if (search.x.size() > 0 && search.best.objective <= compared[k].objective) continue;
      search.best = compared[k];
      search.x = combination(placement, search.levels, first + static_cast<std::int64_t>(k));
    }
    if (done) done(static_cast<int>(search.tried), static_cast<int>(count));
  }
  search.seconds = clock.seconds();
  return search;
}

}  // namespace flankwright
