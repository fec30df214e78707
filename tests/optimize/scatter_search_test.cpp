#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/assessment/validation.hpp"
#include "optimize/design/direct_program.hpp"
#include "optimize/design/local_run.hpp"
#include "optimize/design/scatter_search.hpp"
#include "optimize/sampling/distribution.hpp"
#include "optimize/sampling/sample_design.hpp"
#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;

namespace {

constexpr auto crowning = parameter_of("lead_crowning");

/// Draws of a spur pair: mesh misalignment normal with 8 um about 3, crowning within 4 um of the design.
std::vector<DesignScene> drawn_scenes_of(const DesignTask& task, int draws, unsigned long seed) {
  const SampleDesign points(Sampler::Sobol, draws, 2, seed);
  const Distribution misalignment = Distribution::normal(3.0, 8.0), form = Distribution::within_tolerance(4.0);
  std::vector<DesignScene> scenes;
  for (int i = 0; i < draws; ++i) {
    DesignScene scene = task.scenes.front();
    scene.name = "drawn " + std::to_string(i + 1);
    scene.condition.misalignment.mesh_misalignment = misalignment.quantile(points.point(i)[0]) * units::um;
    scene.deviations = {{Member::Pinion, crowning, form.quantile(points.point(i)[1]) * units::um}};
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

DesignTask over_draws(const Aggregation& statistic, int draws = 40, unsigned long seed = 1) {
  DesignTask task = design_tasks::spur({0.0});
  task.objective = {design_tasks::term(Output::PeakContactStress)};
  task.scenes = drawn_scenes_of(task, draws, seed);
  task.over = statistic;
  return task;
}

SolverOptions slsqp() {
  SolverOptions options;
  options.name = "nlopt:slsqp";
  return options;
}

const Aggregation statistics[]{{Aggregate::Quantile, 2.0, 0.9}, {Aggregate::Cvar, 2.0, 0.8}, {Aggregate::MeanPlusSigmas, 2.0}, {Aggregate::Mean}};

}  // namespace

TEST_CASE("A deviation of a drawn gear is the same as a design that has it", "[optimize][design][scatter]") {
  DesignTask task = design_tasks::spur({5.0});
  task.scenes.front().deviations = {{Member::Pinion, crowning, 3.0 * units::um}};
  const DesignProblem drawn(task), plain(design_tasks::spur({5.0}));
  PerGear<Modification> design, made;
  set(design.pinion, crowning, 7.0 * units::um);
  set(made.pinion, crowning, 10.0 * units::um);
  CHECK(drawn.scene_measure(drawn.analyse_design(design), 0) == plain.scene_measure(plain.analyse_design(made), 0));
}

TEST_CASE("A deviation of the profile crowning keeps the difference of its halves", "[optimize][design][scatter]") {
  PerGear<Modification> gears;
  Modification& m = gears.wheel;
  set(m, parameter_of("addendum_crowning"), 5.0 * units::um);
  set(m, parameter_of("dedendum_crowning"), 1.0 * units::um);
  ModificationDeviation{Member::Wheel, parameter_of("profile_crowning"), 2.0 * units::um}.add_to(gears);
  constexpr double round_off = 1e-15;  // mm
  CHECK(get(m, parameter_of("addendum_crowning")) == Approx(7.0 * units::um).margin(round_off));
  CHECK(get(m, parameter_of("dedendum_crowning")) == Approx(3.0 * units::um).margin(round_off));
}

TEST_CASE("Gradients of the statistics over draws are what central differences say", "[optimize][design][scatter][gradient]") {
  constexpr double step = 1e-5;
  constexpr double discretisation = 1e-3;  // of the gradient: contact points that come and go within a step, as in any mesh analysis of 8 positions
  for (const Aggregation& statistic : statistics) {
    CAPTURE(to_string(statistic));
    DesignProblem problem(over_draws(statistic, 20));
    DesignLog log(nullptr);
    DirectProgram program(problem, log);
    const Eigen::VectorXd x = Eigen::Vector2d(0.31, 0.58);
    const Eigen::VectorXd gradient = program.evaluate(x, true).objective_gradient;
    for (int i = 0; i < 2; ++i) {
      const Eigen::VectorXd shift = step * Eigen::VectorXd::Unit(2, i);
      const double difference = (program.evaluate(x + shift, false).objective - program.evaluate(x - shift, false).objective) / (2.0 * step);
      CHECK(gradient[i] == Approx(difference).epsilon(discretisation).margin(discretisation * gradient.lpNorm<Eigen::Infinity>()));
    }
  }
}

TEST_CASE("The search over draws finds what a search over all of them finds", "[optimize][design][scatter]") {
  for (const Aggregation& statistic : {statistics[0], statistics[1]}) {
    CAPTURE(to_string(statistic));
    const DesignTask task = over_draws(statistic);
    const ScatterDesign found = search_over_draws(task, {10.0 * units::um, 0.0}, slsqp());
    DesignProblem whole(task);
    whole.set_start(whole.scaled_design({10.0 * units::um, 0.0}));
    const LocalRun run = run_local(whole, slsqp());
    // Both are local searches that end within their tolerance: 0.2 % of a statistic that is flat at its optimum.
    CHECK(found.value <= 1.002 * run.objective);
    CHECK(found.value <= found.start_value);
    CHECK(found.searched < task.scenes.size());
    constexpr double by_start = 1e-9;  // relative: loads begin from those of another design, see DesignProblem::analyse()
    CHECK(found.value == Approx(whole.objective(whole.analyse(found.x, false))).epsilon(by_start));
  }
}

TEST_CASE("A design chosen over draws beats the nominal one on fresh draws", "[optimize][design][scatter]") {
  DesignTask nominal_task = design_tasks::spur({0.0});
  nominal_task.objective = {design_tasks::term(Output::PeakContactStress)};
  DesignProblem nominal_problem(nominal_task);
  const LocalRun nominal = run_local(nominal_problem, slsqp());
  for (const Aggregation& statistic : statistics) {
    CAPTURE(to_string(statistic));
    const DesignTask task = over_draws(statistic);
    std::vector<double> start;
    for (int i = 0; i < 2; ++i) start.push_back(nominal_problem.unscaled(nominal.x, i));
    const ScatterDesign found = search_over_draws(task, start, slsqp());
    const auto tried = validate_designs(nominal_task, drawn_scenes_of(nominal_task, 200, 2),
                                        {{"nominal", "", nominal_problem.modification(nominal.x)}, {"over draws", "", found.modification}});
    const std::vector<double> weights(200, 1.0);
    const double of_nominal = aggregate(statistic, tried[0].measures, weights), of_found = aggregate(statistic, tried[1].measures, weights);
    CHECK(of_found < 0.98 * of_nominal);
    CHECK(found.value == Approx(of_found).epsilon(0.05));  // sampling error of 40 draws
  }
}

TEST_CASE("The same draws give the same design, whatever the number of threads", "[optimize][design][scatter]") {
  const DesignTask task = over_draws(statistics[0], 20);
  const std::vector<double> start{10.0 * units::um, 0.0};
  const ScatterDesign first = search_over_draws(task, start, slsqp());
  ScatterDesign alone;
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    alone = search_over_draws(task, start, slsqp());
  }
  CHECK(first.x == alone.x);
  CHECK(first.measures == alone.measures);
  CHECK(search_over_draws(over_draws(statistics[0], 20, 7), start, slsqp()).x != first.x);
}

TEST_CASE("A bound on the statistic of another output is kept over the draws", "[optimize][design][scatter]") {
  DesignTask task = over_draws(statistics[0]);
  const std::vector<double> start{10.0 * units::um, 0.0};
  const ScatterDesign free = search_over_draws(task, start, slsqp());
  const Objective te{{design_tasks::term(Output::TePeakToPeak)}, statistics[0]};
  DesignProblem problem(task);
  const double of_free = problem.value(te, problem.analyse(free.x, false));
  constexpr double tighter = 0.99;  // the least that crowning and slope reach is 0.98
  task.objective_bounds = {{te, tighter * of_free}};
  const ScatterDesign bounded = search_over_draws(task, start, slsqp());
  CHECK(bounded.violation <= DesignLog::tolerance);
  CHECK(bounded.bounds.front() <= (1.0 + DesignLog::tolerance) * tighter * of_free);
  CHECK(bounded.value >= free.value * (1.0 - 1e-3));  // less freedom, but for the tolerance of the searches
}
