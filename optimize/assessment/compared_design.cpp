#include "optimize/assessment/compared_design.hpp"

#include <tbb/parallel_for.h>

#include <stdexcept>

#include "optimize/design/design_log.hpp"

namespace flankwright {

namespace {

ComparedDesign compared(const DesignProblem& problem, const NamedDesign& design) {
  ComparedDesign result;
  result.design = design;
  try {
    const DesignAnalysis analysis = problem.analyse_design(design.modification);
    result.scene_measures = problem.scene_measures(problem.task().combined_objective(), analysis);
    result.objective = problem.objective(analysis);
    result.constraint_violation = problem.violation(analysis);
  } catch (const std::runtime_error& failure) {  // of scene_outputs: not every mesh position converged
    result = {.design = design, .scene_measures = {}, .failure = failure.what()};
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

const ComparedDesign* best_of(const std::vector<ComparedDesign>& designs) {
  const ComparedDesign* best = nullptr;
  for (const ComparedDesign& d : designs) {
    if (d.feasible() && (best == nullptr || d.objective < best->objective)) best = &d;
  }
  return best;
}

}  // namespace flankwright
