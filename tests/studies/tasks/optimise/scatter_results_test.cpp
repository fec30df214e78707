#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "studies/analysis/run_study.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/results/tables.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/tasks/optimise/unmet_constraints.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_file/life_texts.hpp"
#include "tests/studies/study_texts.hpp"

/// What the results say of a search over draws.
namespace flankwright::studies {
namespace {

using Catch::Contains;
using study_texts::results_of;

/// The small optimisation over few draws, without its constraint.
std::string drawn_study(const std::string& scatter = "", const std::string& scenes = "") {
  std::string text = small::optimisation();
  text.erase(text.find("[optimise.constraints]"));
  return text + scenes + R"(
[optimise.comparison]
rules = "off"
[optimise.tolerances]
"misalignment.mesh_misalignment" = { normal = [0, 6] }
[optimise.validation]
samples = 24
seed = 2
[optimise.scatter]
draws = 24
statistic = { quantile = 0.9 }
iso_1328_class = 6
predicted_from = 0
)" + scatter;
}

const std::string coast = R"(
[[scenes]]
name = "coast"
working_flank = "left"
load.torque = 1400
)";

}  // namespace

TEST_CASE("The validation tries the design that the search over draws found", "[studies][scatter][assessment]") {
  const Json optimise = results_of(drawn_study("fresh = 24\nfresh_seed = 2\n"))["optimise"];
  const Json &validated = optimise["validation"]["designs"], &fresh = optimise["scatter"]["fresh"]["designs"];
  REQUIRE(fresh[2]["name"] == "after");
  // The same draws of the same design.
  for (const char* figure : {"mean", "greatest"}) {
    CHECK(validated[0][figure] == fresh[0][figure]);
    CHECK(validated[1][figure] == fresh[2][figure]);
  }
  CHECK(fresh[1]["mean"] != fresh[2]["mean"]);  // the one found without scatter is another
  CHECK_THAT(optimise["assessed_design"].get<std::string>(), Contains("over the listed scenes"));
  CHECK(optimise["governing"]["design"] == optimise["assessed_design"]);
}

TEST_CASE("The design over draws keeps the smallest amount, and its choices are those shown", "[studies][scatter][grinding]") {
  const StudyResults results = run_study(parse_study(drawn_study("[optimise.grinding]\nsmallest_amount = 12\n"), "smallest.toml"));
  const Json optimise = Json::parse(results_json(results))["optimise"];
  for (const auto& [key, value] : optimise["scatter"]["variables"].items()) {
    CAPTURE(key);
    const double amount = value.get<double>();
    if (key != "pinion.modification.end_relief.length") CHECK((amount == 0.0 || std::abs(amount) >= 12.0 * (1.0 - 1e-12)));  // round-off
  }
  REQUIRE(!optimise["grinding_choices"].empty());
  for (const Json& choice : optimise["grinding_choices"]) {
    CHECK(choice["statistic_in_words"] == "90 % quantile");
    CHECK_THAT(choice["words"].get<std::string>(), Contains("gives a 90 % quantile of"));
    CHECK_THAT(summary_table(results), Contains(choice["words"].get<std::string>()));
  }
}

TEST_CASE("A draw runs through all operating states, and results count draws", "[studies][scatter]") {
  const StudyResults results = run_study(parse_study(drawn_study("", coast), "drive-and-coast.toml"));
  const Json optimise = Json::parse(results_json(results))["optimise"], &scatter = optimise["scatter"];
  CHECK(scatter["states"] == Json({"aligned", "coast"}));
  CHECK(scatter["load_cases_of_a_draw"] == 2);
  CHECK(scatter["draws"] == 24);
  CHECK(optimise["validation"]["samples"] == 24);
  CHECK_THAT(summary_table(results), Contains("over 24 draws of the search, each in 2 operating states (aligned, coast), the worst of which counts"));
  // The coast state has the larger torque: aligned, it has less stress than nine of ten drawn gears have in the worst of both.
  double aligned_coast = 0.0;
  for (const Json& scene : optimise["scenes"]) {
    if (scene["name"] == "coast") aligned_coast = scene["after"].get<double>();
  }
  CHECK(scatter["value"].get<double>() > aligned_coast);
}

TEST_CASE("Draws under a load spectrum have the damage of the design, as much as they scatter", "[studies][scatter][life]") {
  const auto study = [](const std::string& deviation) {
    return "task = \"optimise\"\n" + life_pair + life_strength + R"(
[load]
speed = 1500
spectrum = [{ torque = 300, hours = 10 }, { torque = 200, hours = 1000, mesh_misalignment = 6 }]
[optimise]
objective = "contact_damage"
[optimise.comparison]
rules = "off"
[optimise.variables]
"pinion.modification.lead_crowning" = [2, 20]
[optimise.tolerances]
"misalignment.mesh_misalignment" = { normal = [0, )" +
           deviation + R"(] }
[optimise.validation]
samples = 8
seed = 2
[optimise.scatter]
draws = 8
statistic = { quantile = 0.9 }
predicted_from = 0
)";
  };
  const StudyResults still = run_study(parse_study(study("1e-6"), "still.toml"));
  const Json optimise = Json::parse(results_json(still))["optimise"], &scatter = optimise["scatter"];
  REQUIRE(scatter["draws"] == 8);
  // Draws that do not scatter; what is left is how far the searches converge.
  CHECK(scatter["value"].get<double>() == Approx(optimised(still).design.after.objective).epsilon(1e-3));
  CHECK(optimise["validation"]["designs"][1]["greatest"].get<double>() == Approx(scatter["value"].get<double>()).epsilon(1e-4));
  const Json moved = results_of(study("4"))["optimise"]["scatter"];
  CHECK(moved["value"].get<double>() > 1.05 * scatter["value"].get<double>());
}

TEST_CASE("A limit on a statistic is kept over gears that the search has not seen", "[studies][scatter]") {
  constexpr double most = 2700.0;
  const Json scatter = study_texts::results_of(drawn_study(), {{"optimise.objective", "\"te_peak_to_peak\""},
                                                               {"optimise.constraints.peak_contact_stress", "{ max = 2700 }"},
                                                               {"optimise.scatter.seed", "4"},
                                                               {"optimise.scatter.predicted_from", "400"}})["optimise"]["scatter"];
  const Json& limit = scatter["constraints"][0];
  CAPTURE(limit.dump());
  REQUIRE(scatter["status"] == "converged");
  CHECK(limit["predicted"]["value"].get<double>() <= (1.0 + told_apart) * most);
  // The gears of the search are better than others: it kept to a tighter limit.
  CHECK(limit["searched_limit"].get<double>() < most);
  CHECK(limit["value"].get<double>() <= limit["searched_limit"].get<double>() * (1.0 + 1e-6));  // the tolerance of the search
}

TEST_CASE("A limit that the prediction exceeds is said not to be kept", "[studies][scatter]") {
  const Aggregation statistic{Aggregate::Quantile, 2.0, 0.95};
  DesignTask task;
  task.constraints = {{.output = *find_term("peak_contact_stress"), .maximum = 1500.0},
                      {.output = *find_term("specific_film_thickness"), .minimum = 0.5}};
  ScatterResult result;
  const auto sentences = [&](double stress, double reciprocal) {
    result.predicted_limits = {{.value = stress}, {.value = reciprocal}};
    return limits_exceeded_over_draws(result, task, statistic);
  };
  CHECK(sentences(1502.0, 1.9).empty());
  const std::vector<std::string> both = sentences(1700.0, 2.5);
  REQUIRE(both.size() == 2);
  CHECK_THAT(both[0], Contains("the 95 % quantile of peak contact stress over drawn gears does not keep <= 1500 MPa: 1700 is predicted"));
  CHECK_THAT(both[1], Contains("the 5 % quantile of ") && Contains(">= 0.5: 0.4 is predicted"));
}

TEST_CASE("A class has the same design whatever the list, and the study's own class has the study's design", "[studies][scatter]") {
  const Json some = results_of(drawn_study("classes = [4, 6]\n"))["optimise"]["scatter"];
  const Json one = results_of(drawn_study("classes = [4]\n"))["optimise"]["scatter"]["classes"][0];
  CHECK(some["classes"][0]["variables"] == one["variables"]);
  CHECK(some["classes"][0]["value"] == one["value"]);
  CHECK(some["classes"][1]["value"] == some["value"]);
  CHECK(some["classes"][1]["variables"] == some["variables"]);
  // The contact stress is the objective: a class has one value of it.
  for (const Json& row : some["classes"]) CHECK(row["peak_contact_stress_MPa"] == row["value"]);
  CHECK(one["value"].get<double>() <= some["value"].get<double>());  // finer gears
}

}  // namespace flankwright::studies
