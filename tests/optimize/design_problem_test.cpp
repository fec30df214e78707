#include "optimize/design/problem/design_problem.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>

#include "optimize/design/more_intervals.hpp"
#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

void check_same_bits(const DesignAnalysis& a, const DesignAnalysis& b) {
  REQUIRE(a.cycles.size() == b.cycles.size());
  for (std::size_t s = 0; s < a.cycles.size(); ++s) {
    for (std::size_t i = 0; i < a.cycles[s].positions.size(); ++i) {
      const LoadedPosition &p = a.cycles[s].positions[i], &q = b.cycles[s].positions[i];
      CHECK(p.load.line_load == q.load.line_load);
      CHECK(p.load.transmission_error == q.load.transmission_error);
      CHECK(p.contact_stress == q.contact_stress);
      CHECK(p.contact_stress_derivative == q.contact_stress_derivative);
      CHECK(p.transmission_error_derivative == q.transmission_error_derivative);
    }
  }
}

}  // namespace

TEST_CASE("The start is the given modification, moved into the bounds", "[optimize][design]") {
  DesignTask task = helical();
  task.modification.pinion.lead_crowning = 0.010;      // of 0 .. 0.040
  task.modification.pinion.lead_slope = -0.050;        // below -0.020
  task.modification.pinion.addendum_crowning = 0.040;  // profile crowning is the mean of both halves: 0.035 of 0 .. 0.030
  task.modification.pinion.dedendum_crowning = 0.030;
  const DesignProblem problem(task);
  constexpr double round_off = 1e-15;
  CHECK(problem.start()[0] == Approx(0.25).epsilon(round_off));
  CHECK(problem.start()[1] == 0.0);
  CHECK(problem.start()[2] == 1.0);
}

TEST_CASE("A scaled design sets what is varied and nothing else", "[optimize][design]") {
  DesignTask task = helical();
  task.modification.pinion.twist = 0.007;
  task.modification.wheel.lead_crowning = 0.003;
  task.modification.wheel.tip_relief = {0.010, 2.0, ReliefShape::Parabolic};
  const DesignProblem problem(task);
  const auto [pinion, wheel] = problem.modification(Eigen::Vector3d(0.5, 0.25, 1.0));
  constexpr double round_off = 1e-15;
  CHECK(pinion.lead_crowning == Approx(0.020).epsilon(round_off));
  CHECK(pinion.lead_slope == Approx(-0.010).epsilon(round_off));
  CHECK(pinion.addendum_crowning == Approx(0.030).epsilon(round_off));
  CHECK(pinion.dedendum_crowning == Approx(0.030).epsilon(round_off));
  CHECK(pinion.twist == 0.007);
  CHECK(wheel.lead_crowning == 0.003);
  CHECK(wheel.tip_relief.shape == ReliefShape::Parabolic);
  CHECK(problem.unscaled(Eigen::Vector3d(0.5, 0.25, 1.0), 1) == Approx(-0.010).epsilon(round_off));
  CHECK(problem.scaled_design({0.020, -0.010, 0.030}).isApprox(Eigen::Vector3d(0.5, 0.25, 1.0), round_off));
  const Eigen::VectorXd scaled = problem.scaled(Eigen::Vector3d(1.0, 2.0, -3.0));
  CHECK(scaled.isApprox(Eigen::Vector3d(0.040, 0.080, -0.090), round_off));
}

TEST_CASE("A design is analysed once, and again only for derivatives it lacks", "[optimize][design]") {
  DesignProblem problem(helical({0.0}));
  const Eigen::Vector3d x(0.5, 0.5, 0.5), y(0.4, 0.5, 0.5);
  problem.analyse(x, false);
  problem.analyse(x, false);
  CHECK(problem.analyses() == 1);
  CHECK(problem.analyse(x, true).cycles.front().positions.front().transmission_error_derivative.size() == 3);
  CHECK(problem.analyses() == 2);
  CHECK(problem.analyse(x, false).cycles.front().positions.front().transmission_error_derivative.size() == 3);
  CHECK(problem.analyses() == 2);
  problem.analyse(y, true);
  CHECK(problem.analyses() == 3);
}

TEST_CASE("A task that cannot be done is refused by name", "[optimize][design]") {
  const auto field = [](const DesignTask& task) -> std::string {
    try {
      const DesignProblem problem(task);
    } catch (const InvalidInput& problem) {
      return problem.field();
    }
    return "nothing";
  };
  DesignTask task = helical();
  CHECK(field(task) == "nothing");
  task.scenes.clear();
  CHECK(field(task) == "scenes");
  task = helical();
  task.variables.clear();
  CHECK(field(task) == "optimise.variables");
  task = helical();
  task.objective.clear();
  CHECK(field(task) == "optimise.objective");
  task = helical();
  task.variables[1].lower = task.variables[1].upper;
  CHECK(field(task) == "optimise.variables.pinion.modification.lead_slope");
  task = helical();
  task.scenes[2].torque = 0.0;
  CHECK(field(task) == "load.torque");
}

TEST_CASE("Root stress without a model of it is refused", "[optimize][design][root-stress]") {
  DesignTask task = helical({0.0}, 4);
  task.objective = {term(Output::PeakRootStress)};
  CHECK_NOTHROW(DesignProblem(task));
  task.root_stress = nullptr;
  CHECK_THROWS_AS(DesignProblem(task), InvalidInput);
  task.objective = {term(Output::PeakContactStress)};
  CHECK_NOTHROW(DesignProblem(task));
  task.constraints = {{term(Output::PeakRootStress), 400.0}};
  CHECK_THROWS_AS(DesignProblem(task), InvalidInput);
}

TEST_CASE("A harmonic that the mesh positions do not resolve is refused", "[optimize][design]") {
  DesignTask task = helical({0.0}, 8);
  task.objective = {term(Output::TeHarmonic, 3)};
  CHECK_NOTHROW(DesignProblem(task));
  task.objective = {term(Output::TeHarmonic, 4)};  // two positions to a period: the amplitude depends on where they fall
  CHECK_THROWS_AS(DesignProblem(task), InvalidInput);
  task.objective = {term(Output::PeakContactStress)};
  task.constraints = {{term(Output::TeHarmonic, 5), 0.001}};
  CHECK_THROWS_AS(DesignProblem(task), InvalidInput);
  task.constraints.clear();
  task.objective = {term(Output::TeHarmonic, 1)};
  task.resolution.phases = {0.0, 0.1, 0.2, 0.7};
  CHECK_THROWS_AS(DesignProblem(task), InvalidInput);
}

TEST_CASE("One thread and two give the same bits", "[optimize][design][determinism]") {
  const Eigen::Vector3d x(0.3, 0.6, 0.2);
  const auto analysis_with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    DesignProblem problem(helical());
    return problem.analyse(x, true);
  };
  check_same_bits(analysis_with(1), analysis_with(2));
}

TEST_CASE("Scenes at different axial offsets have mesh models of their own", "[optimize][design]") {
  DesignTask task = helical({0.0, 0.0, 0.0});
  task.scenes[1].condition.misalignment.axial_offset = 20.0;
  const DesignProblem problem(task);
  CHECK(&problem.model(0) == &problem.model(2));
  CHECK(&problem.model(0) != &problem.model(1));
  constexpr double round_off = 1e-12;
  CHECK(problem.model(0).face_width - problem.model(1).face_width == Approx(20.0).epsilon(round_off));
}

TEST_CASE("Measures weigh the outputs in the units of a report", "[optimize][design]") {
  DesignTask task = helical();
  task.objective = {term(Output::TePeakToPeak, 0, 2.0), term(Output::PeakContactStress, 0, 0.01)};
  DesignProblem problem(task);
  const DesignAnalysis& analysis = problem.analyse(problem.start(), false);
  double worst = 0.0;
  for (int s = 0; s < problem.scenes(); ++s) {
    const LoadedCycle& cycle = analysis.cycles[static_cast<std::size_t>(s)];
    const double te_um = 1e3 * output_value(task.objective[0], {problem.model(s), cycle});
    const double stress = output_value(task.objective[1], {problem.model(s), cycle});
    constexpr double round_off = 1e-14;
    CHECK(problem.scene_measure(analysis, s) == Approx(2.0 * te_um + 0.01 * stress).epsilon(round_off));
    worst = std::max(worst, problem.scene_measure(analysis, s));
  }
  CHECK(problem.objective(analysis) == worst);
  CHECK(task.objective_name() == "te_peak_to_peak + peak_contact_stress");
  CHECK(std::string(task.objective_unit()) == "weighted sum");
}

TEST_CASE("Intervals along the contact lines are too few where twice as many change the objective", "[optimize][design]") {
  DesignTask task = helical();
  task.objective = {term(Output::TePeakToPeak)};
  const auto judged = [&](QuadratureRule rule, int intervals) {
    DesignTask of = task;
    of.resolution.quadrature = {rule, intervals};
    DesignProblem problem(of);
    const DesignReport report = report_design(problem, problem.analyse_given());
    return std::pair{look_finer(problem, report, false).needs_more, report.objective};
  };
  // Fixed points enter and leave the mesh whole, and few of them show another transmission error.
  const auto [needs, coarse] = judged(QuadratureRule::Gauss2, 2);
  REQUIRE(std::abs(judged(QuadratureRule::Gauss2, 4).second / coarse - 1.0) > change_by_intervals);  // else this task shows nothing
  CHECK(needs);
  // Graded intervals end where contact lines end: from 2 to 4 of them it changes by less than 1 %, and with order one by a sixteenth of that from 32 on.
  CHECK_FALSE(judged(QuadratureRule::Graded, 32).first);
}

TEST_CASE("A look at twice the intervals says how a design fares with four times as many", "[optimize][design]") {
  DesignTask task = helical();
  task.objective = {term(Output::TePeakToPeak)};
  task.constraints = {{term(Output::PeakContactStress), 600.0}};
  const auto report_at = [&](int intervals) {
    DesignTask of = task;
    of.resolution.quadrature = {QuadratureRule::Graded, intervals};
    DesignProblem problem(of);
    DesignReport report = report_design(problem, problem.analyse_given());
    FinerLook look = look_finer(problem, report, false);
    return std::pair{std::move(report), std::move(look)};
  };
  // The limit is the stress itself: the load cases that come near to it are judged.
  task.constraints.front().maximum = report_at(32).first.constraint_values.front();
  for (const int intervals : {2, 4, 8}) {
    CAPTURE(intervals);
    const auto [report, look] = report_at(intervals);
    const DesignReport finer = report_at(4 * intervals).first;
    const double excess = task.constraints.front().excess(report.constraint_values.front());
    const double true_excess = task.constraints.front().excess(finer.constraint_values.front());
    REQUIRE(look.excess_changes.size() == 1);
    // Order one at least: what is added reaches as far as what four times the intervals add, or farther, to a tenth of what may change.
    constexpr double slack = 0.1 * change_by_intervals;
    CHECK(excess + std::max(0.0, look.excess_changes.front()) >= true_excess - slack);
    if (!look.needs_more) CHECK(std::abs(finer.objective / report.objective - 1.0) <= change_by_intervals + slack);
  }
}

TEST_CASE("Intervals are too few where one of two balanced load cases falls behind with twice as many", "[optimize][design]") {
  // Relief up to the middle of the flank: aligned flanks touch over short lines, which four intervals overrate. Misaligned ones under less load do not.
  DesignTask task = helical({0.0, 16.0}, 16);
  task.objective = {term(Output::PeakContactStress)};
  for (Modification* m : {&task.modification.pinion, &task.modification.wheel}) m->tip_relief = {0.040, 4.0, ReliefShape::Linear};
  const auto report_at = [&](int intervals) {
    task.resolution.quadrature = {QuadratureRule::Graded, intervals};
    const DesignProblem problem(task);
    return report_design(problem, problem.analyse_given());
  };
  constexpr int few = 4;
  constexpr double hair = 1e-5;  // which of the two is the worst does not matter
  for (const double ahead : {1.0 + hair, 1.0 - hair}) {
    CAPTURE(ahead);
    for (int turn = 0; turn < 30; ++turn) {  // stress grows with about the root of the torque
      const std::vector<double> stress = report_at(few).scene_measures;
      task.scenes[1].torque *= std::pow(ahead * stress[0] / stress[1], 2);
    }
    const DesignReport report = report_at(few), finer = report_at(2 * few);
    REQUIRE(report.scene_measures[1] == Approx(ahead * report.scene_measures[0]).epsilon(0.1 * hair));
    REQUIRE(std::abs(finer.objective / report.objective - 1.0) < 0.5 * change_by_doubling);        // else it is the objective that decides
    REQUIRE(1.0 - finer.scene_measures[0] / finer.scene_measures[1] > 1.05 * change_by_doubling);  // else this task shows nothing
    report_at(few);
    CHECK(look_finer(DesignProblem(task), report, false).needs_more);
  }
}
