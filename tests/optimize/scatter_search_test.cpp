#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/assessment/validation.hpp"
#include "optimize/design/search/direct_program.hpp"
#include "optimize/design/search/local_run.hpp"
#include "optimize/design/scatter/model_step.hpp"
#include "optimize/design/scatter/scatter_search.hpp"
#include "optimize/design/scatter/screening.hpp"
#include "optimize/design/two_level.hpp"
#include "optimize/sampling/distribution.hpp"
#include "optimize/sampling/sample_design.hpp"
#include "tests/common/random.hpp"
#include "tests/optimize/design_tasks.hpp"
#include "tests/common/about.hpp"

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
  CHECK(get(m, parameter_of("addendum_crowning")) == tests::about(7.0 * units::um, round_off));
  CHECK(get(m, parameter_of("dedendum_crowning")) == tests::about(3.0 * units::um, round_off));
}

TEST_CASE("A relief of a drawn gear is never less than none, and no longer changes with the design there", "[optimize][design][scatter][gradient]") {
  constexpr auto relief = parameter_of("tip_relief.amount");
  DesignTask task = over_draws({Aggregate::Mean}, 12);
  task.objective = {design_tasks::term(Output::TeHarmonic, 1)};
  set(task.modification.pinion, parameter_of("tip_relief.height"), 2.0);
  task.variables = {{.path = "relief", .member = Member::Pinion, .parameter = relief, .lower = 0.0, .upper = 20.0 * units::um}};
  for (std::size_t i = 0; i < task.scenes.size(); ++i) {
    task.scenes[i].deviations = {{Member::Pinion, relief, (static_cast<double>(i) - 6.0) * units::um}};
  }
  DesignProblem problem(task);
  PerGear<Modification> design = task.modification;
  set(design.pinion, relief, 3.5 * units::um);
  const auto of_draw = [&](std::size_t i) { return get(task.scenes[i].with_design(design).modification.pinion, relief); };
  constexpr double round_off = 1e-15;  // mm
  CHECK(of_draw(0) == 0.0);
  CHECK(of_draw(2) == 0.0);
  CHECK(of_draw(3) == tests::about(0.5 * units::um, round_off));
  DesignLog log(nullptr);
  DirectProgram program(problem, log);
  const Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 3.5 / 20.0), step = Eigen::VectorXd::Constant(1, 1e-5);
  const double gradient = program.evaluate(x, true).objective_gradient[0];
  const double difference = (program.evaluate(x + step, false).objective - program.evaluate(x - step, false).objective) / (2.0 * step[0]);
  constexpr double discretisation = 1e-3;  // of the differences
  CHECK(gradient == Approx(difference).epsilon(discretisation));
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

TEST_CASE("The search over draws finds what a grid of designs finds", "[optimize][design][scatter]") {
  constexpr int steps = 6, draws = 30;
  const std::vector<double> weights(draws, 1.0);
  DesignProblem whole(over_draws(Aggregate::Mean, draws));
  std::vector<std::vector<double>> grid;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      const Eigen::Vector2d x(static_cast<double>(i) / steps, static_cast<double>(j) / steps);
      grid.push_back(whole.scene_measures(whole.task().combined_objective(), whole.analyse(x, false)));
    }
  }
  for (const Aggregation& statistic : statistics) {
    CAPTURE(to_string(statistic));
    double least = INFINITY;
    for (const std::vector<double>& measures : grid) least = std::min(least, aggregate(statistic, measures, weights));
    const std::vector<double> start{10.0 * units::um, 0.0};
    const ScatterDesign found = search_over_draws(over_draws(statistic, draws), start, slsqp());
    CHECK(found.status == SolverStatus::Converged);
    // A quantile is searched smoothed over the levels that 30 draws do not tell apart: the best of the sample may be some per cent below.
    const double tolerance = statistic == Aggregate::Quantile ? 0.03 : 0.002;
    CHECK(found.value <= (1.0 + tolerance) * least);
    const auto of = [&](const Eigen::VectorXd& x) {
      return aggregate(statistic, whole.scene_measures(whole.task().combined_objective(), whole.analyse(x, false)), weights);
    };
    CHECK(found.value <= of(whole.scaled_design(start)));
    constexpr double by_start = 1e-9;  // relative: loads begin from those of another design, see DesignProblem::analyse()
    CHECK(found.value == Approx(of(found.x)).epsilon(by_start));
  }
}

TEST_CASE("An amount below the smallest is left out or raised in a search over draws, whichever is better", "[optimize][design][scatter][grinding]") {
  constexpr int draws = 40;
  constexpr double settled = 0.01;  // relative: a search ends where a step promises a quarter of a per cent, and both do
  const std::vector<double> start{10.0 * units::um, 0.0};
  for (const Aggregation& statistic : {Aggregation{Aggregate::Cvar, 2.0, 0.8}, Aggregation{Aggregate::MeanPlusSigmas, 2.0}}) {
    CAPTURE(to_string(statistic));
    DesignTask task = over_draws(statistic, draws);
    const ScatterDesign free = search_over_draws(task, start, slsqp());
    const double slope = DesignProblem(task).unscaled(free.x, 1);
    REQUIRE(std::abs(slope) > 0.5 * units::um);
    const double smallest = 1.6 * std::abs(slope);
    task.grindable.smallest = smallest;
    const ScatterDesign found = search_over_draws(task, start, slsqp());
    REQUIRE(found.choices.size() == 1);
    const GrindingChoice& choice = found.choices.front();
    CHECK(choice.amounts.front().found == Approx(slope).epsilon(1e-12));
    REQUIRE(choice.tried.size() == 2);
    CHECK(choice.tried[0].value == 0.0);
    // Independent routes: each alternative searched by itself in the range that it leaves.
    DesignTask without = over_draws(statistic, draws), raised = without;
    without.variables.pop_back();
    (slope > 0.0 ? raised.variables[1].lower : raised.variables[1].upper) = std::copysign(smallest, slope);
    const double of_none = search_over_draws(without, {start[0]}, slsqp()).value, of_more = search_over_draws(raised, start, slsqp()).value;
    CHECK(choice.tried[0].objective == Approx(of_none).epsilon(settled));
    CHECK(choice.tried[1].objective == Approx(of_more).epsilon(settled));
    CHECK(choice.tried[choice.taken].objective <= choice.tried[1 - choice.taken].objective);
    CHECK(found.value == Approx(choice.tried[choice.taken].objective).epsilon(1e-9));  // loads begin from those of another design
    CHECK(found.exact_value == free.value);
    const double kept = std::abs(DesignProblem(task).unscaled(found.x, 1));
    CHECK((kept < 1e-12 || kept >= smallest * (1.0 - 1e-12)));  // round-off
  }
}

TEST_CASE("Rounding over draws keeps what was left out and what was raised", "[optimize][design][scatter][grinding][rounding]") {
  DesignTask task = over_draws({Aggregate::Quantile, 2.0, 0.9}, 30);
  for (DesignVariable& v : task.variables) v.step = 2.0 * units::um;
  task.grindable.smallest = 7.0 * units::um;
  const ScatterDesign found = search_over_draws(task, {10.0 * units::um, 0.0}, slsqp());
  REQUIRE(!found.choices.empty());
  const DesignProblem problem(task);
  for (int i = 0; i < 2; ++i) {
    const double value = problem.unscaled(found.x, i), steps = value / (2.0 * units::um);
    CHECK(std::abs(steps - std::round(steps)) < 1e-9);  // round-off
    CHECK((std::abs(value) < 1e-12 || std::abs(value) >= task.grindable.smallest));
  }
}

TEST_CASE("Of two modifications that are not ground together a search over draws leaves one", "[optimize][design][scatter][grinding]") {
  DesignTask task = over_draws({Aggregate::Mean}, 30);
  task.grindable.not_together = {{Member::Pinion, crowning, parameter_of("lead_slope")}};
  const ScatterDesign found = search_over_draws(task, {10.0 * units::um, 0.0}, slsqp());
  REQUIRE(found.choices.size() == 1);
  REQUIRE(found.choices.front().is_of_pair());
  const Modification& pinion = found.modification.pinion;
  const bool is_crowned = get(pinion, crowning) != 0.0, is_sloped = get(pinion, parameter_of("lead_slope")) != 0.0;
  CHECK_FALSE((is_crowned && is_sloped));
  for (const GrindingAlternative& tried : found.choices.front().tried) CHECK(found.value <= tried.objective * (1.0 + 1e-9));  // as above
}

TEST_CASE("A lower limit on the film holds in as many draws as the quantile says", "[optimize][design][scatter][life]") {
  constexpr int draws = 40;
  constexpr double level = 0.9;
  const std::vector<double> start{0.0, 0.0};
  const Aggregation statistic{Aggregate::Quantile, 2.0, level};
  DesignTask task = over_draws(statistic, draws);
  task.objective = {design_tasks::term(Output::TePeakToPeak)};
  LifeModel life;
  life.lubricant = Lubricant{.viscosity_40 = 220.0, .viscosity_100 = 19.0, .temperature = 80.0};
  life.roughness = 0.5;
  task.life = std::make_shared<const LifeModel>(life);
  for (DesignScene& scene : task.scenes) scene.operation = {1e6, 150.0, 3600.0, not_given};
  const ObjectiveTerm film = design_tasks::term(Output::SpecificFilmThickness);
  const DesignProblem whole(task);
  // Independent route: the film of every draw, and how many have less.
  const auto films_of = [&](const ScatterDesign& design) {
    const DesignAnalysis analysis = whole.analyse_design(design.modification);
    std::vector<double> films;
    for (int s = 0; s < whole.scenes(); ++s) films.push_back(output_value(film, whole.scene(analysis, s)));
    std::ranges::sort(films);
    return films;
  };
  const auto kept_by = [&](double film_at_least) {
    DesignTask limited = task;
    ObjectiveTerm reciprocal = film;
    reciprocal.reciprocal = true;
    limited.objective_bounds = {{{{reciprocal}, statistic}, 1.0 / film_at_least}};
    return search_over_draws(limited, start, slsqp());
  };
  constexpr std::size_t beyond = 4;  // of 40 draws the quantile leaves out four
  const std::vector<double> of_te = films_of(search_over_draws(task, start, slsqp())), of_film = films_of(kept_by(100.0));
  CAPTURE(of_te[beyond], of_film[beyond]);
  REQUIRE(of_film[beyond] > 1.02 * of_te[beyond]);  // the transmission error alone would not keep a limit between
  const double limit = 0.5 * (of_te[beyond] + of_film[beyond]);
  const ScatterDesign found = kept_by(limit);
  CHECK(found.status == SolverStatus::Converged);
  const std::vector<double> films = films_of(found);
  constexpr double kept = 1e-5;  // relative: DesignLog::tolerance, and loads that begin from those of another design
  CHECK(films[beyond] >= limit * (1.0 - kept));
  CHECK(found.bounds.front() == Approx(1.0 / films[beyond]).epsilon(kept));
}

TEST_CASE("The reciprocal of the largest of several points is refused, since it is not the largest of theirs",
          "[optimize][design][scatter][errors]") {
  DesignTask task = over_draws({Aggregate::Mean}, 2);
  ObjectiveTerm stress = design_tasks::term(Output::PeakContactStress);
  stress.reciprocal = true;
  task.objective_bounds = {{{{stress}, Aggregate::Mean}, 1e-3}};
  CHECK_THROWS_WITH(DesignProblem(task), Catch::Contains("an upper bound"));
}

TEST_CASE("A design chosen over draws lies on the steps, and no neighbour is better by what draws do not tell apart", "[optimize][design][scatter]") {
  constexpr int draws = 30;
  constexpr double step = 3.0 * units::um;
  const std::vector<double> weights(draws, 1.0), start{10.0 * units::um, 0.0};
  DesignProblem whole(over_draws(Aggregate::Mean, draws));
  for (const Aggregation& statistic : statistics) {
    CAPTURE(to_string(statistic));
    DesignTask task = over_draws(statistic, draws);
    for (DesignVariable& v : task.variables) v.step = step;
    const ScatterDesign found = search_over_draws(task, start, slsqp());
    const auto of = [&](const Eigen::VectorXd& x) {
      return aggregate(statistic, whole.scene_measures(whole.task().combined_objective(), whole.analyse(x, false)), weights);
    };
    constexpr double by_start = 1e-9;  // relative: loads begin from those of another design, see DesignProblem::analyse()
    CHECK(found.value == Approx(of(found.x)).epsilon(by_start));
    for (int i = 0; i < whole.variables(); ++i) {
      const double steps = whole.unscaled(found.x, i) / step;
      CHECK(steps == tests::about(std::round(steps), 1e-9));  // round-off
    }
    // Independent route: every neighbour by one step, pairs as well, at all draws. The model tells them apart to first order in what it knows of each draw.
    constexpr double of_model = 0.01;
    for (const int a : {-1, 0, 1}) {
      for (const int b : {-1, 0, 1}) {
        const Eigen::VectorXd x = whole.scaled_design({whole.unscaled(found.x, 0) + a * step, whole.unscaled(found.x, 1) + b * step});
        if (x.minCoeff() < 0.0 || x.maxCoeff() > 1.0) continue;
        CAPTURE(a, b);
        CHECK(found.value <= (1.0 + of_model) * of(x));
      }
    }
  }
}

TEST_CASE("Few draws are analysed as the task asks, and the statistic is that of all of them", "[optimize][design][scatter]") {
  DesignTask task = over_draws(statistics[0], 150);
  task.resolution.quadrature = {QuadratureRule::Graded, 8};
  const ScatterDesign found = search_over_draws(task, {10.0 * units::um, 0.0}, slsqp());
  CHECK(found.status == SolverStatus::Converged);
  CHECK(found.decided_by < 75);
  CHECK(found.screening_cycles < found.cycles);
  DesignProblem whole(task);
  constexpr double by_start = 1e-9;  // as above
  CHECK(found.value == Approx(whole.objective(whole.analyse(found.x, false))).epsilon(by_start));
}

TEST_CASE("A search from a design found over the same draws ends where the screening knows no better one", "[optimize][design][scatter]") {
  DesignTask task = over_draws({Aggregate::Quantile, 2.0, 0.9});
  task.resolution.quadrature = {QuadratureRule::Graded, 8};
  REQUIRE(can_be_coarser(task));
  const ScatterDesign found = search_over_draws(task, {0.0, 0.0}, slsqp());
  const DesignProblem problem(task);
  const ScatterDesign again =
      search_over_draws(task, {problem.unscaled(found.x, 0), problem.unscaled(found.x, 1)}, slsqp(), ScatterStart::FoundOverTheseDraws);
  CHECK(again.status == SolverStatus::Converged);
  CHECK(std::isnan(again.value));
  CHECK((again.x - found.x).cwiseAbs().maxCoeff() < 1e-12);  // round-off
  CHECK(again.cycles == again.screening_cycles);
  // Where the screening does know one, it is searched for to the end.
  CHECK(search_over_draws(task, {0.0, 0.0}, slsqp(), ScatterStart::FoundOverTheseDraws).value == found.value);
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

TEST_CASE("The shortest step within rows is their nearest point, and none where they exclude each other", "[optimize][design][scatter]") {
  Eigen::MatrixXd slopes(2, 2);
  slopes << -1.0, -1.0, 1.0, 0.0;
  constexpr double round_off = 1e-12;
  // Nearest to 0 with d_1 + d_2 >= 1: (1/2, 1/2); with d_1 <= 1/4 as well: (1/4, 3/4).
  const auto free = shortest_within(slopes, Eigen::Vector2d(-1.0, 1.0), 2.0), held = shortest_within(slopes, Eigen::Vector2d(-1.0, 0.25), 2.0);
  REQUIRE(free);
  REQUIRE(held);
  CHECK((*free - Eigen::Vector2d(0.5, 0.5)).norm() < round_off);
  CHECK((*held - Eigen::Vector2d(0.25, 0.75)).norm() < round_off);
  slopes << -1.0, 0.0, 1.0, 0.0;
  CHECK_FALSE(shortest_within(slopes, Eigen::Vector2d(-1.0, 0.5), 2.0));
}

TEST_CASE("A statistic is modelled exactly at the design analysed, and to first order beside it", "[optimize][design][scatter]") {
  for (const Aggregation& statistic : statistics) {
    CAPTURE(to_string(statistic));
    DesignProblem problem(over_draws(statistic, 20));
    StatisticModel model(problem, problem.task().combined_objective());
    const Eigen::VectorXd x = Eigen::Vector2d(0.31, 0.58), step = Eigen::Vector2d(1e-3, -1e-3);
    const DesignAnalysis analysis = problem.analyse(x, true);
    for (int i = 0; i < model.draws(); ++i) model.set(i, model.linear(problem, analysis, i, x));
    constexpr double round_off = 1e-12;
    CHECK(model.statistic(model.measures(x, 20)) == Approx(problem.objective(analysis)).epsilon(round_off));
    const double beside = problem.objective(problem.analyse(x + step, false));
    const double change = beside - problem.objective(analysis);
    constexpr double of_second_order = 0.05;  // of a change of 0.1 % of the ranges
    CHECK(model.statistic(model.measures(x + step, 20)) == tests::about(beside, of_second_order * std::abs(change) + 1e-5 * beside));
  }
}

TEST_CASE("A guess screens the draws that decide a quantile, whatever it is wrong about", "[optimize][design][scatter]") {
  tests::Random32 random(3);
  const std::vector<double> weights(400, 1.0);
  const Aggregation quantile{Aggregate::Quantile, 2.0, 0.95};
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> truth, guess;
    for (int i = 0; i < 400; ++i) {
      truth.push_back(500.0 + 30.0 * random.normal());
      guess.push_back(truth.back() * (1.0 + 0.005 * random.normal()));
    }
    guess[static_cast<std::size_t>(trial)] = INFINITY;  // a draw of which nothing is known
    const std::vector<int> analysed = screen(
        guess, 20, [&](const std::vector<double>& measures) { return aggregate_weights(quantile, measures, weights); },
        [&](const std::vector<int>& draws) {
          std::vector<double> measures;
          for (const int draw : draws) measures.push_back(truth[static_cast<std::size_t>(draw)]);
          return measures;
        });
    CHECK(aggregate(quantile, guess, weights) == aggregate(quantile, truth, weights));
    CHECK(analysed.size() < 100);
  }
}
