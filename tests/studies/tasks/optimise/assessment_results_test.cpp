#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/base/json_format.hpp"
#include "studies/report/report.hpp"
#include "studies/results/results_json.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/tasks/optimise/assessment.hpp"
#include "studies/results/tables.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_file/life_texts.hpp"
#include "tests/studies/study_texts.hpp"

namespace flankwright::studies {
namespace {

using json = Json;
using study_texts::results_of;

/// The small optimisation with everything that proves it.
std::string assessed_study() {
  return small::optimisation() + R"(
[optimise.comparison]
variants = 2
[optimise.validation]
samples = 40
[optimise.tolerances]
"misalignment.mesh_misalignment" = { uniform = [-12, 12] }
)";
}

/// What a clock says differs from run to run.
void remove_seconds(json& node) {
  if (node.is_object()) {
    for (const char* key : {"seconds", "proof_seconds", "milliseconds_per_cycle", "message"}) node.erase(key);
  }
  if (node.is_structured()) {
    for (json& child : node) remove_seconds(child);
  }
}

TEST_CASE("A search ends no worse than the best rule of thumb that its variables reach", "[studies][assessment]") {
  // Of a spur pair by thin slices. Two analyses find nothing by themselves.
  const std::string study = "task = \"optimise\"\n" + small::spur_pair() + R"(
[load]
torque = 150
[fidelity]
compliance = "thin_slice"
[optimise]
objective = "te_harmonic_1"
max_evaluations = 2
[optimise.variables]
"pinion.modification.tip_relief.amount" = [0, 60]
"wheel.modification.tip_relief.amount" = [0, 60]
"pinion.modification.tip_relief.height" = [0.5, 3]
"wheel.modification.tip_relief.height" = [0.5, 3]
)";
  const StudyResults results = run_study(parse_study(study, "spur.toml"));
  const Assessment& assessment = optimised(results).assessment;
  const ComparedDesign* const best = best_of(assessment.rules);
  REQUIRE(best != nullptr);
  CHECK(assessment.out_of_reach.empty());
  constexpr double round_off = 1e-9;
  CHECK(optimised(results).search_work.objective_at_positions <= best->objective * (1.0 + round_off));
  CHECK(best->objective < 0.6 * optimised(results).design.before.objective);
}

TEST_CASE("The assessment in results.json is consistent", "[studies][assessment]") {
  const StudyResults results = run_study(parse_study(assessed_study(), "small.toml"));
  const json optimise = json::parse(results_json(results))["optimise"];
  const double optimum = optimise["after"]["objective"];
  constexpr double round_off = 1e-9;

  const json& rules = optimise["comparison"]["rules"];
  REQUIRE(rules.size() == 20);
  CHECK(rules[0]["name"] == "unmodified");
  for (const json& rule : rules) {
    CAPTURE(rule["name"]);
    REQUIRE(rule["scenes"].size() == 3);
    // Worst over the scenes, as the study asks.
    const auto scenes = rule["scenes"].get<std::vector<double>>();
    CHECK(rule["objective"] == *std::max_element(scenes.begin(), scenes.end()));
  }
  // The others keep what half the intervals have; none of them is better than the best, which was analysed as the optimum was.
  const double best = optimise["comparison"]["best_rule"]["objective"];
  for (const json& rule : rules) {
    CHECK(rule["objective"].get<double>() >= best);
    if (rule["objective"] == best) CHECK(rule["intervals"] == optimised(results).task.resolution.quadrature.intervals);
  }
  CHECK(optimise["comparison"]["basis"]["misalignment_um"] == Approx(12.0).epsilon(round_off));

  const json& variants = optimise["comparison"]["variants"];
  REQUIRE(variants.size() == 2);
  for (const json& search : variants) {
    const int budget = 2 * optimise["evaluations"].get<int>();
    const int product = std::accumulate(search["levels"].begin(), search["levels"].end(), 1, [](int p, const json& n) { return p * n.get<int>(); });
    CHECK(search["tried"] == product);
    CHECK(product <= budget);
    // An optimum within its bounds is no worse than any combination within them.
    if (!search["best"].is_null()) CHECK(search["best"]["objective"].get<double>() >= optimum * (1.0 - 1e-6));
  }

  double weights = 0.0;
  for (const json& scene : optimise["governing"]["scenes"]) weights += scene["weight"].get<double>();
  CHECK(weights == Approx(1.0).epsilon(1e-3));
  const json& governing = optimise["governing"];
  CHECK(governing["words"].size() >= 1 + governing["bounds"].size() + governing["constraints"].size() + governing["sums"].size());
  CHECK(optimise["sensitivity"].size() == 4 + 9);  // variables and tolerances

  const json& validation = optimise["validation"];
  CHECK(validation["samples"] == 40);
  CHECK(validation["bin_edges"].size() == validation["designs"][0]["histogram"].size() + 1);
  for (const json& design : validation["designs"]) {
    const auto counts = design["histogram"].get<std::vector<int>>();
    CHECK(std::accumulate(counts.begin(), counts.end(), 0) == 40);
  }
  // Misalignment stays within what the optimiser saw, and stress grows towards its ends.
  constexpr double between_scenes = 0.02;  // model: the worst lies at the ends, give or take the mesh positions
  CHECK(validation["designs"][1]["greatest"].get<double>() <= optimum * (1.0 + between_scenes));
  CHECK(validation["designs"][0]["name"] == "before");
  CHECK(validation["designs"][1]["name"] == "after");

  std::vector<std::string> names;
  for (const NamedText& table : csv_tables(results)) names.push_back(table.name);
  for (const char* name : {"comparison.csv", "sensitivity.csv", "validation.csv"}) CHECK(std::ranges::count(names, name) == 1);
  CHECK_THAT(summary_table(results), Catch::Contains("best rule of thumb") && Catch::Contains("governs with weight"));

  const std::string page = render_report(results_document(results));
  for (const char* section : {"comparison", "validation", "governing", "sensitivity"}) {
    CHECK(page.find("<section id=\"" + std::string(section) + "\">") != std::string::npos);
  }
}

TEST_CASE("A scene below the mean of a mean + k sigma does not govern it", "[studies][assessment]") {
  DesignTask task;
  task.over = Aggregate::MeanPlusSigmas;
  for (const char* name : {"worst", "mild"}) {
    task.scenes.emplace_back();
    task.scenes.back().name = name;
    task.scenes.back().torque = 100.0 * units::newton_metre;
  }
  Optimum optimum;
  optimum.scenes = {{0, 1.58}, {1, -0.58}};
  const std::vector<std::string> words = optimum_in_words(optimum, task);
  REQUIRE(words.size() == 2);
  CHECK_THAT(words[0], Catch::Contains("\"worst\"") && Catch::Contains("governs with weight 1.58"));
  CHECK_THAT(words[1], Catch::Contains("larger value in the scene \"mild\"") && !Catch::Contains("governs"));
}

TEST_CASE("The same study gives the same assessment", "[studies][assessment][determinism]") {
  json a = results_of(assessed_study())["optimise"], b = results_of(assessed_study())["optimise"];
  remove_seconds(a);
  remove_seconds(b);
  CHECK(a == b);
}

TEST_CASE("Where no rule of thumb keeps the constraints the summary says so", "[studies][assessment]") {
  const StudyResults results = run_study(
      parse_study(small::optimisation() + "\"pinion.modification.lead_crowning + wheel.modification.lead_crowning\" = { min = 25 }\n", "small.toml"));
  CHECK(optimised(results).design.after.variables[2] >= 0.025 - 1e-6);  // in the order of their keys
  const std::string said = "None of 20 designs by rules of thumb keeps the limits on modifications.";
  CHECK_THAT(summary_table(results), Catch::Contains(said));
  const json comparison = json::parse(results_json(results))["optimise"]["comparison"];
  CHECK_FALSE(comparison.contains("best_rule"));
  CHECK_THAT(comparison["no_rule"].get<std::string>(), Catch::Equals(said));
}

TEST_CASE("Where no design keeps the limits the excess that is said is that of the figure shown", "[studies][assessment]") {
  const StudyResults results = run_study(parse_study(small::optimisation() + "peak_contact_stress = { max = 100 }\n", "small.toml"));
  REQUIRE(optimised(results).design.status == SolverStatus::Infeasible);
  REQUIRE(optimised(results).assessment.relaxation);
  CHECK_THAT(summary_table(results), Catch::Contains("None of 20 designs by rules of thumb keeps the constraints. The nearest, "));
  const double shown = optimised(results).design.after.constraint_values[0] / 100.0 - 1.0;
  CHECK(optimised(results).assessment.relaxation->excess >= shown);
  constexpr double between_positions = 0.02;  // model: what the positions of the search do not see
  CHECK(optimised(results).assessment.relaxation->excess <= shown + between_positions);
  CHECK(optimised(results).design.message == message_of_excess(optimised(results).assessment.relaxation->excess));
  CHECK(std::isnan(optimised(results).design.optimality.residual));
}

TEST_CASE("Damage over a load spectrum is listed by scene, and without a unit", "[studies][assessment][life]") {
  const StudyResults results = run_study(parse_study("task = \"optimise\"\n" + life_pair + life_strength + life_load + R"(
[optimise]
objective = "contact_damage"
[optimise.variables]
"pinion.modification.lead_crowning" = [0, 20]
"pinion.modification.tip_relief.amount" = [0, 5]
[pinion.modification]
tip_relief = { amount = 0, height = 1.5 }
)",
                                                     "small.toml"));
  REQUIRE(optimised(results).task.scenes.size() == 4);
  const json optimise = json::parse(results_json(results))["optimise"];
  REQUIRE(optimise["scenes"].size() == 2);
  for (const json& scene : optimise["scenes"]) CHECK(scene["torque_Nm"].is_null());
  for (const json& scene : optimise["governing"]["scenes"]) CHECK(scene["torque_Nm"].is_null());
  const std::string summary = summary_table(results);
  CHECK_THAT(summary, Catch::Contains("The scene \"one way\" governs"));
  CHECK(summary.find(" 1 (") == std::string::npos);  // of "2.94 1 (25.6 times the optimum)"
}

TEST_CASE("A limit of damage that no design keeps is shown with its excess, as any other limit", "[studies][assessment][life]") {
  const StudyResults results = run_study(parse_study("task = \"optimise\"\n" + life_pair + life_strength + life_load + R"(
[optimise]
objective = "te_peak_to_peak"
[optimise.variables]
"pinion.modification.lead_crowning" = [0, 20]
[optimise.constraints]
contact_damage = { max = 1e5 }
)",
                                                     "small.toml"));
  REQUIRE(optimised(results).design.status == SolverStatus::Infeasible);
  REQUIRE(optimised(results).assessment.relaxation);
  CHECK(optimised(results).assessment.relaxation->excess > 0.0);
  CHECK_FALSE(optimised(results).assessment.relaxation->limits.empty());
}

TEST_CASE("A search goes on at more positions where a peak between them says that there is more to gain",
          "[studies][assessment][between-positions]") {
  const std::string text = R"(
task = "optimise"
[pair]
normal_module = 4
helix_angle = 13
[pinion]
teeth = 18
face_width = 27
profile_shift = 0.2
[wheel]
teeth = 34
face_width = 27
[pinion.modification]
tip_relief = { amount = 0, height = 2 }
[wheel.modification]
tip_relief = { amount = 0, height = 2 }
[load]
torque = 450
[fidelity]
compliance = "thin_slice"
effect_sizes = "off"
[optimise]
comparison.rules = "off"
[optimise.variables]
"pinion.modification.lead_crowning" = [0, 20]
"pinion.modification.lead_slope" = [-30, 30]
"pinion.modification.profile_crowning" = [0, 20]
"pinion.modification.tip_relief.amount" = [0, 60]
"wheel.modification.tip_relief.amount" = [0, 60]
)";
  const StudyResults few = run_study(parse_study(text, "small.toml", {{"cycle.positions", "32"}})), more = run_study(parse_study(text, "small.toml"));
  CHECK(few.study.cycle.positions == 32);
  CHECK(more.study.cycle.positions > 32);
  CHECK(more.phases.size() == static_cast<std::size_t>(more.study.cycle.positions));
  // Of 32 positions an edge that hardly touches lies between two, and the design shown is worse than what the search saw. Both are judged with peaks
  // sought between the positions.
  CHECK(optimised(few).design.after.objective > 1.01 * optimised(few).search_work.objective_at_positions);
  CHECK(optimised(more).design.after.objective < 1.005 * optimised(few).search_work.objective_at_positions);
}

TEST_CASE("Without rules there is nothing to compare with and no section for it", "[studies][assessment]") {
  const StudyResults results = run_study(parse_study(small::optimisation(), "small.toml", {{"optimise.comparison.rules", "off"}}));
  const json optimise = json::parse(results_json(results))["optimise"];
  CHECK(optimise["comparison"]["rules"].empty());
  CHECK_FALSE(optimise.contains("validation"));
  CHECK(render_report(results_document(results)).find("<section id=\"comparison\">") == std::string::npos);
}

TEST_CASE("Drawn scenes are added to the listed ones, and errors that only they have enter", "[studies][assessment]") {
  const StudyResults results = run_study(parse_study(small::optimisation() + R"(
[optimise.scenes_drawn]
samples = 3
[optimise.tolerances]
"pinion.error.helix_slope" = { uniform = [-10, 10] }
)",
                                                     "small.toml"));
  REQUIRE(optimised(results).task.scenes.size() == 6);
  CHECK(optimised(results).task.scenes[5].name == "drawn 3");
  CHECK(optimised(results).task.scenes[5].condition.error.pinion.helix_slope != 0.0);
  // The error misaligns: unmodified flanks see another stress than in the nominal scene.
  CHECK(optimised(results).design.before.scene_measures[5] != optimised(results).design.before.scene_measures[0]);
}

}  // namespace
}  // namespace flankwright::studies
