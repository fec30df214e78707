#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/design/search/direct_program.hpp"
#include "optimize/design/search/epigraph_program.hpp"

#include "tests/common/random.hpp"
#include "tests/optimize/design_tasks.hpp"
#include "tests/optimize/program_gradients.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

DesignTask with_two_outputs_and_a_bound(const Aggregation& over) {
  DesignTask task = helical();
  task.over = over;
  task.scenes[1].weight = 2.0;
  task.objective = {term(Output::PeakContactStress, 0, 0.01), term(Output::TePeakToPeak, 0, 1.0)};
  task.constraints = {{term(Output::PeakLineLoad), 250.0}};
  return task;
}

Eigen::VectorXd row_values(EpigraphProgram& program, const Eigen::VectorXd& y) { return program.evaluate(y, false).constraints; }

}  // namespace

TEST_CASE("The direct programme's gradients are what central differences say", "[optimize][design][gradient]") {
  const Aggregate over = GENERATE(Aggregate::Nominal, Aggregate::Worst, Aggregate::Mean, Aggregate::MeanPlusSigmas, Aggregate::Cvar);
  CAPTURE(to_string(over));
  DesignProblem problem(with_two_outputs_and_a_bound(over));
  DesignLog log(nullptr);
  DirectProgram program(problem, log);
  tests::Random32 random(8);
  for (int trial = 0; trial < 3; ++trial) check_gradients(program, random_design(problem.variables(), random));
}

TEST_CASE("The epigraph programme's gradients are what central differences say", "[optimize][design][gradient]") {
  const Aggregation over =
      GENERATE(Aggregation(Aggregate::Nominal), Aggregation(Aggregate::Worst), Aggregation(Aggregate::Mean),
               Aggregation(Aggregate::MeanPlusSigmas, 2.0), Aggregation(Aggregate::MeanPlusSigmas, 0.7), Aggregation(Aggregate::Cvar, 2.0, 0.5));
  const bool several_outputs = GENERATE(true, false);
  CAPTURE(to_string(over), several_outputs);
  DesignTask task = with_two_outputs_and_a_bound(over);
  if (!several_outputs) task.objective.pop_back();
  DesignProblem problem(task);
  DesignLog log(nullptr);
  EpigraphProgram program(problem, log);
  tests::Random32 random(9);
  Eigen::VectorXd y = program.start();
  y.head(problem.variables()) = random_design(problem.variables(), random);
  check_gradients(program, y);
}

TEST_CASE("The epigraph starts feasible and promises what the true outputs are", "[optimize][design]") {
  const Aggregate over = GENERATE(Aggregate::Nominal, Aggregate::Worst, Aggregate::Mean, Aggregate::Cvar);
  DesignTask task = with_two_outputs_and_a_bound(over);
  task.constraints.clear();
  CAPTURE(to_string(over));
  DesignProblem problem(task);
  DesignLog log(nullptr);
  EpigraphProgram program(problem, log);
  constexpr double round_off = 1e-12;
  const auto check_promise = [&](const Eigen::VectorXd& x) {
    const Eigen::VectorXd y = program.start();
    CHECK(program.design(y) == x);
    CHECK(row_values(program, y).maxCoeff() <= round_off);
    const double truth = problem.objective(problem.analyse(x, true));
    CHECK(program.objective_of(program.evaluate(y, true).objective).value == Approx(truth).epsilon(round_off));
    CHECK(program.seen(truth) == Approx(program.evaluate(y, true).objective).epsilon(round_off));
  };
  check_promise(problem.start());
  const Eigen::Vector3d elsewhere(0.4, 0.6, 0.2);
  program.add_candidates(elsewhere);
  CHECK(program.add_candidates(elsewhere) == 0);  // all known by now
  program.restart_from(elsewhere);
  check_promise(elsewhere);
}

TEST_CASE("The rows see a design as better than it is where a peak has no candidate, and as it is once they have it", "[optimize][design]") {
  const bool is_list = GENERATE(false, true);
  DesignTask task = helical({0.0});
  task.leading_share = 0.01;  // candidates of a single peak
  task.constraints = {{term(Output::PeakLineLoad), 100.0}};
  DesignProblem problem(task);
  if (is_list)
    problem = problem.judged_by(task.combined_objective(), {{task.combined_objective(), 500.0}}, {{task.combined_objective(), 0.0, 100.0}});
  DesignLog log(nullptr);
  EpigraphProgram program(problem, log);
  CHECK(std::isnan(program.seen_by_rows().objective));  // nothing evaluated yet
  constexpr double round_off = 1e-12;
  const Eigen::Vector3d elsewhere(0.0, 0.0, 0.0);  // a slope that loads the other end
  Eigen::VectorXd y = program.start();
  y.head(3) = elsewhere;
  (void)program.evaluate(y, false);
  const DesignAnalysis& analysis = problem.analyse(elsewhere, true);
  const double objective = program.seen(problem.objective(analysis)), violation = problem.violation(analysis);
  CHECK(program.seen_by_rows().objective < 0.99 * objective);
  CHECK(program.seen_by_rows().violation < 0.99 * violation);
  CHECK(program.add_candidates(elsewhere) > 0);
  program.restart_from(elsewhere);
  (void)program.evaluate(y, false);
  CHECK(program.seen_by_rows().objective == Approx(objective).epsilon(round_off));
  CHECK(program.seen_by_rows().violation == Approx(violation).epsilon(round_off));
}

TEST_CASE("A majorant does not tell what its rows see", "[optimize][design]") {
  DesignTask task = helical();
  task.over = {Aggregate::Quantile, 2.0, 0.5};
  DesignProblem problem(task);
  DesignLog log(nullptr);
  EpigraphProgram program(problem, log);
  (void)program.evaluate(program.start(), false);
  REQUIRE(program.is_majorant());
  CHECK(std::isnan(program.seen_by_rows().objective));
}

TEST_CASE("A candidate above its bound violates the epigraph", "[optimize][design]") {
  DesignProblem problem(helical());
  DesignLog log(nullptr);
  EpigraphProgram program(problem, log);
  Eigen::VectorXd y = program.start();
  y[y.size() - 1] *= 0.9;                                                  // promise 10 % less stress than there is
  CHECK(row_values(program, y).maxCoeff() == Approx(0.1).epsilon(1e-12));  // round-off
}

TEST_CASE("The log prefers the feasible, then the least objective, then the least violation", "[optimize][design]") {
  DesignTask task = helical({0.0});
  DesignProblem problem(task);
  // Every design's stress is bounded by that of the unmodified start plus a little.
  const Eigen::VectorXd start = problem.start();
  const double stress = problem.objective(problem.analyse(start, false));
  task.constraints = {{term(Output::PeakContactStress), 1.02 * stress}};
  DesignProblem bounded(task);
  std::vector<double> reported;
  DesignLog log([&](int, double best) { reported.push_back(best); });
  CHECK(log.best() == nullptr);

  const auto record = [&](const Eigen::VectorXd& x) { log.record(bounded, x, bounded.analyse(x, false)); };
  const Eigen::Vector3d much(1.0, 0.5, 1.0), less(0.7, 0.5, 0.7), slight(0.02, 0.5, 0.0);
  record(much);  // much crowning on aligned gears: far above the bound
  record(less);
  CHECK(log.best()->x == less);
  CHECK(log.best()->constraint_violation > DesignLog::tolerance);
  record(start);
  CHECK(log.best()->x == start);
  CHECK(log.best()->constraint_violation == 0.0);
  record(start);  // the same again is no new entry
  CHECK(log.entries().size() == 3);
  record(much);
  CHECK(log.best()->x == start);
  CHECK(log.best()->objective == Approx(stress).epsilon(1e-14));  // round-off
  CHECK(reported.size() == 4);
  record(slight);
  CHECK((log.best()->x == slight) == (log.entries().back().objective < stress));
}
