#include "optimize/assessment/compared_design.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "optimize/design/problem/joined_loads.hpp"
#include "optimize/design/search/design_log.hpp"
#include "optimize/design/two_level.hpp"

namespace flankwright {

namespace {

ComparedDesign compared(const DesignProblem& problem, const NamedDesign& design) {
  ComparedDesign result;
  result.design = design;
  result.intervals = problem.task().resolution.quadrature.intervals;
  try {
    const DesignAnalysis analysis = problem.analyse_design(design.modification);
    result.scene_measures = problem.scene_measures(problem.task().combined_objective(), analysis);
    result.objective = problem.objective(analysis);
    result.constraint_violation = problem.violation(analysis);
    result.modification_violation = problem.violation(analysis.modification);
  } catch (const std::runtime_error& failure) {  // of scene_outputs: not every mesh position converged
    result = {.design = design, .scene_measures = {}, .intervals = result.intervals, .failure = failure.what()};
  }
  return result;
}

}  // namespace

bool ComparedDesign::feasible() const { return failure.empty() && constraint_violation <= DesignLog::tolerance; }

std::vector<ComparedDesign> compare_designs(const DesignProblem& problem, const std::vector<NamedDesign>& designs) {
  std::vector<ComparedDesign> results(designs.size());
  tbb::parallel_for(std::size_t{0}, designs.size(), [&](std::size_t i) { results[i] = compared(problem, designs[i]); });
  return results;
}

std::vector<ComparedDesign> compare_designs_by_two_levels(const DesignProblem& problem, const std::vector<NamedDesign>& designs) {
  if (designs.empty() || !can_be_coarser(problem.task())) return compare_designs(problem, designs);
  constexpr double widest = 1.2;  // of loads that are joined: designs that are compared differ by more than a search tells apart
  JoinedLoads coarse = with_joined_loads(coarser(problem.task()), widest);
  std::vector<ComparedDesign> results = compare_designs(DesignProblem(std::move(coarse.task)), designs);
  for (ComparedDesign& d : results) {
    if (!d.scene_measures.empty()) d.scene_measures = coarse.of_scenes(d.scene_measures);
  }
  const auto rank = [](const ComparedDesign& d) { return std::pair(d.feasible() ? 0.0 : d.constraint_violation, d.objective); };
  const int own = problem.task().resolution.quadrature.intervals;
  for (;;) {
    ComparedDesign* best = nullptr;
    for (ComparedDesign& d : results) {
      if (d.failure.empty() && (best == nullptr || rank(d) < rank(*best))) best = &d;
    }
    if (best == nullptr || best->intervals == own) return results;
    *best = compared(problem, best->design);
  }
}

const ComparedDesign* best_of(const std::vector<ComparedDesign>& designs) {
  const ComparedDesign* best = nullptr;
  for (const ComparedDesign& d : designs) {
    if (d.feasible() && (best == nullptr || d.objective < best->objective)) best = &d;
  }
  return best;
}

}  // namespace flankwright
