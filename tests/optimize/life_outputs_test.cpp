#include "optimize/design/outputs/life_outputs.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"
#include "optimize/design/design_optimiser.hpp"
#include "optimize/design/search/direct_program.hpp"
#include "optimize/design/search/epigraph_program.hpp"
#include "optimize/design/search/local_model.hpp"
#include "optimize/design/outputs/scene_outputs.hpp"
#include "optimize/design/problem/joined_loads.hpp"
#include "tests/common/random.hpp"
#include "tests/optimize/design_tasks.hpp"
#include "tests/optimize/output_gradients.hpp"
#include "tests/optimize/program_gradients.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

/// The helical pair under a spectrum of three loads in each of two misalignments, with strength and oil.
DesignTask task_under_spectrum(double hours = 1.0) {
  DesignTask task = helical({8.0, -8.0});
  const std::vector<DesignScene> scenes = std::exchange(task.scenes, {});
  for (int g = 0; g < 2; ++g) {
    int bin = 0;
    for (const auto& [part, cycles] : {std::pair{1.0, 1e6}, std::pair{0.7, 2e7}, std::pair{0.4, 3e8}}) {
      DesignScene scene = scenes[static_cast<std::size_t>(g)];
      scene.torque *= part;
      scene.operation = {hours * cycles, 150.0, hours * 3600.0, not_given};
      scene.spectrum = g;
      scene.bin = bin++;
      task.scenes.push_back(scene);
    }
  }
  LifeModel life;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    life.strength[m] = {contact_sn_curve(LifeFactors::CaseHardened, 500.0), root_sn_curve(LifeFactors::CaseHardened, 20.0)};
  }
  life.lubricant = Lubricant{.viscosity_40 = 220.0, .viscosity_100 = 19.0, .temperature = 80.0};
  life.roughness = 0.5;
  life.permissible_film = 0.3;
  life.scuffing_temperature = 250.0;
  task.life = std::make_shared<const LifeModel>(life);
  task.objective = {term(Output::ContactDamage)};
  task.constraints = {{.output = term(Output::RootDamage), .maximum = 1e6}, {.output = term(Output::SpecificFilmThickness), .minimum = 1e-3}};
  return task;
}

const std::vector<Output> life_terms{
    Output::ContactDamage,      Output::RootDamage,         Output::LossFactor,      Output::SpecificFilmThickness,   Output::FlashTemperature,
    Output::ContactTemperature, Output::ContactUtilisation, Output::RootUtilisation, Output::MicropittingUtilisation, Output::ScuffingUtilisation};

}  // namespace

TEST_CASE("A step of a workshop changes a damage by a power of the load, not in proportion", "[optimize][assessment][life]") {
  DesignTask task = task_under_spectrum();
  task.constraints.clear();
  const DesignProblem problem(task);
  const std::vector<AssessedParameter> parameters = variable_parameters(task);
  const LocalModel model(problem, task.modification, parameters);
  const double now = problem.objective(problem.analyse_design(task.modification));
  const auto found = [&](std::size_t i, double steps) {
    PerGear<Modification> moved = task.modification;
    const auto& g = std::get<GearParameter>(parameters[i].parameter);
    set(moved[g.member], g.parameter, get(moved[g.member], g.parameter) + steps * parameters[i].inside);
    return problem.objective(problem.analyse_design(moved));
  };
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    CAPTURE(parameters[i].name);
    const auto by_model = [&](double steps) {
      return model.objective(steps * Eigen::VectorXd::Unit(model.parameters(), static_cast<Eigen::Index>(i)));
    };
    constexpr double small = 1e-3, second_order = 0.02;
    CHECK(by_model(small) - now == Approx(found(i, small) - now).epsilon(second_order).margin(1e-8 * now));
    for (const double step : {1.0, -1.0}) {
      CAPTURE(step);
      constexpr double curved = 0.3;  // model: a load is linear in the step to a few per cent, which its fifth power multiplies
      CHECK(by_model(step) - now == Approx(found(i, step) - now).epsilon(curved).margin(0.05 * now));
    }
  }
}

TEST_CASE("Gradients of damage, loss, film and temperature are what central differences say", "[optimize][design][life][gradient]") {
  DesignTask task = task_under_spectrum();
  for (DesignScene& scene : task.scenes) {
    scene.operation.application_factor = 1.25;
    scene.operation.dynamic_factor = scene.bin == 0 ? 1.1 : 1.0;
  }
  DesignProblem problem(task);
  std::vector<ObjectiveTerm> terms;
  for (const Output output : life_terms) terms.push_back(term(output));
  tests::Random32 random(11);
  for (int trial = 0; trial < 3; ++trial) {
    const Eigen::VectorXd x = random_design(problem.variables(), random);
    CAPTURE(trial);
    // As the other outputs' gradients: some 0.001 um; the exponent 13 of the S-N curve magnifies curvature.
    CHECK(check_output_gradients(problem, x, terms, 1e-5, 1e-6) > 50);
  }
}

TEST_CASE("Film and temperatures change with the torque by line loads, mean friction and bulk temperature", "[optimize][design][life][gradient]") {
  const DesignTask task = task_under_spectrum();
  const DesignProblem problem(task);
  const auto under = [&](double share) {
    DesignTask scaled = task;
    for (DesignScene& scene : scaled.scenes) scene.torque *= share;
    return DesignProblem(scaled);
  };
  constexpr double step = 1e-4, round_off = 1e-5;  // of loads, over the step; its square is less
  const DesignProblem more = under(1.0 + step), less = under(1.0 - step);
  const LoadedCycle cycle = problem.analyse_scene(0, task.modification, {PinionTorque{}}), up = more.analyse_scene(0, task.modification),
                    down = less.analyse_scene(0, task.modification);
  for (const Output output : {Output::LossFactor, Output::SpecificFilmThickness, Output::FlashTemperature, Output::ContactTemperature,
                              Output::MicropittingUtilisation, Output::ScuffingUtilisation}) {
    const ObjectiveTerm of = term(output);
    const PeakCandidate candidate = leading_candidates(of, problem.scene_of(cycle, 0), 0.0, 1).front();
    CAPTURE(of.name);
    const double found =
        (candidate_value(of, candidate, more.scene_of(up, 0)).value - candidate_value(of, candidate, less.scene_of(down, 0)).value) / (2.0 * step);
    CHECK(candidate_value(of, candidate, problem.scene_of(cycle, 0)).gradient[0] * task.scenes[0].torque == Approx(found).epsilon(round_off));
  }
}

TEST_CASE("A utilisation is the stress, the film or the temperature of a load case over what it may be", "[optimize][design][life]") {
  DesignProblem problem(task_under_spectrum());
  const DesignAnalysis& analysis = problem.analyse(problem.start(), false);
  const LifeModel& life = *problem.task().life;
  for (int s = 0; s < 3; ++s) {
    CAPTURE(s);
    const LoadedScene scene = problem.scene(analysis, s);
    const auto value = [&](Output output) { return output_value(term(output), scene); };
    const Operation& operation = problem.task().scenes[static_cast<std::size_t>(s)].operation;
    // The wheel has fewer load cycles and bears more. Round-off.
    const double cycles = load_cycles(scene.model.pair, Member::Pinion, operation);
    CHECK(value(Output::ContactUtilisation) ==
          Approx(value(Output::PeakContactStress) / life.strength.pinion.contact->stress_for(cycles)).epsilon(1e-12));
    CHECK(value(Output::MicropittingUtilisation) == Approx(0.3 / value(Output::SpecificFilmThickness)).epsilon(1e-12));
    CHECK(value(Output::ScuffingUtilisation) == Approx((value(Output::ContactTemperature) - 80.0) / 170.0).epsilon(1e-12));
    const double root = value(Output::PeakRootStress) / life.strength.pinion.root->stress_for(cycles);
    CHECK(value(Output::RootUtilisation) <= Approx(root).epsilon(1e-12));  // equal where the pinion's root has the largest stress
    CHECK(value(Output::RootUtilisation) > 0.5 * root);
  }
  // Without load cycles it is the limit for ever.
  DesignTask endless = task_under_spectrum();
  for (DesignScene& scene : endless.scenes) scene.operation.revolutions = not_given;
  endless.objective = {term(Output::ContactUtilisation)};
  endless.constraints.clear();
  DesignProblem problem_for_ever(endless);
  const LoadedScene scene = problem_for_ever.scene(problem_for_ever.analyse(problem_for_ever.start(), false), 0);
  CHECK(output_value(term(Output::ContactUtilisation), scene) ==
        Approx(output_value(term(Output::PeakContactStress), scene) / life.strength.pinion.contact->limit).epsilon(1e-12));
}

TEST_CASE("K_A and K_v raise contact stress by their root, root stress and line loads by themselves, and nothing that is not rated",
          "[optimize][design][life]") {
  constexpr double K_A = 1.5, K_v = 1.2, K = K_A * K_v;
  DesignTask task = task_under_spectrum();
  LifeModel life = *task.life;
  life.bulk_temperature = 90.0;  // else friction changes it too
  // One exponent on either side of the knee, so that damage is a power of the stress.
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    life.strength[m].contact->exponent_beyond = life.strength[m].contact->exponent;
    life.strength[m].root->exponent_beyond = life.strength[m].root->exponent;
  }
  task.life = std::make_shared<const LifeModel>(life);
  DesignTask factored = task;
  for (DesignScene& scene : factored.scenes) {
    scene.operation.application_factor = K_A;
    scene.operation.dynamic_factor = K_v;
  }
  DesignProblem nominal_problem(task), problem(factored);
  const DesignAnalysis nominal_analysis = nominal_problem.analyse(nominal_problem.start(), false);
  const DesignAnalysis analysis = problem.analyse(problem.start(), false);
  const LoadedScene nominal = nominal_problem.scene(nominal_analysis, 0), scene = problem.scene(analysis, 0);
  const auto rise = [&](Output output) { return output_value(term(output), scene) / output_value(term(output), nominal); };
  constexpr double round_off = 1e-12;
  CHECK(rise(Output::PeakContactStress) == 1.0);
  CHECK(rise(Output::PeakRootStress) == 1.0);
  CHECK(rise(Output::LossFactor) == 1.0);
  CHECK(rise(Output::ContactUtilisation) == Approx(std::sqrt(K)).epsilon(round_off));
  CHECK(rise(Output::RootUtilisation) == Approx(K).epsilon(round_off));
  CHECK(rise(Output::ContactDamage) == Approx(std::pow(K, life.strength.pinion.contact->exponent / 2.0)).epsilon(round_off));
  CHECK(rise(Output::RootDamage) == Approx(std::pow(K, life.strength.pinion.root->exponent)).epsilon(round_off));
  // Friction grows as load^0.2, and the flash temperature as friction times load^0.75.
  CHECK(rise(Output::FlashTemperature) == Approx(std::pow(K, 0.95)).epsilon(round_off));
  // Without the heat of sliding the film would be thinner by load^-0.13; hotter oil makes it thinner still.
  CHECK(rise(Output::SpecificFilmThickness) < std::pow(K, -0.13));
}

TEST_CASE("Damage is a sum over the load cases of a spectrum, of which the worst point counts", "[optimize][design][life]") {
  DesignProblem problem(task_under_spectrum());
  const DesignAnalysis& analysis = problem.analyse(problem.start(), false);
  CHECK(problem.judged_scenes(term(Output::ContactDamage)) == std::vector<int>{0, 3});
  CHECK(problem.judged_scenes(term(Output::PeakContactStress)).size() == 6);
  const SnCurve& curve = *problem.task().life->strength.pinion.contact;
  double worst = 0.0, sum_of_worst = 0.0;
  for (int s = 0; s < 3; ++s) {
    double of_case = 0.0;
    for (const LoadedPosition& position : analysis.cycles[static_cast<std::size_t>(s)].positions) {
      of_case = std::max(of_case, curve.damage(position.contact_stress.maxCoeff()).value);
    }
    sum_of_worst += problem.task().scenes[static_cast<std::size_t>(s)].operation.revolutions * of_case;
  }
  for (std::size_t i = 0; i < problem.model(0).positions.size(); ++i) {
    for (std::size_t j = 0; j < problem.model(0).positions[i].points.size(); ++j) {
      double here = 0.0;
      for (std::size_t s = 0; s < 3; ++s) {
        here += problem.task().scenes[s].operation.revolutions *
                curve.damage(analysis.cycles[s].positions[i].contact_stress[static_cast<Eigen::Index>(j)]).value;
      }
      worst = std::max(worst, here);
    }
  }
  // The wheel of three times the teeth has a third of the pinion's load cycles and the same curve.
  const double found = output_value(term(Output::ContactDamage), problem.scene(analysis, 0));
  CHECK(found == Approx(worst).epsilon(1e-12));  // round-off
  CHECK(found <= sum_of_worst * (1.0 + 1e-12));
  for (const int s : {1, 2}) CHECK(output_value(term(Output::ContactDamage), problem.scene(analysis, s)) == found);
  const std::vector<double> measures = problem.scene_measures(problem.task().combined_objective(), analysis);
  CHECK(measures == std::vector<double>{found, found, found, measures[3], measures[3], measures[3]});
  CHECK(problem.objective(analysis) == std::max(found, measures[3]));
}

TEST_CASE("Joined load cases have the cycles of all and the torque that does their damage", "[optimize][design][life]") {
  DesignTask task = task_under_spectrum();
  task.constraints.clear();
  task.objective = {term(Output::RootDamage)};  // stress in proportion to the torque on thin slices that touch all along
  constexpr double ratio = 1.05;
  for (const int s : {0, 3}) {  // beside the largest load of either spectrum one that is a little less
    DesignScene near = task.scenes[static_cast<std::size_t>(s)];
    near.torque /= ratio;
    near.operation.revolutions *= 3.0;
    task.scenes.push_back(near);
  }
  const JoinedLoads joined = with_joined_loads(task);
  REQUIRE(joined.task.scenes.size() == 6);
  CHECK(joined.joined_into == std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 0, 3});
  const double growth = design_output(Output::RootDamage).load_growth;
  const DesignScene &one = joined.task.scenes[0], &large = task.scenes[0], &small = task.scenes[6];
  CHECK(one.operation.revolutions == large.operation.revolutions + small.operation.revolutions);
  CHECK(one.operation.revolutions * std::pow(one.torque, growth) ==
        Approx(large.operation.revolutions * std::pow(large.torque, growth) + small.operation.revolutions * std::pow(small.torque, growth))
            .epsilon(1e-12));  // round-off
  CHECK(one.torque < large.torque);
  CHECK(one.torque > small.torque);
  CHECK(joined.task.scenes[1].torque == task.scenes[1].torque);
  CHECK(joined.of_scenes({1, 2, 3, 4, 5, 6}) == std::vector<double>{1, 2, 3, 4, 5, 6, 1, 4});
  // The damage is nearly that of both. With another power q of the load it is off by q (q - g) / 2 times the variance: 1/5 of ratio - 1 squared, with weights 1 and 3.
  DesignProblem all(task), fewer(joined.task);
  const double whole = all.objective(all.analyse(all.start(), false)), found = fewer.objective(fewer.analyse(fewer.start(), false));
  constexpr double largest_power = 20.0;
  CHECK(std::abs(found / whole - 1.0) < 0.5 * largest_power * (largest_power - growth) * 0.2 * (ratio - 1.0) * (ratio - 1.0));
}

TEST_CASE("Load cases are joined where nothing but torque and duration tells them apart, and only for sums over a spectrum",
          "[optimize][design][life]") {
  DesignTask task = task_under_spectrum();
  task.constraints.clear();
  for (DesignScene& scene : task.scenes) scene.torque = 1e5 + scene.bin;  // all bins within 1.1
  CHECK(with_joined_loads(task).task.scenes.size() == 2);                 // one for either misalignment
  task.scenes[1].operation.temperature = 90.0;
  task.scenes[4].condition.misalignment.mesh_misalignment += 1e-3;
  CHECK(with_joined_loads(task).task.scenes.size() == 4);
  task.constraints = {{.output = term(Output::PeakContactStress), .maximum = 1e4}};  // a peak is of one load case
  CHECK(with_joined_loads(task).task.scenes.size() == 6);
}

TEST_CASE("Twice the hours double the damage of a design", "[optimize][design][life]") {
  DesignProblem once(task_under_spectrum(1.0)), twice(task_under_spectrum(2.0));
  const Eigen::VectorXd x = Eigen::VectorXd::Constant(once.variables(), 0.3);
  const DesignAnalysis &a = once.analyse(x, false), &b = twice.analyse(x, false);
  for (const Output output : {Output::ContactDamage, Output::RootDamage}) {
    CHECK(output_value(term(output), twice.scene(b, 0)) == 2.0 * output_value(term(output), once.scene(a, 0)));
  }
}

TEST_CASE("A design optimised for damage has less of it than one optimised for the largest torque's stress", "[optimize][design][life]") {
  DesignOptions options;
  options.solver.name = "nlopt:slsqp";
  DesignProblem for_damage(task_under_spectrum());
  const DesignResult found = optimise_design(for_damage, options);
  CHECK((found.status == SolverStatus::Converged || found.status == SolverStatus::Stalled));
  DesignTask stress_task = task_under_spectrum();
  stress_task.objective = {term(Output::PeakContactStress)};
  DesignProblem for_stress(stress_task);
  const DesignResult other = optimise_design(for_stress, options);
  const double damage_of_other = for_damage.objective(other.after.analysis);
  CHECK(found.after.objective < found.before.objective);
  CHECK(found.after.objective <= damage_of_other * (1.0 + 1e-3));
  CHECK(for_stress.objective(found.after.analysis) >= other.after.objective * (1.0 - 1e-3));
}

TEST_CASE("Programmes see the root of damage, with its gradients, and tell the damage from it", "[optimize][design][life][gradient]") {
  const Aggregation over =
      GENERATE(Aggregation(Aggregate::Nominal), Aggregation(Aggregate::Worst), Aggregation(Aggregate::Mean),
               Aggregation(Aggregate::MeanPlusSigmas, 2.0), Aggregation(Aggregate::Cvar, 2.0, 0.5), Aggregation(Aggregate::Quantile, 2.0, 0.5));
  const bool of_roots_too = GENERATE(true, false);
  CAPTURE(to_string(over), of_roots_too);
  DesignTask task = task_under_spectrum();
  task.over = over;
  task.constraints.clear();
  if (of_roots_too) task.objective.push_back(term(Output::RootDamage));
  DesignProblem problem(task);
  DesignLog log(nullptr);
  EpigraphProgram epigraph(problem, log);
  tests::Random32 random(12);
  Eigen::VectorXd y = epigraph.start();
  const double damage = problem.objective(problem.analyse(problem.start(), false));
  CHECK(epigraph.objective_of(epigraph.evaluate(y, false).objective).value == Approx(damage).epsilon(1e-4));  // mean + k sigma is smoothed
  y.head(problem.variables()) = random_design(problem.variables(), random);
  check_gradients(epigraph, y);
  DirectProgram direct(problem, log);
  check_gradients(direct, random_design(problem.variables(), random));
}

TEST_CASE("Under a single load the least damage is that of the least stress, from whichever start", "[optimize][design][life]") {
  DesignTask task = task_under_spectrum();
  std::erase_if(task.scenes, [](const DesignScene& scene) { return scene.bin > 0; });
  task.constraints.clear();
  DesignTask stress_task = task;
  stress_task.objective = {term(Output::PeakContactStress)};
  DesignProblem for_stress(stress_task);
  const DesignResult least_stress = optimise_design(for_stress, DesignOptions{});
  DesignProblem for_damage(task);
  tests::Random32 random(13);
  for (int start = 0; start < 3; ++start) {
    if (start > 0) for_damage.set_start(random_design(for_damage.variables(), random));
    const DesignResult least_damage = optimise_design(for_damage, DesignOptions{});
    CAPTURE(start, least_damage.before.objective, least_damage.after.objective, least_damage.message);
    // Of the searches, which stop on kinks.
    CHECK(for_stress.objective(least_damage.after.analysis) == Approx(least_stress.after.objective).epsilon(2e-3));
  }
}

TEST_CASE("A bound on the least film is kept at every point under load", "[optimize][design][life]") {
  DesignTask task = task_under_spectrum();
  const ObjectiveTerm film = term(Output::SpecificFilmThickness);
  DesignProblem start(task);
  const DesignAnalysis& analysis = start.analyse(start.start(), false);
  double least = INFINITY;
  for (int s = 0; s < start.scenes(); ++s) least = std::min(least, output_value(film, start.scene(analysis, s)));
  CHECK(start.constraint_value(analysis, task.constraints[1]) == least);
  task.objective = {term(Output::TeHarmonic, 1)};
  task.constraints = {{.output = film, .minimum = 1.02 * least}};
  DesignProblem problem(task);
  CHECK_FALSE(task.constraints[0].one_suffices());
  CHECK(problem.violation(problem.analyse(problem.start(), false)) > 0.0);
  const DesignResult found = optimise_design(problem, DesignOptions{});
  CHECK(found.after.constraint_values[0] >= 1.02 * least * (1.0 - 1e-5));
}

TEST_CASE("A bound on the contact temperature is kept by every load case, and sliding under less load is cooler", "[optimize][design][life]") {
  DesignTask task = task_under_spectrum();
  const ObjectiveTerm contact = term(Output::ContactTemperature), flash = term(Output::FlashTemperature);
  DesignProblem start(task);
  const DesignAnalysis& analysis = start.analyse(start.start(), false);
  double hottest = 0.0;
  for (int s = 0; s < start.scenes(); ++s) {
    const double theta_B = output_value(contact, start.scene(analysis, s));
    hottest = std::max(hottest, theta_B);
    // The bulk of all teeth is as warm, above the oil of 80 deg C.
    CHECK(theta_B - output_value(flash, start.scene(analysis, s)) > 80.0);
  }
  // Bins of a spectrum by falling torque.
  for (const int s : {1, 2, 4, 5}) {
    CHECK(output_value(flash, start.scene(analysis, s)) < output_value(flash, start.scene(analysis, s - 1)));
  }
  task.objective = {term(Output::TeHarmonic, 1)};
  task.constraints = {{.output = contact, .maximum = hottest - 2.0}};
  DesignProblem problem(task);
  CHECK(problem.violation(problem.analyse(problem.start(), false)) > 0.0);
  const DesignResult found = optimise_design(problem, DesignOptions{});
  CHECK(found.after.constraint_values[0] <= (hottest - 2.0) * (1.0 + 1e-5));
  task.objective = {flash};
  task.constraints.clear();
  DesignProblem coolest(task);
  const DesignResult cooled = optimise_design(coolest, DesignOptions{});
  CHECK(cooled.after.objective < 0.9 * cooled.before.objective);
}

TEST_CASE("A temperature below 0 deg C has candidates like any other", "[optimize][design][life]") {
  DesignTask task = task_under_spectrum();
  LifeModel life = *task.life;
  life.bulk_temperature = -200.0;  // so that the largest is below 0
  task.life = std::make_shared<const LifeModel>(life);
  DesignProblem problem(task);
  const DesignAnalysis& analysis = problem.analyse(problem.start(), false);
  const ObjectiveTerm contact = term(Output::ContactTemperature);
  const LoadedScene scene = problem.scene(analysis, 0);
  REQUIRE(output_value(contact, scene) < 0.0);
  const auto leading = leading_candidates(contact, scene, 0.01, 3);
  REQUIRE_FALSE(leading.empty());
  CHECK(candidate_value(contact, leading.front(), scene).value == output_value(contact, scene));
}

TEST_CASE("What damage and film need is asked for by name", "[optimize][design][life]") {
  const auto field_of = [](DesignTask task) {
    try {
      DesignProblem problem(std::move(task));
      problem.objective(problem.analyse(problem.start(), false));
    } catch (const InvalidInput& problem) {
      return problem.field();
    }
    return std::string();
  };
  DesignTask task = task_under_spectrum();
  task.constraints.clear();
  CHECK(field_of(task).empty());
  DesignTask without = task;
  without.life = nullptr;
  CHECK(field_of(without) == "contact_damage");
  without = task;
  for (DesignScene& scene : without.scenes) scene.spectrum = -1;
  CHECK(field_of(without) == "load.spectrum");
  without = task;
  without.objective.push_back(term(Output::PeakContactStress));
  CHECK(field_of(without) == "optimise.objective");
  without.objective = {term(Output::SpecificFilmThickness)};
  CHECK(field_of(without) == "optimise.objective");
  without = task;
  without.root_stress = nullptr;
  without.objective = {term(Output::RootDamage)};
  CHECK(field_of(without) == "peak_root_stress");
}
