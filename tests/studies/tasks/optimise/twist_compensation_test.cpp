#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "studies/analysis/run_study.hpp"
#include "studies/base/plain_names.hpp"
#include "studies/results/results_json.hpp"
#include "studies/results/tables.hpp"
#include "studies/tasks/optimise/optimise_tables.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_texts.hpp"

/// twist_compensation as a variable of a search and as a parameter of derivatives.
namespace flankwright::studies {
namespace {

using Catch::Contains;
using study_texts::problem_of;
using study_texts::results_of;

const std::string compensation_key = "pinion.twist_compensation";

/// The small optimisation with the compensation as its only variable, over a lead crowning that its twist spoils. Tips are relieved: no edge carries load.
std::string over_compensation() {
  std::string text = small::optimisation();
  text.erase(text.find("[optimise.variables]"));
  const std::string flanks =
      "[wheel.modification]\ntip_relief = { amount = 15, height = 4 }\n[pinion.modification]\nlead_crowning = 12\n"
      "tip_relief = { amount = 15, height = 4 }\n";
  return study_texts::replaced(text, "[pinion.modification]\n", flanks) + "[optimise.variables]\n\"" + compensation_key + "\" = [0, 1]\n";
}

const Override generated{"pinion.process", "generating_grinding"};

/// Worst peak stress over the scenes of a design with one compensation, analysed by itself.
double worst_stress(const std::string& text, const std::vector<Override>& overrides) {
  std::string analysed = study_texts::replaced(text, "task = \"optimise\"", "");
  analysed.erase(analysed.find("[optimise]"));
  double worst = 0.0;
  const Json results = results_of(analysed, overrides);
  for (const Json& loaded : results["loaded"]) {
    worst = std::max(worst, loaded["summary"]["peak_contact_stress_MPa"].get<double>());
  }
  return worst;
}

}  // namespace

TEST_CASE("A search finds the compensation that no other one beats", "[studies][grinding][optimise]") {
  const std::string process = GENERATE("generating_grinding", "form_grinding");
  CAPTURE(process);
  // Of the positions only, which is what a search sees.
  const Override ground{"pinion.process", process}, sampled{"cycle.peaks", "sampled"};
  const Json results = results_of(over_compensation(), {ground, sampled}), found = results["optimise"];
  const double best = found["after"]["objective"].get<double>(), part = found["after"]["variables"][compensation_key].get<double>();
  CHECK(found["after"]["variable_units"][compensation_key] == "1");
  CHECK(part >= 0.0);
  CHECK(part <= 1.0);
  double least = INFINITY;
  for (int i = 0; i <= 8; ++i) {
    const std::string tried = std::to_string(i / 8.0);
    least = std::min(least, worst_stress(over_compensation(), {ground, sampled, {compensation_key, tried}}));
  }
  const double none = worst_stress(over_compensation(), {ground, sampled, {compensation_key, "0"}});
  CAPTURE(part, best, least, none);
  CHECK(best <= least * (1.0 + 1e-4));  // discretisation: a search ends where it gains less than 1e-5
  CHECK(none > 1.01 * best);            // the twist hurts
}

TEST_CASE("With the other variables free no partial compensation is better than the one found", "[studies][grinding][optimise]") {
  const auto optimum = [](const std::string& variable) {
    return results_of(small::optimisation(), {generated, {"optimise.variables." + compensation_key, variable}})["optimise"]["after"];
  };
  const Json free = optimum("[0, 1]");
  const double best = free["objective"].get<double>();
  for (const std::string held : {"[0, 0.001]", "[0.999, 1]"}) {
    CAPTURE(held, free["variables"].dump());
    CHECK(best <= optimum(held)["objective"].get<double>() * (1.0 + 5e-3));  // the searches' local optima
  }
}

TEST_CASE("Tables name a compensation in words", "[studies][grinding][optimise]") {
  CHECK(plain_name("wheel.twist_compensation") == "wheel twist compensation");
  const StudyResults results = run_study(parse_study(over_compensation(), "study", {generated}));
  const std::string summary = optimise_summary(results);
  CAPTURE(summary);
  const std::size_t line = summary.find("pinion twist compensation");
  REQUIRE(line != std::string::npos);
  CHECK_THAT(summary.substr(line, summary.find('\n', line) - line), Contains("of 1"));
}

TEST_CASE("A compensation is no variable where there is nothing to compensate", "[studies][grinding][input]") {
  const std::string variable = "[optimise.variables]\n\"pinion.twist_compensation\" = [0, 1]\n";
  const StudyProblem none = problem_of(variable);
  CHECK(none.key == "optimise.variables.pinion.twist_compensation");
  CHECK_THAT(none.value, Contains("0, 1"));
  CHECK_THAT(none.allowed, Contains("pinion.process is \"none\", which has no natural twist"));
  CHECK_THAT(problem_of(variable, {{"pinion.process", "topological"}}).allowed, Contains("\"topological\", which has no natural twist"));
  CHECK_THAT(problem_of(variable, {generated, {"pair.helix_angle", "0"}}).allowed, Contains("a spur gear has no natural twist"));
  CHECK_THAT(problem_of(variable, {generated, {"fidelity.effects", "[\"modifications\"]"}}).allowed, Contains("leaves the natural twist out"));
  // The other gear's process does not count, and a tie needs a twist of its own.
  CHECK_THAT(problem_of(variable, {{"wheel.process", "generating_grinding"}}).allowed, Contains("pinion.process"));
  const std::string tie = variable + "[optimise.ties]\n\"wheel.twist_compensation\" = { as = \"pinion.twist_compensation\" }\n";
  CHECK(problem_of(tie, {generated}).key == "optimise.ties.wheel.twist_compensation");
  CHECK(study_texts::problems_of(study_texts::small_study + tie, {generated, {"wheel.process", "form_grinding"}}).empty());
  CHECK(problem_of("[optimise.variables]\n\"pinion.twist_compensation\" = [0, 1.5]\n", {generated}).key == none.key);
}

TEST_CASE("Derivatives by a compensation are differences of analyses", "[studies][grinding][gradient]") {
  const auto results = [](double part, bool with_gradients) {
    std::vector<Override> overrides{generated, {compensation_key, std::to_string(part)}};
    if (with_gradients) overrides.push_back({"analyse.gradients", "[\"pinion.twist_compensation\"]"});
    return results_of(small::analysis(), overrides)["loaded"];
  };
  constexpr double step = 1e-3;
  const Json at = results(0.4, true), more = results(0.4 + step, false), less = results(0.4 - step, false);
  REQUIRE(at.size() == 2);  // the loaded ones
  int compared = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    CHECK(at[i]["gradients"]["units"][0] == "-");
    for (const char* name : {"te_peak_to_peak_um", "te_mean_um", "mean_stiffness_N_per_mm_um"}) {
      const auto value = [&](const Json& of) { return of[i]["summary"][name].get<double>(); };
      const double difference = (value(more) - value(less)) / (2.0 * step), exact = at[i]["gradients"]["summary"][name][0].get<double>();
      CAPTURE(name, i, exact, difference);
      CHECK(exact == Approx(difference).epsilon(1e-4).margin(1e-5 * std::abs(value(at))));  // discretisation: the step's square, refined positions
      ++compared;
    }
  }
  CHECK(compared == 6);
}

}  // namespace flankwright::studies
