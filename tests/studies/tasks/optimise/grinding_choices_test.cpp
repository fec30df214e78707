#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "studies/analysis/run_study.hpp"
#include "studies/results/results_json.hpp"
#include "studies/tasks/optimise/optimise_tables.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_texts.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

/// optimise.grinding.smallest_amount and not_together.
namespace flankwright::studies {
namespace {

using Catch::Contains;
using study_texts::problem_of;
using study_texts::read;
using study_texts::results_of;

const std::string two_variables = R"([pinion.modification]
tip_relief = { amount = 0, height = 1 }
[optimise.variables]
"pinion.modification.tip_relief.amount" = [0, 60]
"pinion.modification.profile_crowning" = [0, 20]
)";

const std::string tip_and_profile = "[[\"pinion.modification.tip_relief\", \"pinion.modification.profile_crowning\"]]";

}  // namespace

TEST_CASE("Choices of the grinding are read", "[studies][grinding]") {
  const Study study = read(two_variables + "[optimise.grinding]\nsmallest_amount = 3\nnot_together = " + tip_and_profile + "\n");
  const GrindableAmounts& grindable = study.table<OptimiseTable>().grindable;
  CHECK(grindable.smallest == Approx(3.0 * units::um).epsilon(1e-14));  // round-off
  REQUIRE(grindable.not_together.size() == 1);
  CHECK(grindable.not_together[0].member == Member::Pinion);
  CHECK(grindable.not_together[0].one == parameter_of("tip_relief.amount"));
  CHECK(grindable.not_together[0].other == parameter_of("profile_crowning"));
  CHECK_FALSE(read(two_variables).table<OptimiseTable>().grindable.any());
}

TEST_CASE("Choices that leave no way are refused", "[studies][grinding][input]") {
  const auto refused = [](const std::string& lines, const std::vector<Override>& overrides = {}) {
    return problem_of(two_variables + "[optimise.grinding]\n" + lines + "\n", overrides);
  };
  CHECK(refused("smallest_amount = 0").key == "optimise.grinding.smallest_amount");
  CHECK_THAT(refused("smallest_amount = 5\nlargest_amount = 4").allowed, Contains("at most that"));
  const StudyProblem closed = refused("smallest_amount = 5", {{"optimise.variables.pinion.modification.lead_crowning", "[1, 4]"}});
  CHECK(closed.key == "optimise.variables.pinion.modification.lead_crowning");
  CHECK_THAT(closed.allowed, Contains("holds 0 or reaches"));
  const Override tie{"optimise.ties.wheel.modification.profile_crowning", "{ as = \"pinion.modification.profile_crowning\", offset = 2 }"};
  CHECK_THAT(refused("smallest_amount = 5", {tie}).allowed, Contains("offset = 0"));

  CHECK(refused("not_together = []").key == "optimise.grinding.not_together");
  CHECK_THAT(refused("not_together = [[\"pinion.modification.tip_relief.amount\"]]").allowed, Contains("list of pairs"));
  CHECK_THAT(refused("not_together = [[\"pinion.modification.tip_relief.height\", \"pinion.modification.profile_crowning\"]]").allowed,
             Contains("no heights or lengths"));
  CHECK_THAT(refused("not_together = [[\"wheel.modification.profile_crowning\", \"pinion.modification.profile_crowning\"]]").allowed,
             Contains("of one gear"));
  CHECK_THAT(refused("not_together = [[\"pinion.modification.addendum_crowning\", \"pinion.modification.profile_crowning\"]]").allowed,
             Contains("same modification"));
  CHECK_THAT(refused("not_together = [[\"pinion.modification.twist\", \"pinion.modification.lead_slope\"]]").allowed, Contains("hold one at 0"));
  CHECK_THAT(refused("not_together = [[\"pinion.modification.tip_releif.amount\", \"pinion.modification.profile_crowning\"]]").allowed,
             Contains("did you mean"));
}

TEST_CASE("Results say what could not be ground, what was tried and what each gave", "[studies][grinding][optimise]") {
  const std::vector<Override> overrides{{"optimise.grinding.smallest_amount", "6"}};
  const Json free = results_of(small::optimisation())["optimise"];
  CHECK_FALSE(free.contains("grinding_choices"));
  const StudyResults results = run_study(parse_study(small::optimisation(), "study", overrides));
  const Json found = Json::parse(results_json(results))["optimise"];
  const Json& choices = found["grinding_choices"];
  REQUIRE(!choices.empty());  // the best slope and end relief are below it
  const std::string summary = optimise_summary(results);
  for (const Json& choice : choices) {
    CAPTURE(choice.dump());
    CHECK(choice["rule"] == "smallest_amount");
    CHECK(std::abs(choice["amounts"][0]["found"].get<double>()) < 6.0);
    int taken = 0;
    for (const Json& tried : choice["tried"]) {
      taken += tried["taken"].get<bool>() ? 1 : 0;
      const double value = tried["value"].get<double>();
      CHECK((value == 0.0 || std::abs(value) >= 6.0 * (1.0 - 1e-12)));  // round-off
    }
    CHECK(taken == 1);
    CHECK_THAT(summary, Contains(choice["words"].get<std::string>()));
  }
  for (const auto& [key, value] : found["after"]["variables"].items()) {
    CAPTURE(key);
    const double amount = value.get<double>();
    if (key != "pinion.modification.end_relief.length") CHECK((amount == 0.0 || std::abs(amount) >= 6.0 * (1.0 - 1e-12)));  // round-off
  }
  CHECK(found["exact"]["objective"].get<double>() <= found["after"]["objective"].get<double>() * (1.0 + 1e-4));  // where a search ends
  CHECK_THAT(summary, Contains("this changes the objective by"));
}

TEST_CASE("Of a pair that is not ground together one is left out, and the results say what each gave", "[studies][grinding][optimise]") {
  const std::string pair = "[[\"pinion.modification.lead_crowning\", \"pinion.modification.end_relief.amount\"]]";
  const Json found = results_of(small::optimisation(), {{"optimise.grinding.not_together", pair}})["optimise"];
  const Json& variables = found["after"]["variables"];
  const bool crowned = variables["pinion.modification.lead_crowning"].get<double>() != 0.0;
  const bool relieved = variables["pinion.modification.end_relief.amount"].get<double>() != 0.0;
  CHECK_FALSE((crowned && relieved));
  for (const Json& choice : found["grinding_choices"]) {
    CHECK(choice["rule"] == "not_together");
    REQUIRE(choice["tried"].size() == 2);
    const Json &one = choice["tried"][0], &other = choice["tried"][1];
    CHECK_THAT(choice["words"].get<std::string>(), Contains("without end relief"));
    if (one["constraint_violation"].get<double>() <= 1e-6 && other["constraint_violation"].get<double>() <= 1e-6) {
      CHECK(one["taken"].get<bool>() == (one["objective"].get<double>() <= other["objective"].get<double>()));
    }
  }
}

}  // namespace flankwright::studies
