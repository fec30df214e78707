#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "core/contact/unloaded/transmission_error.hpp"
#include "core/gear/gear_pair.hpp"
#include "optimize/design/outputs/scene_outputs.hpp"
#include "tests/common/random.hpp"
#include "tests/optimize/design_tasks.hpp"
#include "tests/optimize/output_gradients.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using namespace flankwright::design_tasks;

namespace {

const LoadedCycle& cycle_of(const DesignAnalysis& analysis, int scene) { return analysis.cycles[static_cast<std::size_t>(scene)]; }

/// Every variable that a relief offers, beside the three of the small task: also heights and a wheel parameter.
DesignTask task_with_reliefs() {
  DesignTask task = helical();
  const auto add = [&](Member member, const char* path, ModificationParameter parameter, double lower, double upper) {
    task.variables.push_back({path, member, parameter, lower, upper});
  };
  add(Member::Pinion, "pinion.modification.tip_relief.amount", parameter_of("tip_relief.amount"), 0.005, 0.06);
  add(Member::Pinion, "pinion.modification.tip_relief.height", parameter_of("tip_relief.height"), 1.0, 6.0);
  add(Member::Wheel, "wheel.modification.end_relief.amount", parameter_of("end_relief.amount"), 0.005, 0.03);
  add(Member::Wheel, "wheel.modification.end_relief.length", parameter_of("end_relief.length"), 5.0, 40.0);
  add(Member::Wheel, "wheel.modification.twist", parameter_of("twist"), -0.02, 0.02);
  return task;
}

/// Value of every candidate there is, found without ranking.
std::vector<double> all_values(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle) {
  std::vector<double> values;
  const int n = static_cast<int>(cycle.positions.size());
  for (int i = 0; i < n; ++i) {
    const LoadedPosition& position = cycle.positions[static_cast<std::size_t>(i)];
    const int others = term.output == Output::TePeakToPeak     ? n
                       : term.output == Output::PeakRootStress ? static_cast<int>(position.root_stress.size())
                                                               : static_cast<int>(position.load.line_load.size());
    for (int j = 0; j < others; ++j) values.push_back(candidate_value(term, {i, j}, {model, cycle}).value);
  }
  return values;
}

}  // namespace

TEST_CASE("An output is what the cycle itself shows", "[optimize][design][outputs]") {
  DesignProblem problem(helical());
  tests::Random32 random(5);
  for (int trial = 0; trial < 5; ++trial) {
    DesignAnalysis analysis = problem.analyse(random_design(problem.variables(), random), false);
    problem.add_root_stress(analysis);
    for (int s = 0; s < problem.scenes(); ++s) {
      const LoadedCycle& cycle = cycle_of(analysis, s);
      const MeshModel& model = problem.model(s);
      const CycleSummary summary = summarise(model, cycle);
      const Eigen::VectorXd te = cycle.transmission_error();
      double stress = 0.0, load = 0.0;
      for (const LoadedPosition& position : cycle.positions) {
        stress = std::max(stress, position.contact_stress.maxCoeff());
        load = std::max(load, position.load.line_load.maxCoeff());
      }
      constexpr double round_off = 1e-12;
      CHECK(output_value(term(Output::PeakContactStress), {model, cycle}) == stress);
      CHECK(output_value(term(Output::PeakLineLoad), {model, cycle}) == load);
      CHECK(output_value(term(Output::PeakRootStress), {model, cycle}) == summary.peak_root_stress);
      CHECK(output_value(term(Output::TePeakToPeak), {model, cycle}) == te.maxCoeff() - te.minCoeff());
      CHECK(output_value(term(Output::LoadFactor), {model, cycle}) == Approx(summary.load_factor).epsilon(round_off));
      const std::vector<double> harmonics = harmonic_amplitudes({te.begin(), te.end()});
      for (int order = 1; order <= 3; ++order) {
        CHECK(output_value(term(Output::TeHarmonic, order), {model, cycle}) ==
              tests::about(harmonics[static_cast<std::size_t>(order) - 1], round_off * te.cwiseAbs().maxCoeff()));
      }
    }
  }
}

TEST_CASE("Leading candidates are the peak and all that come near it", "[optimize][design][outputs]") {
  DesignProblem problem(helical());
  tests::Random32 random(6);
  DesignAnalysis analysis = problem.analyse(random_design(problem.variables(), random), false);
  problem.add_root_stress(analysis);
  const double margin = 0.15;
  for (const ObjectiveTerm& output : all_outputs()) {
    if (output.output == Output::TeHarmonic || output.output == Output::EffectiveContactRatio) continue;
    for (int s = 0; s < problem.scenes(); ++s) {
      CAPTURE(output.name, s);
      const MeshModel& model = problem.model(s);
      const LoadedCycle& cycle = cycle_of(analysis, s);
      const std::vector<double> values = all_values(output, model, cycle);
      const double peak = *std::max_element(values.begin(), values.end());
      CHECK(output_value(output, {model, cycle}) == peak);
      const auto near = std::count_if(values.begin(), values.end(), [&](double v) { return v >= (1.0 - margin) * peak; });

      const std::vector<PeakCandidate> leading = leading_candidates(output, {model, cycle}, margin, 100000);
      CHECK(static_cast<long>(leading.size()) == near);
      double last = peak;
      CHECK(candidate_value(output, leading.front(), {model, cycle}).value == peak);
      for (const PeakCandidate& candidate : leading) {
        const double value = candidate_value(output, candidate, {model, cycle}).value;
        CHECK(value <= last);
        last = value;
      }
      CHECK(leading_candidates(output, {model, cycle}, margin, 2).size() == 2);
      CHECK(leading_candidates(output, {model, cycle}, 0.0, 100).front() == leading.front());
    }
  }
}

TEST_CASE("Gradients of every output are what central differences say", "[optimize][design][outputs][gradient]") {
  DesignProblem problem(task_with_reliefs());
  tests::Random32 random(7);
  for (int trial = 0; trial < 4; ++trial) {
    const Eigen::VectorXd x = random_design(problem.variables(), random);
    CAPTURE(trial);
    // Some 0.001 um on amounts: differences lose 1e-12 / 2e-5 to round-off and step^2 to curvature.
    CHECK(check_output_gradients(problem, x, all_outputs(), 2e-5, 1e-6) > 0);
  }
}

TEST_CASE("Gradients by a twist compensation are what central differences say", "[optimize][design][outputs][gradient]") {
  DesignTask task = helical();
  task.modification.wheel.lead_crowning = 6 * units::um;
  task.modification.pinion.process.kind = GENERATE(GrindingKind::GeneratingGrinding, GrindingKind::FormGrinding);
  task.modification.wheel.process.kind = GrindingKind::GeneratingGrinding;
  task.variables.push_back({"pinion.twist_compensation", Member::Pinion, parameter_of("twist_compensation"), 0.0, 1.0});
  task.variables.push_back({"wheel.twist_compensation", Member::Wheel, parameter_of("twist_compensation"), 0.0, 0.8});
  DesignProblem problem(task);
  tests::Random32 random(13);  // designs at which no point gains or loses contact within the step
  for (int trial = 0; trial < 2; ++trial) {
    const Eigen::VectorXd x = random_design(problem.variables(), random);
    CAPTURE(trial);
    CHECK(check_output_gradients(problem, x, all_outputs(), 2e-5, 1e-6) > 0);  // as above
  }
}

TEST_CASE("Without derivatives in the cycle a candidate has a value and no gradient", "[optimize][design][outputs]") {
  DesignProblem problem(helical({0.0}));
  const DesignAnalysis& analysis = problem.analyse(problem.start(), false);
  for (const ObjectiveTerm& output : all_outputs()) {
    const PeakCandidate leader = leading_candidates(output, {problem.model(0), cycle_of(analysis, 0)}, 0.0, 1).front();
    const SmoothValue value = candidate_value(output, leader, {problem.model(0), cycle_of(analysis, 0)});
    CHECK(value.value > 0.0);
    CHECK(value.gradient.size() == 0);
  }
}

TEST_CASE("An output of a cycle that failed somewhere is refused", "[optimize][design][outputs]") {
  DesignProblem problem(helical({0.0}));
  LoadedCycle cycle = problem.analyse(problem.start(), false).cycles.front();
  cycle.failures = 1;
  for (const ObjectiveTerm& output : all_outputs()) {
    CAPTURE(output.name);
    CHECK_THROWS_AS(output_value(output, {problem.model(0), cycle}), std::runtime_error);
    CHECK_THROWS_AS(candidate_value(output, {0, 0}, {problem.model(0), cycle}), std::runtime_error);
  }
}

TEST_CASE("A harmonic's directions never exceed its amplitude and fall short of it by no more than half a per cent", "[optimize][design][outputs]") {
  DesignProblem problem(helical());
  tests::Random32 random(11);
  const ObjectiveTerm first = term(Output::TeHarmonic, 1);
  for (int trial = 0; trial < 10; ++trial) {
    const DesignAnalysis analysis = problem.analyse(random_design(problem.variables(), random), false);
    for (int s = 0; s < problem.scenes(); ++s) {
      const LoadedCycle& cycle = cycle_of(analysis, s);
      const double amplitude = output_value(first, {problem.model(s), cycle});
      CHECK(candidate_value(first, whole_output, {problem.model(s), cycle}).value == amplitude);
      double largest = -INFINITY;
      for (const PeakCandidate& direction : leading_candidates(first, {problem.model(s), cycle}, 0.1, 1)) {
        largest = std::max(largest, candidate_value(first, direction, {problem.model(s), cycle}).value);
      }
      constexpr double round_off = 1e-13;
      CHECK(largest <= amplitude * (1.0 + round_off));
      CHECK(largest >= amplitude * std::cos(units::pi / harmonic_directions) * (1.0 - round_off));
    }
  }
}

TEST_CASE("Where one pair carries all the load the effective contact ratio is one, where two share alike it is two",
          "[optimize][design][outputs][closed-form]") {
  DesignTask task = spur({0.0});
  task.objective = {term(Output::EffectiveContactRatio)};
  DesignProblem problem(task);
  LoadedCycle cycle = problem.analyse(problem.start(), false).cycles.front();
  const MeshModel& model = problem.model(0);
  const auto load_teeth = [&](const auto& weight_of) {
    for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
      Eigen::VectorXd& load = cycle.positions[i].load.line_load;
      std::map<int, double> lengths;
      for (Eigen::Index j = 0; j < load.size(); ++j)
        lengths[model.positions[i].points[static_cast<std::size_t>(j)].tooth] += model.positions[i].weight[j];
      double total = 0.0;
      for (const auto& [tooth, length] : lengths) total += weight_of(tooth, lengths);
      for (Eigen::Index j = 0; j < load.size(); ++j) {
        const int tooth = model.positions[i].points[static_cast<std::size_t>(j)].tooth;
        load[j] = cycle.force * weight_of(tooth, lengths) / total / lengths.at(tooth);
      }
    }
  };
  constexpr double round_off = 1e-13;
  load_teeth([](int tooth, const std::map<int, double>& all) { return tooth == all.begin()->first ? 1.0 : 0.0; });
  CHECK(output_value(task.objective.front(), {model, cycle}) == Approx(1.0).epsilon(round_off));
  load_teeth([](int, const std::map<int, double>&) { return 1.0; });
  double mean_teeth = 0.0;
  for (const MeshPosition& position : model.positions) {
    std::set<int> teeth;
    for (const ContactPoint& point : position.points) teeth.insert(point.tooth);
    mean_teeth += static_cast<double>(teeth.size()) / static_cast<double>(model.positions.size());
  }
  CHECK(output_value(task.objective.front(), {model, cycle}) == Approx(mean_teeth).epsilon(round_off));
}

TEST_CASE("Stress and force on tip edges are outputs with the gradients of differences, 0 where tips are sharp",
          "[optimize][design][outputs][gradient]") {
  DesignTask task = spur({6.0});
  DesignProblem sharp(task);
  PairData data = task.pair.data;
  data.pinion.tip_rounding = data.wheel.tip_rounding = 0.05 * data.normal_module;
  task.pair = make_gear_pair(data);
  DesignProblem rounded(task);
  const Eigen::VectorXd x = Eigen::Vector2d(0.2, 0.6);
  // As in the gradients of every output.
  constexpr double step = 2e-5, discretisation = 1e-6;
  for (const Output output : {Output::EdgeStress, Output::TipEdgeShare}) {
    const ObjectiveTerm edge = term(output);
    CAPTURE(edge.name);
    CHECK(output_value(edge, {sharp.model(0), cycle_of(sharp.analyse(x, true), 0)}) == 0.0);
    const DesignAnalysis at = rounded.analyse(x, true);
    const MeshModel& model = rounded.model(0);
    const CycleSummary summary = summarise(model, cycle_of(at, 0));
    CHECK(output_value(edge, {model, cycle_of(at, 0)}) == (output == Output::EdgeStress ? summary.edge_stress : summary.tip_edge_share));
    const PeakCandidate peak = leading_candidates(edge, {model, cycle_of(at, 0)}, 0.0, 1).front();
    const auto value = [&](const DesignAnalysis& a) { return candidate_value(edge, peak, {model, cycle_of(a, 0)}); };
    REQUIRE(value(at).value > 0.0);
    const Eigen::VectorXd exact = rounded.scaled(value(at).gradient);
    for (int i = 0; i < rounded.variables(); ++i) {
      const Eigen::VectorXd shift = step * Eigen::VectorXd::Unit(rounded.variables(), i);
      const double up = value(rounded.analyse(x + shift, false)).value, down = value(rounded.analyse(x - shift, false)).value;
      CHECK(std::abs(exact[i] - (up - down) / (2.0 * step)) <= discretisation * exact.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE("The edge load is the peak line load where the margin covers the whole flank, and never more", "[optimize][design][outputs]") {
  DesignProblem problem(helical());
  const DesignAnalysis analysis = problem.analyse(problem.start(), false);
  ObjectiveTerm edge = term(Output::EdgeLoad);
  for (int s = 0; s < problem.scenes(); ++s) {
    const LoadedCycle& cycle = cycle_of(analysis, s);
    const double peak = output_value(term(Output::PeakLineLoad), {problem.model(s), cycle});
    double last = 0.0;
    for (double margin : {0.01, 0.05, 0.2, 0.5}) {
      edge.edge_margin = margin;
      const double load = output_value(edge, {problem.model(s), cycle});
      CHECK(load >= last);
      last = load;
    }
    CHECK(last == peak);
  }
}
