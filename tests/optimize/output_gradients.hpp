#pragma once

#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <cstddef>
#include <vector>

#include "optimize/design/problem/design_problem.hpp"

namespace flankwright::design_tasks {

/// Checks the gradients of the leading candidates of outputs, in all scenes that judge them, against central differences.
/// @param x               scaled design
/// @param step            of the differences, scaled
/// @param discretisation  largest error of a component, relative to the largest component of the difference
/// @return                how many gradients were checked
inline std::size_t check_output_gradients(DesignProblem& problem, const Eigen::VectorXd& x, const std::vector<ObjectiveTerm>& outputs, double step,
                                          double discretisation) {
  struct Check {
    ObjectiveTerm term;
    int scene;
    PeakCandidate candidate;
    Eigen::VectorXd exact, difference;
  };
  const DesignAnalysis at = problem.analyse(x, true);
  std::vector<Check> checks;
  for (const ObjectiveTerm& output : outputs) {
    for (const int s : problem.judged_scenes(output)) {
      for (const PeakCandidate& candidate : leading_candidates(output, problem.scene(at, s), 0.1, 3)) {
        const SmoothValue value = candidate_value(output, candidate, problem.scene(at, s));
        checks.push_back({output, s, candidate, problem.scaled(value.gradient), Eigen::VectorXd(problem.variables())});
      }
    }
  }
  for (int i = 0; i < problem.variables(); ++i) {
    const Eigen::VectorXd shift = step * Eigen::VectorXd::Unit(problem.variables(), i);
    const DesignAnalysis up = problem.analyse(x + shift, false), down = problem.analyse(x - shift, false);
    for (Check& c : checks) {
      const auto value = [&](const DesignAnalysis& a) { return candidate_value(c.term, c.candidate, problem.scene(a, c.scene)).value; };
      c.difference[i] = (value(up) - value(down)) / (2.0 * step);
    }
  }
  for (const Check& c : checks) {
    CAPTURE(c.term.name, c.scene, c.exact.transpose(), c.difference.transpose());
    CHECK((c.exact - c.difference).cwiseAbs().maxCoeff() <= discretisation * c.difference.cwiseAbs().maxCoeff());
  }
  return checks.size();
}

}  // namespace flankwright::design_tasks
