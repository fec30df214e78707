#include "optimize/design/scatter/draws.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "optimize/assessment/predicted_statistic.hpp"
#include "optimize/assessment/validation.hpp"
#include "optimize/design/scatter/scatter_search.hpp"
#include "optimize/design/scatter/statistic_model.hpp"
#include "optimize/sampling/distribution.hpp"
#include "optimize/sampling/sample_design.hpp"
#include "tests/optimize/design_tasks.hpp"
#include "tests/common/about.hpp"

namespace flankwright {

namespace {

constexpr int draws = 40;

/// One operating state of the drawn spur pairs: a torque over that of the task, and a misalignment beside the drawn one [um].
struct State {
  double torque{1.0};
  double misalignment{0.0};
};
constexpr State drive{1.0, 0.0}, coast{0.8, -9.0};

/// Draws of a spur pair in these states, with the same draws whatever the states: mesh misalignment normal with 8 um about 3.
DesignTask drawn(const Aggregation& statistic, const std::vector<State>& states) {
  DesignTask task = design_tasks::spur({0.0});
  task.objective = {design_tasks::term(Output::PeakContactStress)};
  task.over = statistic;
  const DesignScene listed = task.scenes.front();
  task.scenes.clear();
  const SampleDesign points(Sampler::Sobol, draws, 1, 1);
  for (int i = 0; i < draws; ++i) {
    for (const State& state : states) {
      DesignScene scene = listed;
      scene.draw = i;
      scene.torque *= state.torque;
      scene.condition.misalignment.mesh_misalignment = (Distribution::normal(3.0, 8.0).quantile(points.point(i)[0]) + state.misalignment) * units::um;
      task.scenes.push_back(std::move(scene));
    }
  }
  return task;
}

SolverOptions by_slsqp() {
  SolverOptions options;
  options.name = "nlopt:slsqp";
  return options;
}

const std::vector<double> start{10.0 * units::um, 0.0};

PerGear<Modification> crowned() {
  PerGear<Modification> gears;
  set(gears.pinion, parameter_of("lead_crowning"), 10.0 * units::um);
  return gears;
}

/// Statistics that do not fall where no measure falls.
const Aggregation statistics_tried[]{{Aggregate::Quantile, 2.0, 0.9}, {Aggregate::Cvar, 2.0, 0.8}, {Aggregate::Mean}, {Aggregate::Worst}};

double value_of(const DesignTask& task) {
  const DesignProblem problem(task);
  return statistic_over_draws(problem, task.combined_objective(), problem.analyse_design(crowned()));
}

}  // namespace

TEST_CASE("A draw lists its load cases, a load spectrum once and a scene of no draw by itself", "[optimize][design][scatter]") {
  std::vector<DesignScene> scenes(6);
  const int of_draw[]{0, 0, 1, 1, -1, -1}, of_spectrum[]{0, 0, 1, 2, 3, 3};
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    scenes[s].draw = of_draw[s];
    scenes[s].spectrum = of_spectrum[s];
  }
  CHECK(draws_of(scenes, false) == std::vector<std::vector<int>>{{0, 1}, {2, 3}, {4}, {5}});
  CHECK(draws_of(scenes, true) == std::vector<std::vector<int>>{{0}, {2, 3}, {4}});
  scenes[1].weight = 3.0;
  CHECK(draw_measures({{0, 1}, {2}}, scenes, Aggregate::Worst, {7.0, 5.0, 2.0}) == std::vector<double>{7.0, 2.0});
  CHECK(draw_measures({{0, 1}, {2}}, scenes, Aggregate::Mean, {8.0, 4.0, 2.0}) == std::vector<double>{5.0, 2.0});
  CHECK(std::isnan(draw_measures({{0, 1}}, scenes, Aggregate::Worst, {7.0, not_given}).front()));
}

TEST_CASE("The statistic of two operating states is at least that of each by itself with the same draws", "[optimize][design][scatter]") {
  for (const Aggregation& statistic : statistics_tried) {
    CAPTURE(to_string(statistic));
    const double both = value_of(drawn(statistic, {drive, coast}));
    CHECK(both >= value_of(drawn(statistic, {drive})));
    CHECK(both >= value_of(drawn(statistic, {coast})));
    CHECK(both > std::min(value_of(drawn(statistic, {drive})), value_of(drawn(statistic, {coast}))));
  }
}

TEST_CASE("A search over draws of two states finds the statistic that its design has, and none below that of one state",
          "[optimize][design][scatter]") {
  for (const Aggregation& statistic : {statistics_tried[0], statistics_tried[1], statistics_tried[2]}) {
    CAPTURE(to_string(statistic));
    const DesignTask task = drawn(statistic, {drive, coast});
    const ScatterDesign both = search_over_draws(task, start, by_slsqp());
    CHECK(both.status == SolverStatus::Converged);
    REQUIRE(both.measures.size() == draws);
    CHECK(both.decided_by <= draws);
    const DesignProblem problem(task);
    // Draws that do not decide have the measure of the screening, which keeps their order within the error of 12 positions.
    constexpr double of_screening = 5e-3;
    CHECK(both.value ==
          Approx(statistic_over_draws(problem, task.combined_objective(), problem.analyse_design(both.modification))).epsilon(of_screening));
    // Less freedom with more load cases, but for the tolerance of the searches.
    constexpr double of_searches = 5e-3;
    for (const State& state : {drive, coast})
      CHECK(both.value >= search_over_draws(drawn(statistic, {state}), start, by_slsqp()).value * (1.0 - of_searches));
  }
}

TEST_CASE("The model of a draw with two load cases is exact at the design analysed", "[optimize][design][scatter]") {
  for (const Aggregation& within : {Aggregation{Aggregate::Worst}, Aggregation{Aggregate::Mean}}) {
    CAPTURE(to_string(within));
    DesignTask task = drawn(statistics_tried[1], {drive, coast});
    task.within_draw = within;
    DesignProblem problem(task);
    StatisticModel model(problem, task.combined_objective(), within);
    REQUIRE(model.draws() == draws);
    const Eigen::VectorXd x = Eigen::Vector2d(0.31, 0.58), step = Eigen::Vector2d(1e-3, -1e-3);
    const DesignAnalysis analysis = problem.analyse(x, true);
    for (int i = 0; i < draws; ++i) model.set(i, model.linear(problem, analysis, i, x));
    constexpr double round_off = 1e-12;
    const double at = statistic_over_draws(problem, task.combined_objective(), analysis);
    CHECK(model.statistic(model.measures(x, draws)) == Approx(at).epsilon(round_off));
    const double beside = statistic_over_draws(problem, task.combined_objective(), problem.analyse(x + step, false));
    constexpr double of_second_order = 0.05;  // of a change of 0.1 % of the ranges
    CHECK(model.statistic(model.measures(x + step, draws)) == tests::about(beside, of_second_order * std::abs(beside - at) + 1e-5 * beside));
  }
}

TEST_CASE("A smoothed quantile is the mean of the quantiles within two standard errors, at most four fifths of the tail",
          "[optimize][design][scatter]") {
  constexpr int many = 2000;
  constexpr double level = 0.9;
  DesignTask task = drawn({Aggregate::Quantile, 2.0, level}, {State{}});
  const DesignScene listed = task.scenes.front();
  task.scenes.assign(many, listed);
  for (int i = 0; i < many; ++i) task.scenes[static_cast<std::size_t>(i)].draw = i;
  const DesignProblem problem(task);
  StatisticModel model(problem, task.combined_objective());
  // Measures of an exponential distribution, in another order than that of their size.
  std::vector<double> measures;
  for (int i = 0; i < many; ++i) measures.push_back(-std::log(1.0 - ((7 * i) % many + 0.5) / many));
  const double step = 1.0 / (many * (1.0 - level));  // discretisation: from one measure to the next at this level
  CHECK(model.statistic(measures) == tests::about(-std::log(1.0 - level), step));
  double last = model.statistic(measures);
  for (int told_apart : {500, 200, 2}) {
    CAPTURE(told_apart);
    model.smooth(told_apart);
    const double band = std::min(2.0 * std::sqrt(level * (1.0 - level) / told_apart), 0.8 * (1.0 - level));
    // The integral of -log(1 - q) is (1 - q) (log(1 - q) - 1).
    const auto integral = [](double q) { return (1.0 - q) * (std::log(1.0 - q) - 1.0); };
    const double mean = (integral(level + band) - integral(level - band)) / (2.0 * band);
    CHECK(model.statistic(measures) == tests::about(mean, 5.0 * step));  // the highest of the levels is less finely divided
    CHECK(model.statistic(measures) > last);                             // a tail that rises ever more steeply raises the mean
    last = model.statistic(measures);
    const std::vector<double> by = model.statistic_weights(measures);
    double sum = 0.0;
    for (std::size_t i = 0; i < by.size(); ++i) {
      sum += by[i];
      if (by[i] != 0.0) CHECK(std::abs(1.0 - std::exp(-measures[i]) - level) <= band + 1.0 / many);
    }
    constexpr double round_off = 1e-12;
    CHECK(sum == Approx(1.0).epsilon(round_off));
  }
  model.exact();
  CHECK(model.statistic(measures) == tests::about(-std::log(1.0 - level), step));
}

TEST_CASE("What a drawn gear differs by is ground on it like its design, whichever flank it loads", "[optimize][design][scatter]") {
  const ModificationParameter slope = parameter_of("lead_slope");
  DesignScene drawn_gear = design_tasks::spur({0.0}).scenes.front(), exact = drawn_gear;
  drawn_gear.condition.other_flanks = exact.condition.other_flanks = GENERATE(false, true);
  drawn_gear.deviations = {{.member = Member::Pinion, .parameter = slope, .value = 5.0 * units::um}};
  PerGear<Modification> design = crowned(), ground = design;
  set(ground.pinion, slope, 5.0 * units::um);
  const double of_drawn = get(drawn_gear.with_design(design).modification.pinion, slope);
  CHECK(of_drawn == get(exact.with_design(ground).modification.pinion, slope));
  CHECK(of_drawn == (exact.condition.other_flanks ? -5.0 : 5.0) * units::um);  // it removes at the other end as that flank sees it
}

TEST_CASE("Designs are tried and predicted by draws and not by their load cases", "[optimize][assessment][scatter]") {
  const DesignTask task = drawn(statistics_tried[0], {drive, coast});
  const std::vector<double> both = validate_designs(task, task.scenes, {{"crowned", "", crowned()}}).front().measures;
  REQUIRE(both.size() == draws);
  std::vector<double> worst(draws, 0.0);
  for (const State& state : {drive, coast}) {
    const DesignTask alone = drawn(statistics_tried[0], {state});
    const std::vector<double> measures = validate_designs(alone, alone.scenes, {{"crowned", "", crowned()}}).front().measures;
    for (std::size_t i = 0; i < draws; ++i) worst[i] = std::max(worst[i], measures[i]);
  }
  CHECK(both == worst);
  const PredictedStatistic predicted = predict_statistic(task, crowned());
  CHECK(predicted.value == aggregate(task.over, both, std::vector<double>(draws, 1.0)));
  CHECK(predicted.failed == 0);
}

}  // namespace flankwright
