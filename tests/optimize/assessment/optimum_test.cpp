#include "optimize/assessment/sensitivity.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "optimize/assessment/optimum.hpp"
#include "optimize/design/design_optimiser.hpp"
#include "tests/optimize/design_tasks.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

/// An optimised task with its local model.
struct Solved {
  DesignProblem problem;
  DesignResult result;
  DesignReport after;
  std::vector<AssessedParameter> parameters;
  LocalModel model;
  Optimum optimum;
  std::vector<Sensitivity> sensitivities;

  explicit Solved(const DesignTask& task)
      : problem(task),
        result(optimise_design(problem, SolverOptions{})),
        after(result.after),
        parameters(assessed_parameters(task)),
        model(problem, after.analysis.modification, parameters, result.optimality.active),
        optimum(find_optimum(problem, result.optimality, after.variables)),
        sensitivities(
            find_sensitivities(problem, result.optimality, after.analysis.modification, after.variables, task.resolution.quadrature.intervals)) {}
};

/// The objective with one parameter moved by some of its steps and everything analysed again.
double moved_objective(const DesignTask& task, PerGear<Modification> modification, const AssessedParameter& p, double steps) {
  DesignTask moved = task;
  for (DesignScene& scene : moved.scenes) {
    if (const auto* m = std::get_if<MisalignmentParameter>(&p.parameter)) scene.condition.misalignment.*(*m) += steps * p.inside;
    if (std::holds_alternative<PinionTorque>(p.parameter)) scene.torque *= 1.0 + steps * p.inside;
    const auto* g = std::get_if<GearParameter>(&p.parameter);
    if (g == nullptr || p.variable >= 0) continue;
    ManufacturingError& manufacturing = scene.condition.error[g->member];
    (g->parameter == parameter_of("lead_slope") ? manufacturing.helix_slope : manufacturing.profile_slope) += steps * units::um;
  }
  if (p.variable >= 0) {
    const auto& g = std::get<GearParameter>(p.parameter);
    Modification& m = modification[g.member];
    set(m, g.parameter, get(m, g.parameter) + steps * p.inside);
  }
  const DesignProblem problem(moved);
  return problem.objective(problem.analyse_design(modification));
}

double moved_objective(const DesignTask& task, const DesignReport& after, const AssessedParameter& p, double steps) {
  return moved_objective(task, after.analysis.modification, p, steps);
}

double total_weight(const Optimum& optimum) {
  return std::accumulate(optimum.scenes.begin(), optimum.scenes.end(), 0.0, [](double sum, const auto& s) { return sum + s.weight; });
}

}  // namespace

TEST_CASE("Multipliers of a worst case balance at the optimum and their scenes' weights are one together", "[optimize][assessment]") {
  const Solved solved(helical({0.0, 12.0, -12.0}, 6));
  constexpr double solver = 1e-4;  // Ipopt ends at 1e-7 of its own scaling
  CHECK(solved.optimum.residual < solver);
  CHECK(total_weight(solved.optimum) == Approx(1.0).epsilon(solver));
  CHECK(solved.optimum.scenes.size() >= 2);  // a worst case that misalignment either way governs
  for (const auto& scene : solved.optimum.scenes) CHECK(scene.weight > 0.0);
  // Away from the optimum nothing balances.
  DesignProblem elsewhere(helical({0.0, 12.0, -12.0}, 6));
  CHECK(first_order_optimality(elsewhere, elsewhere.start()).residual > 0.01);
}

TEST_CASE("The objective answers to a step of anything as the exact derivatives say", "[optimize][assessment]") {
  const DesignTask task = helical({0.0, 12.0, -12.0}, 6);
  const Solved solved(task);
  for (const Sensitivity& s : solved.sensitivities) {
    CAPTURE(s.parameter.name);
    // Small steps either way, for the slopes of a kink; what is left is second order.
    constexpr double share = 0.01, second_order = 0.03;
    const Eigen::VectorXd step = share * Eigen::VectorXd::Unit(solved.model.parameters(), &s - solved.sensitivities.data());
    const double now = solved.after.objective;
    const double margin = 2e-6 * now;  // what the solver may have left between candidates that are equal at the optimum
    for (const double side : {1.0, -1.0}) {
      const double predicted = solved.model.objective(side * step) - now;
      const double found = moved_objective(task, solved.after, s.parameter, side * share) - now;
      CHECK(predicted == Approx(found).epsilon(second_order).margin(margin));
    }
  }
}

TEST_CASE("Over the whole surface a step of a misalignment takes the points with it", "[optimize][assessment]") {
  DesignTask task = spur({6.0});
  task.gap = GapModel::WholeSurface;
  task.modification.pinion.lead_crowning = 8 * units::um;
  task.scenes.front().condition.misalignment.centre_distance = 0.2;
  const DesignProblem problem(task);
  const std::vector<AssessedParameter> parameters = assessed_parameters(task);
  const LocalModel model(problem, task.modification, parameters);
  const double now = model.objective(Eigen::VectorXd::Zero(model.parameters()));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!moves_mesh(task.gap, parameters[i].parameter)) continue;
    CAPTURE(parameters[i].name);
    constexpr double share = 0.01, second_order = 1e-4;  // of a step, relative; round-off of the objective over it is less
    const auto found = [&](double steps) { return moved_objective(task, task.modification, parameters[i], steps); };
    const double slope = (model.objective(share * Eigen::VectorXd::Unit(model.parameters(), static_cast<Eigen::Index>(i))) - now) / share;
    CHECK(slope == Approx((found(share) - found(-share)) / (2 * share)).epsilon(second_order).margin(1e-7 * now));
  }
}

TEST_CASE("A harmonic answers to a small step with the derivative of its amplitude, to a large one as a phasor", "[optimize][assessment]") {
  DesignTask task = helical({6.0}, 16);
  task.objective = {term(Output::TeHarmonic, 1)};
  const DesignProblem problem(task);
  const std::vector<AssessedParameter> parameters = assessed_parameters(task);
  const LocalModel model(problem, task.modification, parameters);
  const double now = model.objective(Eigen::VectorXd::Zero(model.parameters()));
  CHECK(now == Approx(problem.objective(problem.analyse_design(task.modification))).epsilon(1e-12));  // round-off
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].variable < 0) continue;
    CAPTURE(parameters[i].name);
    const auto step = [&](double share) { return share * Eigen::VectorXd::Unit(model.parameters(), static_cast<Eigen::Index>(i)); };
    const auto found = [&](double share) { return moved_objective(task, task.modification, parameters[i], share); };
    constexpr double share = 0.01, second_order = 1e-3;
    const double slope = (model.objective(step(share)) - model.objective(step(-share))) / (2 * share);
    CHECK(slope == Approx((found(share) - found(-share)) / (2 * share)).epsilon(second_order).margin(1e-6 * now));
  }
}

TEST_CASE("No step of a variable improves an optimum, and its bounds have their gains", "[optimize][assessment]") {
  DesignTask task = helical({0.0, 12.0, -12.0}, 6);
  task.variables[0].upper = 0.004;  // less lead crowning than the optimum wants
  const Solved solved(task);
  for (const Sensitivity& s : solved.sensitivities) {
    if (s.parameter.variable < 0) continue;
    CAPTURE(s.parameter.name);
    const double margin = 2e-6 * solved.after.objective;
    if (s.can_less) CHECK(s.less >= -margin);
    if (s.can_more) CHECK(s.more >= -margin);
  }
  REQUIRE(solved.optimum.bounds.size() >= 1);
  const Optimum::Bound& bound = solved.optimum.bounds.front();
  CHECK(bound.variable == 0);
  CHECK(bound.upper);
  CHECK_FALSE(solved.sensitivities[0].can_more);
  // The bound really moved out by a tenth of a step, everything optimised anew.
  DesignTask wider = task;
  wider.variables[0].upper += 0.1 * units::um;
  DesignProblem problem(wider);
  const double found = optimise_design(problem, SolverOptions{}).after.objective - solved.after.objective;
  constexpr double second_order = 0.05;
  CHECK(0.1 * bound.gain == Approx(found).epsilon(second_order));
}

TEST_CASE("A constraint's multiplier is what a wider limit gains", "[optimize][assessment]") {
  DesignTask task = helical({0.0, 12.0, -12.0}, 6);
  DesignProblem free(task);
  const DesignReport unbounded = optimise_design(free, SolverOptions{}).after;
  const OutputConstraint te{term(Output::TePeakToPeak), 1.0};
  task.constraints = {{te.output, 0.8 * free.constraint_value(unbounded.analysis, te)}};
  const Solved solved(task);
  REQUIRE(solved.optimum.constraints.size() == 1);
  CHECK(solved.optimum.constraints.front().gain < 0.0);
  DesignTask wider = task;
  constexpr double share = 0.0004, second_order = 0.1;
  wider.constraints[0].maximum *= 1.0 + share;
  DesignProblem problem(wider);
  const double found = optimise_design(problem, SolverOptions{}).after.objective - solved.after.objective;
  CHECK(share * 100.0 * solved.optimum.constraints.front().gain == Approx(found).epsilon(second_order));
}

TEST_CASE("A tolerance costs less where the design follows it", "[optimize][assessment]") {
  const DesignTask task = helical({0.0, 12.0, -12.0}, 6);
  const Solved solved(task);
  for (const Sensitivity& s : solved.sensitivities) {
    if (s.parameter.variable >= 0) continue;
    CAPTURE(s.parameter.name);
    const double margin = 2e-6 * solved.after.objective;
    CHECK(s.optimised_anew <= s.more + margin);
    CHECK(-s.optimised_anew <= s.less + margin);
  }
  // Torque: optimised anew at 0.1 % more.
  DesignTask more = task;
  for (DesignScene& scene : more.scenes) scene.torque *= 1.001;
  DesignProblem problem(more);
  const double found = optimise_design(problem, SolverOptions{}).after.objective - solved.after.objective;
  const Sensitivity& torque = solved.sensitivities.back();
  REQUIRE(torque.parameter.name == "load.torque");
  constexpr double second_order = 0.05;
  CHECK(0.1 * torque.optimised_anew == Approx(found).epsilon(second_order));
}

TEST_CASE("Tolerances by fewer intervals have nearly the sensitivities that they have by those of the optimum", "[optimize][assessment]") {
  DesignTask task = helical({0.0, 12.0, -12.0}, 8);
  task.resolution.quadrature = {QuadratureRule::Graded, 16};
  const Solved solved(task);
  const auto by = [&](int intervals) {
    return find_sensitivities(solved.problem, solved.result.optimality, solved.after.analysis.modification, solved.after.variables, intervals);
  };
  const std::vector<Sensitivity> fewer = by(12);
  // By 12 and by 16 intervals slopes of peaks differ by an eighth at most here.
  constexpr double discretisation = 0.15, small = 1e-4, round_off = 1e-12;
  REQUIRE(fewer.size() == solved.sensitivities.size());
  for (std::size_t i = 0; i < fewer.size(); ++i) {
    const Sensitivity &few = fewer[i], &all = solved.sensitivities[i];
    const bool is_variable = few.parameter.variable >= 0;
    CAPTURE(few.parameter.name);
    CHECK(few.parameter.name == all.parameter.name);
    CHECK(all.intervals == 16);
    CHECK(few.intervals == (is_variable ? 16 : 12));
    const double share = is_variable ? round_off : discretisation, margin = small * solved.after.objective;
    CHECK(few.less == Approx(all.less).epsilon(share).margin(margin));
    CHECK(few.more == Approx(all.more).epsilon(share).margin(margin));
    if (is_variable) continue;
    CHECK(few.optimised_anew == Approx(all.optimised_anew).epsilon(share).margin(margin));
    // The lead slope of the design makes up for a helix slope, by fewer intervals as well.
    if (few.parameter.name.ends_with("helix_slope")) CHECK(std::abs(few.optimised_anew) <= 1e-6 * solved.after.objective);
  }
}

TEST_CASE("In a mean every scene has its own weight", "[optimize][assessment]") {
  DesignTask task = helical({0.0, 12.0}, 6);
  task.over = Aggregate::Mean;
  task.scenes[1].weight = 3.0;
  const Solved solved(task);
  REQUIRE(solved.optimum.scenes.size() == 2);
  CHECK(solved.optimum.scenes[0].scene == 1);
  constexpr double solver = 1e-4;
  CHECK(solved.optimum.scenes[0].weight == Approx(0.75).epsilon(solver));
  CHECK(solved.optimum.residual < solver);
}

TEST_CASE("Several outputs share the weight of their scene", "[optimize][assessment]") {
  DesignTask task = helical({0.0, 12.0, -12.0}, 6);
  task.objective = {term(Output::PeakContactStress, 0, 0.01), term(Output::TePeakToPeak, 0, 1.0)};
  const Solved solved(task);
  constexpr double solver = 1e-3;
  CHECK(solved.optimum.residual < solver);
  CHECK(total_weight(solved.optimum) == Approx(1.0).epsilon(solver));
}

TEST_CASE("A tied modification follows in sensitivities and multipliers", "[optimize][assessment]") {
  DesignTask task = helical({0.0, 12.0, -12.0}, 6);
  // Half of each um of lead crowning on the wheel as well.
  LinkingConstraint link;
  link.linked = {.path = "wheel.modification.lead_crowning", .member = Member::Wheel, .parameter = parameter_of("lead_crowning")};
  link.factor = 0.5;
  task.links = {link};
  const Solved solved(task);
  constexpr double solver = 1e-4;
  CHECK(solved.optimum.residual < solver);
  // A step of both, analysed again.
  constexpr double share = 0.01, second_order = 0.03;
  PerGear<Modification> changed = solved.after.analysis.modification;
  changed.pinion.lead_crowning += share * units::um;
  changed.wheel.lead_crowning += 0.5 * share * units::um;
  const double found = solved.problem.objective(solved.problem.analyse_design(changed)) - solved.after.objective;
  const Eigen::VectorXd step = share * Eigen::VectorXd::Unit(solved.model.parameters(), 0);
  CHECK(solved.model.objective(step) - solved.after.objective == Approx(found).epsilon(second_order).margin(2e-6 * solved.after.objective));
}

TEST_CASE("A bounded sum of modifications has the gain of its limit", "[optimize][assessment]") {
  DesignTask task = helical({0.0, 12.0, -12.0}, 6);
  ModificationConstraint sum;
  sum.name = "lead_crowning + profile_crowning";
  sum.terms = {{Member::Pinion, parameter_of("lead_crowning"), 1.0}, {Member::Pinion, parameter_of("profile_crowning"), 1.0}};
  DesignProblem free(task);
  const DesignReport unbounded = optimise_design(free, SolverOptions{}).after;
  sum.maximum = 0.7 * (unbounded.variables[0] + unbounded.variables[2]);
  task.modification_constraints = {sum};
  const Solved solved(task);
  REQUIRE(solved.optimum.sums.size() == 1);
  CHECK(solved.optimum.sums.front().upper);
  CHECK(solved.optimum.sums.front().gain < 0.0);
  DesignTask wider = task;
  constexpr double share = 0.05, second_order = 0.05;
  wider.modification_constraints[0].maximum += share * units::um;
  DesignProblem problem(wider);
  const double found = optimise_design(problem, SolverOptions{}).after.objective - solved.after.objective;
  CHECK(share * solved.optimum.sums.front().gain == Approx(found).epsilon(second_order));
}

TEST_CASE("In a list the last objective is governed, and the limit of the first has its gain", "[optimize][assessment]") {
  DesignTask task = helical({0.0, 12.0, -12.0}, 6);
  task.later_objectives = {Objective{{term(Output::TePeakToPeak)}, Aggregate::Worst}};
  DesignProblem problem(task);
  const DesignResult result = optimise_design(problem, SolverOptions{});
  const DesignProblem last = last_stage(problem, result.stages);
  const std::vector<AssessedParameter> parameters = assessed_parameters(last.task());
  const DesignAnalysis& analysis = result.after.analysis;
  const LocalModel model(last, analysis.modification, parameters, result.optimality.active);
  const Optimum optimum = find_optimum(last, result.optimality, result.after.variables);
  constexpr double round_off = 1e-12, solver = 1e-3;
  CHECK(model.objective(Eigen::VectorXd::Zero(model.parameters())) == Approx(result.after.later_objectives[0]).epsilon(round_off));
  CHECK(total_weight(optimum) == Approx(1.0).epsilon(solver));
  // The transmission error would fall further if the stress were let go: its limit holds it.
  REQUIRE(optimum.objectives.size() == 1);
  CHECK(last.task().objective_bounds[0].objective.name() == "peak_contact_stress");
  CHECK(optimum.objectives.front().gain < 0.0);
}
