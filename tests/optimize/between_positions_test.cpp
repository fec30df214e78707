#include <catch2/catch.hpp>
#include <cmath>

#include "core/fidelity/resolved_cycle.hpp"
#include "optimize/design/between_positions.hpp"
#include "optimize/design/search/design_log.hpp"
#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;
using design_tasks::relieved_spur;

namespace {

DesignResolver resolver(const DesignProblem& problem) {
  return [&problem](const DesignAnalysis& analysis) {
    const DesignTask& task = problem.task();
    std::vector<ResolvedCycle> cycles;
    for (int s = 0; s < problem.scenes(); ++s) {
      const MeshWithParameters at = [&](const std::vector<double>& phases, const std::vector<MeshParameter>&) {
        return make_mesh_model(task.pair, task.material, {task.resolution.quadrature, phases}, task.effects);
      };
      FlankCondition condition = task.scenes[static_cast<std::size_t>(s)].condition;
      condition.modification = analysis.modification;
      cycles.push_back(resolve_cycle(problem.model(s), analysis.cycles[static_cast<std::size_t>(s)], at, condition,
                                     task.scenes[static_cast<std::size_t>(s)].torque, {}));
    }
    return cycles;
  };
}

double resolved_objective(DesignProblem& problem, const Eigen::VectorXd& x) {
  DesignReport report = report_design(problem, problem.analyse(x, false));
  resolve_report(problem, resolver(problem)(report.analysis), report);
  return report.objective;
}

}  // namespace

TEST_CASE("Relief that no peak at a position feels is sought between the positions", "[optimize][design][between]") {
  DesignProblem problem(relieved_spur());
  TwoLevelDesign found = optimise_by_two_levels(problem, {});
  const Eigen::VectorXd on_tread = problem.scaled_design(found.design.after.variables);
  REQUIRE(unfelt_variables(found.design.optimality, on_tread).size() == 2);
  const double before = resolved_objective(problem, on_tread);
  search_between_positions(problem, resolver(problem), found);
  const Eigen::VectorXd x = problem.scaled_design(found.design.after.variables);
  const double after = resolved_objective(problem, x);
  CHECK(after < 0.99 * before);
  // No neighbour is better by more than the tolerance to which extremes are located, 2e-3, twice.
  for (const double a : {-0.03, 0.0, 0.03}) {
    for (const double b : {-0.03, 0.0, 0.03}) {
      const Eigen::VectorXd beside = (x + Eigen::Vector2d(a, b)).cwiseMax(0.0).cwiseMin(1.0);
      CAPTURE(a, b);
      CHECK(resolved_objective(problem, beside) > after * (1.0 - 4e-3));
    }
  }
}

TEST_CASE("A limit that only a peak between the positions exceeds is kept by a search that sees it", "[optimize][design][between]") {
  DesignTask task = relieved_spur();
  task.constraints = {{.output = design_tasks::term(Output::PeakContactStress), .maximum = INFINITY}};
  DesignProblem free(task);
  const auto shown = [](DesignProblem& problem, const Eigen::VectorXd& x) {
    DesignReport report = report_design(problem, problem.analyse(x, false));
    resolve_report(problem, resolver(problem)(report.analysis), report);
    return report.constraint_values[0];
  };
  // A relief with a peak that no position has: a tip edge that touches for a moment.
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
  double hidden = 0.0;
  for (double relief = 0.0; relief <= 0.5; relief += 0.01) {
    const Eigen::VectorXd tried = Eigen::Vector2d(relief, relief);
    const double at_positions = free.constraint_value(free.analyse(tried, false), task.constraints[0]),
                 rise = shown(free, tried) / at_positions - 1.0;
    if (!(rise > hidden)) continue;
    hidden = rise;
    x = tried;
    task.constraints[0].maximum = 1.02 * at_positions;
  }
  REQUIRE(hidden > 0.1);
  DesignProblem problem(task);
  TwoLevelDesign found;
  found.design.status = SolverStatus::Converged;
  found.design.after = report_design(problem, problem.analyse(x, false));
  CHECK(problem.violation(found.design.after.analysis) <= DesignLog::tolerance);
  keep_limits_between_positions(problem, resolver(problem), found);
  const double kept = shown(problem, problem.scaled_design(found.design.after.variables));
  CHECK(kept <= task.constraints[0].maximum * (1.0 + DesignLog::tolerance));
  CHECK_THAT(found.design.message, Catch::Contains("to keep limits"));

  SECTION("so is that of the first of a list of objectives") {
    DesignTask listed = task;
    listed.constraints.clear();
    listed.objective = {design_tasks::term(Output::PeakContactStress)};
    listed.later_objectives = {{.terms = {design_tasks::term(Output::TePeakToPeak)}, .over = {}}};
    DesignProblem of_list(listed);
    TwoLevelDesign later;
    later.design.status = SolverStatus::Converged;
    later.design.after = report_design(of_list, of_list.analyse(x, false));
    const double limit = task.constraints[0].maximum;
    later.design.stages = {{"peak_contact_stress", limit / 1.01, limit}, {"te_peak_to_peak", later.design.after.last_objective()}};
    REQUIRE(resolved_objective(of_list, x) > limit);
    keep_limits_between_positions(of_list, resolver(of_list), later);
    CHECK(resolved_objective(of_list, of_list.scaled_design(later.design.after.variables)) <= limit * (1.0 + DesignLog::tolerance));
    CHECK(later.design.stages.back().least == later.design.after.last_objective());
  }
}

TEST_CASE("A design whose peaks feel every variable is left as it is", "[optimize][design][between]") {
  DesignProblem problem(design_tasks::helical());
  TwoLevelDesign found = optimise_by_two_levels(problem, {});
  const std::vector<double> variables = found.design.after.variables;
  const int analyses = problem.analyses();
  const DesignResolver never = [](const DesignAnalysis&) -> std::vector<ResolvedCycle> { throw std::logic_error("resolved"); };
  search_between_positions(problem, never, found);
  CHECK(problem.analyses() == analyses);
  CHECK(found.design.after.variables == variables);
}
