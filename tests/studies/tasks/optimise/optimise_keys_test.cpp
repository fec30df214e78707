#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/base/json_format.hpp"
#include "studies/exchange/dynamics/dynamics_tables.hpp"
#include "studies/results/results_json.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/stored_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/results/tables.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_file/life_texts.hpp"
#include "tests/common/about.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

/// Keys of [optimise] beyond the plain objective, and what results.json says of them.
namespace flankwright::studies {
namespace {

using json = Json;

constexpr double optimisation_round_off = 1e-14;

Study read_optimisation(const std::string& tables, const std::vector<Override>& overrides = {}) {
  return parse_study(small::optimisation() + tables, "small.toml", overrides);
}

StudyProblem optimisation_problem(const std::string& tables, const std::vector<Override>& overrides = {}) {
  try {
    read_optimisation(tables, overrides);
  } catch (const StudyErrors& errors) {
    return errors.problems().front();
  }
  FAIL("nothing was refused");
  return {};
}

json run_optimisation(const std::string& tables, const std::vector<Override>& overrides = {}) {
  return json::parse(results_json(run_study(read_optimisation(tables, overrides))));
}

const std::string wheel_link = R"([optimise.ties]
"wheel.modification.lead_crowning" = { as = "pinion.modification.lead_crowning", factor = -1, offset = 40 }
)";

}  // namespace

TEST_CASE("Steps, ties and bounds on sums are read in their own units", "[studies][optimise-keys]") {
  const OptimiseTable table =
      read_optimisation(wheel_link, {{"optimise.step", "0.5"}, {"optimise.variables.wheel.modification.twist", "{ range = [-10, 10], step = 2 }"}})
          .table<OptimiseTable>();
  REQUIRE(table.variables.size() == 5);
  for (const DesignVariable& v : table.variables) {
    CAPTURE(v.path);
    const double step = v.path == "wheel.modification.twist"                ? 0.002
                        : v.path == "pinion.modification.end_relief.length" ? 0.0  // no amount
                                                                            : 0.0005;
    CHECK(v.step == Approx(step).epsilon(optimisation_round_off));
  }
  const OptimiseTable unstepped = read_optimisation("", {{"optimise.step", "none"}}).table<OptimiseTable>();
  for (const DesignVariable& v : unstepped.variables) CHECK(v.step == 0.0);
  CHECK_THAT(optimisation_problem("", {{"optimise.step", "0"}}).allowed, Catch::Contains("above 0 and at most 100 um, or \"none\""));
  REQUIRE(table.links.size() == 1);
  CHECK(table.links[0].linked.member == Member::Wheel);
  CHECK(table.variables[table.links[0].as].path == "pinion.modification.lead_crowning");
  CHECK(table.links[0].factor == -1.0);
  CHECK(table.links[0].offset == Approx(0.040).epsilon(optimisation_round_off));
  CHECK(table.links[0].linked.lower == tests::about(0.0, 1e-17));
  CHECK(table.links[0].linked.upper == Approx(0.040).epsilon(optimisation_round_off));
}

TEST_CASE("A sum of modifications may be bounded from both sides", "[studies][optimise-keys]") {
  const OptimiseTable table =
      read_optimisation("\"2 * pinion.modification.lead_crowning - pinion.modification.lead_slope\" = { min = -5, max = \"0.03 mm\" }\n")
          .table<OptimiseTable>();
  REQUIRE(table.modification_constraints.size() == 1);
  const ModificationConstraint& sum = table.modification_constraints[0];
  REQUIRE(sum.terms.size() == 2);
  CHECK(sum.terms[0].factor == 2.0);
  CHECK(sum.terms[1].factor == -1.0);
  CHECK(sum.minimum == Approx(-0.005).epsilon(optimisation_round_off));
  CHECK(sum.maximum == Approx(0.030).epsilon(optimisation_round_off));
}

TEST_CASE("Impossible values of [optimise] are refused at their position", "[studies][optimise-keys]") {
  struct Row {
    std::string tables;
    std::vector<Override> overrides;
    std::string key, allowed;
  };
  const std::string link = "optimise.ties.wheel.modification.lead_crowning";
  const Row row =
      GENERATE_COPY(Row{"[optimise.ties]\n\"wheel.modification.lead_crowning\" = { as = \"wheel.modification.twist\" }\n",
                        {},
                        link + ".as",
                        "one of optimise.variables"},
                    Row{"[optimise.ties]\n\"wheel.modification.lead_crowning\" = { as = \"pinion.modification.end_relief.length\" }\n",
                        {},
                        link + ".as",
                        "another unit"},
                    Row{"[optimise.ties]\n\"wheel.modification.lead_crowning\" = { like = \"x\" }\n", {}, link, "as ="},
                    Row{"[optimise.ties]\n\"pinion.modification.lead_slope\" = { as = \"pinion.modification.lead_crowning\" }\n",
                        {},
                        "optimise.ties.pinion.modification.lead_slope",
                        "a variable as well"},
                    Row{"[optimise.ties]\n\"wheel.modification.lead_crowning\" = { as = \"pinion.modification.lead_crowning\", factor = 100 }\n",
                        {},
                        link,
                        "leaves its range"},
                    Row{"\"pinion.modification.lead_crowning + pinion.modification.end_relief.length\" = { max = 3 }\n",
                        {},
                        "optimise.constraints.pinion.modification.lead_crowning + pinion.modification.end_relief.length",
                        "one unit"},
                    Row{"\"wheel.modification.twist\" = { max = 3 }\n", {}, "optimise.constraints.wheel.modification.twist", "holds no variable"},
                    Row{"\"edge_load\" = { min = 3, max = 2 }\n", {}, "optimise.constraints.edge_load", "min at most max"},
                    Row{"\"edge_load\" = { about = 3 }\n", {}, "optimise.constraints.edge_load.about", "unknown key"},
                    Row{"", {{"optimise.sigmas", "3"}}, "optimise.sigmas", "mean+sigmas"},
                    Row{"",
                        {{"optimise.variables.wheel.modification.twist", "{ range = [0, 1], step = 3 }"}},
                        "optimise.variables.wheel.modification.twist",
                        "step"},
                    Row{"", {{"optimise.objective", "[]"}}, "optimise.objective", "a list"},
                    Row{"", {{"optimise.pareto.objectives", "[\"edge_load\"]"}}, "optimise.pareto.objectives", "two or three"});
  CAPTURE(row.tables);
  const StudyProblem problem = optimisation_problem(row.tables, row.overrides);
  CHECK(problem.key == row.key);
  CHECK_THAT(problem.allowed, Catch::Contains(row.allowed));
}

TEST_CASE("Root stress with rigid teeth is refused in one line", "[studies][optimise-keys]") {
  try {
    read_optimisation("peak_root_stress = { max = 300 }\n", {{"fidelity.compliance", "rigid"}});
    FAIL("nothing was refused");
  } catch (const StudyErrors& errors) {
    REQUIRE(errors.problems().size() == 1);
    const StudyProblem& problem = errors.problems().front();
    CHECK(problem.key == "fidelity.compliance");
    CHECK_THAT(problem.allowed, Catch::Contains("root stress is asked for and needs an elastic compliance: allowed is \"thin_slice\""));
  }
}

TEST_CASE("Any k of sigma and any level of the tail are read", "[studies][optimise-keys]") {
  const Aggregation sigmas = read_optimisation("", {{"optimise.over", "mean+sigmas"}, {"optimise.sigmas", "3"}}).table<OptimiseTable>().over;
  CHECK(sigmas == Aggregate::MeanPlusSigmas);
  CHECK(sigmas.sigmas == 3.0);
  const Aggregation tail = read_optimisation("", {{"optimise.over", "cvar"}, {"optimise.cvar_level", "0.75"}}).table<OptimiseTable>().over;
  CHECK(tail == Aggregate::Cvar);
  CHECK(tail.level == 0.75);
}

TEST_CASE("Results have the rounded design, the exact optimum and its optimality", "[studies][optimise-keys]") {
  const json optimise = run_optimisation(
      wheel_link,
      {{"optimise.step", "1"}, {"optimise.starts", "2"}, {"optimise.objective", "[\"peak_contact_stress\", \"te_peak_to_peak\"]"}})["optimise"];
  for (const char* name : {"pinion.modification.lead_crowning", "pinion.modification.lead_slope"}) {
    const double ground = optimise["after"]["variables"][name], exact = optimise["exact"]["variables"][name];
    CHECK(std::abs(ground - std::round(ground)) < 1e-9);
    CHECK(std::abs(ground - exact) <= 5.0);
    CHECK(optimise["rounded"]["variables"][name] == ground);
  }
  const double crowning = optimise["after"]["variables"]["pinion.modification.lead_crowning"];
  CHECK(optimise["after"]["tied"]["wheel.modification.lead_crowning"].get<double>() == Approx(40.0 - crowning).epsilon(1e-12));
  const double loss = optimise["after"]["objective"].get<double>() / optimise["exact"]["objective"].get<double>() - 1.0;
  CHECK(optimise["rounded"]["loss_percent"].get<double>() == tests::about(100.0 * loss, 1e-9));
  CHECK(optimise["starts"].size() == 2);
  CHECK(optimise["optima"].size() >= 1);
  CHECK(optimise["stages"].size() == 2);
  CHECK(optimise["exact"]["objective"].get<double>() <= optimise["stages"][0]["limit"].get<double>() * (1.0 + 1e-6));
  CHECK(optimise["optimality"]["residual"].get<double>() < 1e-3);
}

TEST_CASE("The summary of a list has every objective before and after, and says which one a sentence is about", "[studies][optimise-keys]") {
  StudyResults results =
      run_study(read_optimisation("", {{"optimise.step", "1"}, {"optimise.objective", "[\"peak_contact_stress\", \"te_peak_to_peak\"]"}}));
  const std::string summary = summary_table(results);
  CAPTURE(summary);
  CHECK_THAT(summary, Catch::Contains("\npeak contact stress [MPa]\n") && Catch::Contains("\nthen peak-to-peak TE [um]\n"));
  CHECK_THAT(summary, Catch::Contains(" governs the peak-to-peak TE with weight"));
  CHECK_THAT(summary, Catch::Contains("changes the peak contact stress by") && Catch::Contains("changes the peak-to-peak TE by"));
  CHECK_THAT(summary, Catch::Contains("The earlier objective, peak contact stress, is at its limit"));
  CHECK_THAT(summary, !Catch::Contains("the objective by"));
  const json stages = json::parse(results_json(results))["optimise"]["stages"];
  CHECK(stages[0]["unit"] == "MPa");
  CHECK(stages[1]["unit"] == "um");
}

TEST_CASE("Where steps gain instead of costing, the reason is said", "[studies][optimise-keys]") {
  StudyResults results = run_study(read_optimisation("", {{"optimise.step", "1"}}));
  OptimiseResults found = optimised(results);
  REQUIRE(found.design.exact);
  const auto says_why = [&](double exact) {
    found.design.exact->objective = exact * found.design.after.objective;
    results.set_found(std::make_shared<const OptimiseResults>(found));
    return summary_table(results).find("has a peak between the mesh positions") != std::string::npos;
  };
  CHECK(says_why(1.05));
  CHECK_FALSE(says_why(1.005));
  CHECK_FALSE(says_why(0.95));
}

TEST_CASE("Where the exact objective is 0 or nearly so, both values are said and no per cent", "[studies][optimise-keys]") {
  StudyResults results = run_study(read_optimisation("", {{"optimise.step", "1"}}));
  OptimiseResults found = optimised(results);
  REQUIRE(found.design.exact);
  const auto said = [&](double exact, double ground) {
    found.design.exact->objective = exact;
    found.design.after.objective = ground;
    results.set_found(std::make_shared<const OptimiseResults>(found));
    const json rounded = json::parse(results_json(results))["optimise"]["rounded"];
    CHECK(rounded["loss_percent"].is_null());
    CHECK(rounded["objective"] == ground);
    return summary_table(results);
  };
  CHECK_THAT(said(0.0, 0.0), Catch::Contains("rounding to the steps leaves the objective at 0 MPa\n"));
  CHECK_THAT(said(0.0, 3.0), Catch::Contains("rounding to the steps changes the objective from 0 to 3 MPa\n"));
  CHECK_THAT(said(1e-10, 5e-4), Catch::Contains("rounding to the steps changes the objective from 1e-10 to 0.0005 MPa\n"));
}

TEST_CASE("A front is in the results and has its own table", "[studies][optimise-keys]") {
  const Study study = read_optimisation("", {{"optimise.pareto.objectives", "[\"peak_contact_stress\", \"te_peak_to_peak\"]"},
                                             {"optimise.pareto.points", "3"},
                                             {"optimise.max_evaluations", "400"}});
  const StudyResults results = run_study(study);
  const json front = json::parse(results_json(results))["optimise"]["pareto"];
  const std::size_t found = front["points"].size();
  REQUIRE(found >= 2);
  CHECK(((found == 3) != !front["message"].get<std::string>().empty()));  // fewer points than asked for have a reason
  for (const json& point : front["points"]) {
    CHECK(point["variables"].size() == 4);
    REQUIRE(point["errors"].size() == 2);
    for (const std::size_t k : {0, 1}) CHECK(point["errors"][k] > 0.0);
  }
  CHECK(front["points"][0]["values"][0].get<double>() < front["points"][found - 1]["values"][0].get<double>());
  const std::vector<NamedText> tables = csv_tables(results);
  const auto csv = std::ranges::find(tables, "pareto.csv", &NamedText::name);
  REQUIRE(csv != tables.end());
  CHECK(std::ranges::count(csv->text, '\n') == static_cast<long>(found) + 1);
}

TEST_CASE("A front of a temperature has errors of it too", "[studies][optimise-keys][life]") {
  const StudyResults results = run_study(parse_study("task = \"optimise\"\n" + life_pair + R"(
[load]
speed = 1000
torque = 250
[pinion.modification]
tip_relief = { amount = 5, height = 2 }
[wheel.modification]
tip_relief = { amount = 5, height = 2 }
[lubricant]
viscosity_40 = 100
viscosity_100 = 11
temperature = 80
roughness = 0.5
[optimise]
objective = "flash_temperature"
[optimise.variables]
"pinion.modification.tip_relief.amount" = [0, 20]
"wheel.modification.tip_relief.amount" = [0, 20]
[optimise.pareto]
objectives = ["flash_temperature", "te_peak_to_peak"]
points = 3
)",
                                                     "front.toml", {{"cycle.peaks", "\"refined\""}}));
  const json points = json::parse(results_json(results))["optimise"]["pareto"]["points"];
  REQUIRE(points.size() >= 2);
  for (const json& point : points) {
    for (const std::size_t k : {0, 1}) CHECK(point["errors"][k] > 0.0);
  }
}

TEST_CASE("A front knows the optimum, and its objectives may need what no other part of the study does", "[studies][optimise-keys][life]") {
  const StudyResults results = run_study(parse_study("task = \"optimise\"\n" + life_pair + R"(
[material]
strength = { kind = "case_hardened", quality = "MQ", hardness = 700 }
[load]
speed = 1000
torque = 250
[optimise]
objective = "contact_utilisation"
[optimise.variables]
"pinion.modification.profile_crowning" = [0, 20]
[optimise.pareto]
objectives = ["contact_utilisation", "root_utilisation"]
points = 3
)",
                                                     "front.toml"));
  const json optimise = json::parse(results_json(results))["optimise"];
  double least = INFINITY;
  for (const json& point : optimise["pareto"]["points"]) {
    CHECK(point["values"][1].get<double>() > 0.0);
    least = std::min(least, point["values"][0].get<double>());
  }
  // The end of the front may give up a thousandth of what is least; both have the extremes between positions.
  CHECK(least <= 1.001 * optimise["after"]["objective"].get<double>());
}

TEST_CASE("Exports have the modifications that are tied to the variables", "[studies][optimise-keys][exchange]") {
  const StudyResults results = run_study(read_optimisation(wheel_link));
  const double tied = optimised(results).design.after.linked.at(0);
  REQUIRE(tied != 0.0);
  const Study stored = stored_study(json::parse(results_json(results)), "results.json", StoredFlanks::Final);
  CHECK(stored.modification.wheel.lead_crowning == Approx(tied).epsilon(1e-12));  // round-off of the file's units
  CHECK(stored_study(json::parse(results_json(results)), "results.json", StoredFlanks::Given).modification.wheel.lead_crowning == 0.0);
  // What excites the gears is that of the flanks asked for.
  const Json document = json::parse(results_json(results));
  const auto mean_te = [&](StoredFlanks flanks, const char* design) {
    const DynamicsRun run = mesh_excitation(document, "results.json", flanks);
    CHECK(run.design == (flanks == StoredFlanks::Given ? "given" : "after"));
    double sum = 0.0;
    for (const MeshExcitation::Position& at : run.cases.at(0).cycle) sum += at.transmission_error;
    const auto shown = std::ranges::find(results.loaded, design, &LoadedResult::design);
    REQUIRE(shown != results.loaded.end());
    CHECK(sum / static_cast<double>(run.cases[0].cycle.size()) == Approx(shown->cycle.transmission_error().mean()).epsilon(1e-9));  // solver
    return sum;
  };
  CHECK(mean_te(StoredFlanks::Given, "before") != mean_te(StoredFlanks::Final, "after"));
}

}  // namespace flankwright::studies
