#include "optimize/design/between_positions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "optimize/design/search/design_log.hpp"
#include "optimize/design/search/optimality.hpp"
#include "optimize/design/grinding/grindable_design.hpp"
#include "optimize/solvers/solver.hpp"

namespace flankwright {

namespace {

constexpr double probe = 0.02;                  ///< step that shows whether a variable matters, of its range
constexpr double least_gain = 1e-4;             ///< a probe or a search that lowers the objective by less, relative, is no gain
constexpr double step_tolerance = 1e-3;         ///< the search ends where its steps are shorter, of a variable's range
constexpr int most_analyses_per_variable = 25;  ///< COBYLA takes some 15 a variable to that tolerance

/// The task over some of its variables, the others held, with figures that have extremes between the positions.
class ProgramBetweenPositions : public NonlinearProgram {
 public:
  ProgramBetweenPositions(DesignProblem& problem, const DesignResolver& resolve, Eigen::VectorXd x, std::vector<int> free)
      : problem_(problem), resolve_(resolve), x_(std::move(x)), free_(std::move(free)) {}

  int variables() const override { return static_cast<int>(free_.size()); }
  int constraints() const override { return 1; }
  Eigen::VectorXd lower() const override { return Eigen::VectorXd::Zero(variables()); }
  Eigen::VectorXd upper() const override { return Eigen::VectorXd::Ones(variables()); }
  Eigen::VectorXd start() const override { return x_(free_); }

  Eigen::VectorXd design(const Eigen::VectorXd& y) const {
    Eigen::VectorXd x = x_;
    x(free_) = y;
    return x;
  }

  /// The objective where the constraints are kept; nothing where they are not, or the design cannot be analysed.
  std::optional<double> feasible_objective(const Eigen::VectorXd& y) {
    try {
      const ProgramValues values = evaluate(y, false);
      if (values.constraints[0] <= 0.0) return values.objective;
    } catch (const InvalidInput&) {
      throw;
    } catch (const std::runtime_error&) {  // a load distribution that was not found
    }
    return std::nullopt;
  }

  ProgramValues evaluate(const Eigen::VectorXd& y, bool) override {
    const DesignTask& task = problem_.task();
    DesignReport report;
    report.analysis = problem_.analyse(design(y), false);
    report.constraint_values.resize(task.constraints.size());
    double violation = problem_.violation(report.analysis);
    const std::vector<ResolvedCycle> cycles = resolve_(report.analysis);
    resolve_report(problem_, cycles, report);
    for (std::size_t c = 0; c < task.constraints.size(); ++c)
      violation = std::max(violation, task.constraints[c].excess(report.constraint_values[c]));
    for (const ObjectiveBound& bound : task.objective_bounds)
      violation = std::max(violation, resolved_values(problem_, {bound.objective}, report.analysis, cycles).front().value / bound.limit - 1.0);
    ProgramValues values;
    values.objective = report.objective;
    values.constraints = Eigen::VectorXd::Constant(1, violation - DesignLog::tolerance);
    return values;
  }

 private:
  DesignProblem& problem_;
  const DesignResolver& resolve_;
  Eigen::VectorXd x_;
  std::vector<int> free_;
};

/// Those of the variables of which a probe either way keeps the constraints and lowers the objective.
std::vector<int> that_matter(DesignProblem& problem, const DesignResolver& resolve, const Eigen::VectorXd& x, const std::vector<int>& variables,
                             double objective) {
  std::vector<int> matter;
  for (const int i : variables) {
    ProgramBetweenPositions program(problem, resolve, x, {i});
    const auto gains = [&](double step) {
      const double moved = std::clamp(x[i] + step, 0.0, 1.0);
      const std::optional<double> found = program.feasible_objective(Eigen::VectorXd::Constant(1, moved));
      return found && *found < objective * (1.0 - least_gain);
    };
    if (gains(-probe) || gains(probe)) matter.push_back(i);
  }
  return matter;
}

}  // namespace

std::vector<int> unfelt_variables(const Optimality& optimality, const Eigen::VectorXd& x) {
  std::vector<int> unfelt;
  for (Eigen::Index i = 0; i < optimality.steepest.size(); ++i) {
    if (optimality.steepest[i] <= Optimality::holds && x[i] > 0.0 && x[i] < 1.0) unfelt.push_back(static_cast<int>(i));
  }
  return unfelt;
}

namespace {

SolverOptions cobyla(std::size_t variables) {
  SolverOptions options;
  options.name = "nlopt:cobyla";
  options.tolerance = step_tolerance;
  options.max_evaluations = most_analyses_per_variable * static_cast<int>(variables);
  return options;
}

/// Puts a design in the place of the one that was found, with what can be ground of it.
/// @param last  last_stage() of the problem
void take_design(const DesignProblem& problem, DesignProblem& last, const Eigen::VectorXd& x, const SolverOptions& options, const std::string& how,
                 DesignResult& design) {
  design.after = report_design(problem, last.analyse(x, false));
  DesignToGrind to_grind = design_to_grind(last, x, options);
  design.exact.reset();
  if (to_grind.is_changed) {
    design.exact = design.after;
    design.after = report_design(problem, last.analyse(to_grind.x, false));
  }
  if (!design.stages.empty()) design.stages.back().least = design.after.last_objective();
  design.choices = std::move(to_grind.choices);
  design.evaluations += to_grind.choice_analyses;  // of copies of the problem
  design.failures += to_grind.failures;
  design.message += "; then between the positions " + how;
}

/// Counts what a search took.
class Account {
 public:
  Account(DesignProblem& problem, TwoLevelDesign& found)
      : problem_(problem), found_(found), analyses_(problem.analyses()), cycles_(problem.cycles()) {}
  ~Account() {
    found_.design.evaluations += problem_.analyses() - analyses_;
    found_.fine.cycles += problem_.cycles() - cycles_;
    found_.fine.seconds += clock_.seconds();
    found_.design.seconds += clock_.seconds();
  }
  Account(const Account&) = delete;
  Account& operator=(const Account&) = delete;

 private:
  Stopwatch clock_;
  DesignProblem& problem_;
  TwoLevelDesign& found_;
  int analyses_;
  std::int64_t cycles_;
};

}  // namespace

void search_between_positions(DesignProblem& problem, const DesignResolver& resolve, TwoLevelDesign& found) {
  const DesignTask& task = problem.task();
  if (!task.scalarisation.empty() || !task.later_objectives.empty()) return;
  const Account account(problem, found);
  DesignResult& design = found.design;
  const Eigen::VectorXd x = problem.nearest_design(exact_of(found).variables);
  const std::vector<int> unfelt = unfelt_variables(design.optimality, x);
  if (unfelt.empty()) return;
  const double objective = ProgramBetweenPositions(problem, resolve, x, unfelt).evaluate(x(unfelt), false).objective;
  const std::vector<int> free = that_matter(problem, resolve, x, unfelt, objective);
  if (free.empty()) return;
  ProgramBetweenPositions program(problem, resolve, x, free);
  const SolverOptions options = cobyla(free.size());
  const SolverResult solved = solve(program, options);
  if (solved.x.size() == 0 || solved.constraint_violation > 0.0 || !(solved.objective < objective * (1.0 - least_gain))) return;
  const std::string of_them = free.size() == 1 ? " variable" : " variables";
  take_design(problem, problem, program.design(solved.x), options,
              "along " + std::to_string(free.size()) + of_them + " that no peak at a position felt", design);
}

void keep_limits_between_positions(DesignProblem& problem, const DesignResolver& resolve, TwoLevelDesign& found) {
  if (!problem.task().scalarisation.empty()) return;
  DesignProblem last = last_stage(problem, found.design.stages);
  const Account account(last, found);
  const Eigen::VectorXd x = last.nearest_design(exact_of(found).variables);
  std::vector<int> all(static_cast<std::size_t>(last.variables()));
  std::iota(all.begin(), all.end(), 0);
  ProgramBetweenPositions program(last, resolve, x, all);
  const double excess = program.evaluate(x, false).constraints[0];
  const SolverOptions options = cobyla(all.size());
  const SolverResult solved = solve(program, options);
  if (solved.x.size() == 0 || !(solved.constraint_violation < excess)) return;
  const Eigen::VectorXd nearer = program.design(solved.x);
  take_design(problem, last, nearer, options, "to keep limits that only peaks there exceed", found.design);
  found.design.optimality = first_order_optimality(last, nearer);
}

}  // namespace flankwright
