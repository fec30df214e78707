#include "core/load/solve/load_solver.hpp"
#include "core/load/solve/sensitivity.hpp"

#include <catch2/catch.hpp>

#include "tests/core/load/load_cases.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;
using load_cases::Random;
using load_cases::Structure;

namespace {

LoadProblem random_gear_problem(Random& random) {
  LoadProblem problem;
  const int n = random.integer(2, 40);
  problem.weight = random.vector(n, 5.0, 15.0);
  problem.influence = load_cases::influence(static_cast<Structure>(random.integer(0, 4)), n, 3e-6, random);
  problem.gap = random.vector(n, 0.0, 1.0) * random.log_uniform(1e-4, 0.03);
  problem.laws = load_cases::random_laws(n, random);
  problem.force = random.log_uniform(5.0, 500.0) * problem.weight.sum();
  return problem;
}

/// Central difference of a vector-valued function, extrapolated from two steps: error of the order step^4.
template <class Function>
auto central_difference(const Function& f, double step) {
  const auto once = [&](double h) { return ((f(h) - f(-h)) / (2.0 * h)).eval(); };
  return ((4.0 * once(step) - once(2.0 * step)) / 3.0).eval();
}

Eigen::Array<bool, Eigen::Dynamic, 1> loaded_points(const LoadDistribution& d) { return d.line_load.array() > 0.0; }

/// Loads and, last, the transmission error of a changed problem.
Eigen::VectorXd answer(const LoadProblem& problem, int* set_changes, const LoadDistribution& reference) {
  const LoadDistribution found = solve_load_distribution(problem, {.tolerance = 1e-14, .max_iterations = 30});
  // Round-off may keep the last digit of 1e-14 out of reach; 1e-12 is what the differences need.
  REQUIRE(found.kkt_residual <= 1e-12);
  if ((loaded_points(found) != loaded_points(reference)).any()) ++*set_changes;
  Eigen::VectorXd all(found.line_load.size() + 1);
  all << found.line_load, found.transmission_error;
  return all;
}

}  // namespace

TEST_CASE("The derivatives of loads and transmission error are those of central differences", "[core][load][gradient]") {
  constexpr double kDiscretisation = 1e-6;  // of the difference quotients, relative to the largest derivative
  Random random(51);
  int compared = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const LoadProblem problem = random_gear_problem(random);
    const Eigen::Index n = problem.gap.size();
    const LoadDistribution found = solve_load_distribution(problem);
    REQUIRE(found.usable());
    const LoadSensitivity sensitivity(problem, found);
    // Steps small against what the contacts yield, however soft the structure behind them.
    const double step = 2e-4 * (found.line_load.array() > 0.0).select(found.contact_deflection, 1.0).minCoeff();
    CAPTURE(trial, n);
    int set_changes = 0;

    const Eigen::VectorXd direction = random.vector(n, -1.0, 1.0);
    const auto with_gap = [&](double by) {
      LoadProblem changed = problem;
      changed.gap += by * direction;
      return answer(changed, &set_changes, found);
    };
    const auto with_force = [&](double by) {
      LoadProblem changed = problem;
      changed.force += by;
      return answer(changed, &set_changes, found);
    };
    const Eigen::VectorXd by_gap = central_difference(with_gap, step);
    const Eigen::VectorXd by_force = central_difference(with_force, 2e-4 * problem.force);
    if (set_changes > 0) continue;
    // A load about to vanish sits on the logarithm of its contact law, which no step of this size resolves.
    const double least = (found.line_load.array() > 0.0).select(found.line_load, problem.force).minCoeff();
    if (least < 0.02 * found.line_load.maxCoeff()) continue;
    ++compared;
    const auto gap = sensitivity.with_gap(direction);
    // The mean load per mm stands for the scale where a single loaded point has no choice and a derivative of nought.
    const double scale = gap.line_load.lpNorm<Eigen::Infinity>() + found.line_load.mean();
    CHECK((gap.line_load - by_gap.head(n)).lpNorm<Eigen::Infinity>() <= kDiscretisation * scale);
    CHECK(std::abs(gap.transmission_error[0] - by_gap[n]) <= kDiscretisation);
    const auto force = sensitivity.with_force();
    CHECK((force.line_load - by_force.head(n)).lpNorm<Eigen::Infinity>() <= kDiscretisation * force.line_load.lpNorm<Eigen::Infinity>());
    CHECK(force.transmission_error[0] == Approx(by_force[n]).epsilon(kDiscretisation));
  }
  CHECK(compared >= 40);
}

TEST_CASE("Loads answer to gaps as gaps answer to loads", "[core][load][gradient]") {
  constexpr double kRoundOff = 1e-10;
  // Maxwell: a_i dw_i/dg_j is symmetric. A gap common to all moves f alone; every gap moves f by the share of the
  // tangent stiffness.
  Random random(52);
  for (int trial = 0; trial < 40; ++trial) {
    const LoadProblem problem = random_gear_problem(random);
    const Eigen::Index n = problem.gap.size();
    const LoadDistribution found = solve_load_distribution(problem);
    REQUIRE(found.usable());
    const LoadSensitivity sensitivity(problem, found);
    CAPTURE(trial, n);

    Eigen::MatrixXd response(n, n);  // d(force)/d(gap)
    Eigen::VectorXd approach(n);     // df/d(gap)
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto derivative = sensitivity.with_gap(Eigen::VectorXd::Unit(n, j));
      response.col(j) = problem.weight.cwiseProduct(derivative.line_load);
      approach[j] = derivative.transmission_error[0];
    }
    // A single loaded point has no choice: its response is round-off of the stiffness.
    const double scale = response.cwiseAbs().maxCoeff() + sensitivity.tangent_stiffness();
    CHECK((response - response.transpose()).cwiseAbs().maxCoeff() <= kRoundOff * scale);
    CHECK(response.colwise().sum().cwiseAbs().maxCoeff() <= kRoundOff * scale);  // the force stays
    CHECK(response.diagonal().maxCoeff() <= kRoundOff * scale);                  // a point that withdraws is relieved
    CHECK(approach.sum() == Approx(1.0).epsilon(kRoundOff));

    const auto common = sensitivity.with_gap(Eigen::VectorXd::Ones(n));
    CHECK(common.transmission_error[0] == Approx(1.0).epsilon(kRoundOff));
    CHECK(common.line_load.norm() <= kRoundOff * scale);

    // dw/dF at constant gaps and df/dg are the same numbers, read across: the force's share of every point.
    const auto force = sensitivity.with_force();
    CHECK((problem.weight.cwiseProduct(force.line_load) - approach).norm() <= kRoundOff);
    CHECK(problem.weight.dot(force.line_load.col(0)) == Approx(1.0).epsilon(kRoundOff));
    CHECK(sensitivity.tangent_stiffness() == Approx(1.0 / force.transmission_error[0]).epsilon(kRoundOff));
  }
}

TEST_CASE("Where a second spring is just reached the derivative is that of one side", "[core][load][gradient][closed-form]") {
  constexpr double kRoundOff = 1e-12;
  LoadProblem problem;
  problem.influence = Eigen::Vector2d(2e-6, 3e-6).asDiagonal();
  problem.weight = Eigen::Vector2d(10.0, 20.0);
  problem.gap = Eigen::Vector2d(0.001, 0.005);
  constexpr double touch = 0.004 / 2e-6;  // N, where f reaches the second gap
  const auto slope_at = [&](double force) {
    problem.force = force;
    const LoadDistribution found = solve_load_distribution(problem);
    REQUIRE(found.usable());
    return LoadSensitivity(problem, found).with_force().transmission_error[0];
  };
  const double alone = 2e-6, together = 1.0 / (1.0 / 2e-6 + 1.0 / 3e-6);
  CHECK(slope_at(touch - 1e-6) == Approx(alone).epsilon(kRoundOff));
  CHECK(slope_at(touch + 1e-6) == Approx(together).epsilon(kRoundOff));
  const double there = slope_at(touch);
  const bool one_side = there == Approx(alone).epsilon(kRoundOff) || there == Approx(together).epsilon(kRoundOff);
  CHECK(one_side);

  // The one-sided differences meet at the kink, each with its own slope.
  const auto f = [&](double force) {
    problem.force = force;
    return solve_load_distribution(problem).transmission_error;
  };
  CHECK((f(touch) - f(touch - 100.0)) / 100.0 == Approx(alone).epsilon(1e-10));  // round-off: f is 0.005, the difference 2e-4
  CHECK((f(touch + 100.0) - f(touch)) / 100.0 == Approx(together).epsilon(1e-10));
}

TEST_CASE("Derivatives with respect to every modification are those of central differences", "[core][load][gradient]") {
  constexpr double kDiscretisation = 1e-6;  // of the difference quotients, relative to the largest derivative at the position
  const bool helical = GENERATE(false, true);
  const GearPair gears = helical ? mesh_cases::pair(18, 54, 30, 10, 120) : mesh_cases::pair(20, 40, 0, 4, 30);
  const MeshModel model = mesh_cases::model(gears, {{QuadratureRule::Gauss2, 6}, helical ? std::vector{0.13, 0.71} : std::vector{0.4, 0.9, 1.15}});
  Random random(helical ? 53 : 54);
  int compared = 0, skipped = 0;
  for (int design = 0; design < 6; ++design) {
    FlankCondition condition;
    for (Modification* m : {&condition.modification.pinion, &condition.modification.wheel}) {
      for (const ModificationDescriptor& p : modification_parameters) {
        set(*m, p.parameter, p.kind == ParameterKind::Extent ? random(0.3, 0.9) * gears.data.normal_module : random(0.5, 4.0) * units::um);
      }
      m->tip_relief.shape = design % 2 == 0 ? ReliefShape::Linear : ReliefShape::Parabolic;
      m->triangular_tip_relief.shape = m->tip_relief.shape;
      m->triangular_root_relief.shape = design % 2 == 0 ? ReliefShape::Parabolic : ReliefShape::Linear;
      m->root_relief.shape = design % 2 == 0 ? ReliefShape::Parabolic : ReliefShape::Linear;
    }
    condition.misalignment.mesh_misalignment = random(-10.0, 10.0) * units::um;
    const double torque = mesh_cases::torque_for(gears, random.log_uniform(100.0, 600.0));
    std::vector<GearParameter> parameters;
    for (Member member : {Member::Pinion, Member::Wheel}) {
      for (const ModificationDescriptor& p : modification_parameters) parameters.push_back({member, p.parameter});
    }
    const LoadedCycle cycle = analyse_cycle(model, condition, torque, {parameters.begin(), parameters.end()});
    REQUIRE(cycle.usable());
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      for (std::size_t k = 0; k < cycle.positions.size(); ++k) {
        const LoadedPosition& here = cycle.positions[k];
        const Eigen::Index n = here.load.line_load.size();
        CAPTURE(design, p, k);
        int set_changes = 0;
        const auto changed = [&](double step) {
          FlankCondition other = condition;
          Modification& m = other.modification[parameters[p].member];
          set(m, parameters[p].parameter, get(m, parameters[p].parameter) + step);
          if (parameters[p].parameter == parameter_of("profile_crowning")) {  // moves both halves, whatever they were
            const Modification& given = condition.modification[parameters[p].member];
            m.addendum_crowning = given.addendum_crowning + step;
            m.dedendum_crowning = given.dedendum_crowning + step;
          }
          const LoadedPosition there = analyse_cycle(model, other, torque).positions[k];
          REQUIRE(there.load.usable());
          if ((loaded_points(there.load) != loaded_points(here.load)).any()) ++set_changes;
          Eigen::VectorXd all(2 * n + 1);
          all << there.load.line_load, there.contact_stress, there.load.transmission_error;
          return all;
        };
        const Eigen::VectorXd difference = central_difference(changed, 1e-6);
        const double least = (here.load.line_load.array() > 0.0).select(here.load.line_load, cycle.force).minCoeff();
        if (set_changes > 0 || least < 0.02 * here.load.line_load.maxCoeff()) {
          ++skipped;
          continue;
        }
        ++compared;
        const auto column = static_cast<Eigen::Index>(p);
        const Eigen::VectorXd loads = here.line_load_derivative.col(column);
        const Eigen::VectorXd stresses = here.contact_stress_derivative.col(column);
        // A parameter that touches no loaded point has derivatives of nought, the differences have the solver's
        // tolerance: hence the second terms, per mm.
        CHECK((loads - difference.head(n)).lpNorm<Eigen::Infinity>() <=
              kDiscretisation * (loads.lpNorm<Eigen::Infinity>() + here.load.line_load.maxCoeff()));
        CHECK((stresses - difference.segment(n, n)).lpNorm<Eigen::Infinity>() <=
              kDiscretisation * (stresses.lpNorm<Eigen::Infinity>() + here.contact_stress.maxCoeff()));
        CHECK(std::abs(here.transmission_error_derivative[column] - difference[2 * n]) <= kDiscretisation);
      }
    }
  }
  CAPTURE(skipped);
  CHECK(compared >= 100);
}
