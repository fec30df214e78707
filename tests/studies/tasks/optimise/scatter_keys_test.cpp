#include <catch2/catch.hpp>
#include <set>

#include "core/gear/flank_tolerances.hpp"
#include "studies/analysis/study_notes.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/tasks/optimise/drawn_scenes.hpp"
#include "studies/tasks/optimise/scatter_reading.hpp"
#include "tests/studies/study_texts.hpp"
#include "tests/common/about.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {
namespace {

using Catch::Contains;
using study_texts::problem_of;
using study_texts::read;

TEST_CASE("A class of the scatter adds the tolerances that a study does not give itself", "[studies][scatter]") {
  const Study study = read(R"(
[optimise.tolerances]
"pinion.error.helix_slope" = { normal = [0, 2] }
[optimise.scatter]
draws = 16
iso_1328_class = 6
statistic = { cvar = 0.8 }
)");
  CHECK(study.table<OptimiseTable>().scatter.statistic == Aggregate::Cvar);
  CHECK(study.table<OptimiseTable>().scatter.statistic.level == 0.8);
  const auto& tolerances = study.tolerances;
  CHECK(tolerances.size() == 10);  // two slopes, pitch, two forms of each gear
  CHECK(std::ranges::count(tolerances, std::string("pinion.error.helix_slope"), &SceneTolerance::path) == 1);
  const GearPair pair = make_gear_pair(study.pair);
  const auto finer = with_class(tolerances, pair, 4);
  CHECK(finer.size() == 10);
  const FlankTolerances wheel = flank_tolerances(ToleranceData::of(pair, Member::Wheel), 4);
  for (const SceneTolerance& t : finer) {
    if (t.path == "pinion.error.helix_slope") CHECK(t.distribution == Distribution::normal(0.0, 2.0));
    if (t.path == "wheel.modification.lead_crowning") CHECK(t.distribution == Distribution::within_tolerance(wheel.helix_form / units::um));
  }
}

TEST_CASE("A drawn gear deviates from its design, and the same seed draws the same gear", "[studies][scatter]") {
  const Study study = read("[optimise.scatter]\ndraws = 4\niso_1328_class = 7\n");
  const std::vector<Scene> once = draw_scenes(study, {.samples = 4, .seed = 3}), again = draw_scenes(study, {.samples = 4, .seed = 3});
  const std::vector<Scene> other = draw_scenes(study, {.samples = 4, .seed = 4});
  REQUIRE(once.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    REQUIRE(once[i].deviations.size() == 4);  // two crownings of each gear
    for (std::size_t d = 0; d < 4; ++d) {
      CHECK(once[i].deviations[d].value == again[i].deviations[d].value);
      CHECK(once[i].deviations[d].value != other[i].deviations[d].value);
    }
    CHECK(once[i].error == again[i].error);
  }
}

TEST_CASE("A draw whose axes are so far apart that no teeth meet is refused", "[studies][scatter]") {
  const auto refused = [](const std::string& distribution) {
    return find_refused_draw(read("[optimise.tolerances]\n\"misalignment.centre_distance\" = " + distribution + "\n"), {.samples = 16});
  };
  // m_n = 4 mm: gears mesh 1 mm apart, which no tolerance reaches, and not 100 mm apart.
  CHECK_FALSE(refused("{ uniform = [0, 1] }"));
  REQUIRE(refused("{ uniform = [0, 100] }"));
  CHECK(refused("{ uniform = [0, 100] }")->path == "misalignment.centre_distance");
  CHECK_THAT(refused("{ uniform = [0, 100] }")->allowed, Contains("total contact ratio of at least 1"));
}

TEST_CASE("Seeds that are not given make other draws than those that are", "[studies][scatter]") {
  const auto scatter = [](const std::string& seeds) {
    return read("[optimise.scatter]\ndraws = 8\niso_1328_class = 6\nfresh = 10\n" + seeds).table<OptimiseTable>().scatter;
  };
  CHECK(scatter("").fresh_seed == 2);
  CHECK(scatter("").predicted_seed == 3);
  for (const std::string seeds : {"seed = 2\n", "seed = 3\n", "predicted_seed = 2\n", "fresh_seed = 3\n", "seed = 2\npredicted_seed = 3\n"}) {
    CAPTURE(seeds);
    const ScatterTable of = scatter(seeds);
    CHECK(std::set{of.seed, of.predicted_seed, of.fresh_seed}.size() == 3);
  }
}

TEST_CASE("What scatter has no meaning with is refused", "[studies][scatter]") {
  CHECK_THAT(problem_of("[optimise.scatter]\ndraws = 8\n").allowed, Contains("set optimise.tolerances or optimise.scatter.iso_1328_class"));
  CHECK_THAT(problem_of("[optimise.scatter]\niso_1328_class = 6\n").allowed, Contains("draws above 0"));
  for (const std::string key : {"load.torque", "load.speed"}) {
    const StudyProblem problem = problem_of("[optimise.tolerances]\n\"" + key + "\" = { uniform = [90, 110] }\n",
                                            {{"task", "\"optimise\""},
                                             {"load", "{ speed = 1000, spectrum = [{ torque = 100, hours = 1 }, { torque = 80, hours = 9 }] }"},
                                             {"optimise.variables.pinion.modification.lead_crowning", "[0, 10]"}});
    CHECK_THAT(problem.key, Contains(key));
    CHECK_THAT(problem.allowed, Contains("load.spectrum"));
  }
  CHECK_THAT(problem_of("[optimise.scatter]\ndraws = 8\niso_1328_class = 6\nstatistic = { cvar = 0.9, quantile = 0.9 }\n").allowed,
             Contains("another statistic"));
  CHECK_THAT(problem_of("[optimise.scatter]\ndraws = 8\niso_1328_class = 6\nfresh = 10\nfresh_seed = 1\n").allowed, Contains("same draws"));
  CHECK_THAT(problem_of("[optimise.scatter]\ndraws = 8\niso_1328_class = 6\npredicted_seed = 1\n").allowed,
             Contains("another than optimise.scatter.seed"));
  for (const char* classes : {"[6, 6]", "[6.5]"}) {
    CHECK_THAT(problem_of(std::string("[optimise.scatter]\ndraws = 8\niso_1328_class = 6\nclasses = ") + classes + "\n").allowed,
               Contains("each once"));
  }
  const auto limited = [](const std::string& limit) {
    return "[lubricant]\nviscosity_40 = 220\nviscosity_100 = 19\ntemperature = 80\nroughness = 0.5\n[optimise.scatter]\ndraws = 8\niso_1328_class = 6\n[optimise.constraints]\n" +
           limit;
  };
  const std::vector<Override> task{
      {"task", "\"optimise\""}, {"load.torque", "100"}, {"load.speed", "1000"}, {"optimise.variables.pinion.modification.lead_crowning", "[0, 10]"}};
  CHECK_NOTHROW(
      read(limited("specific_film_thickness = { min = 0.5 }\neffective_contact_ratio = { min = 1.1 }\ncontact_temperature = { max = 150 }"), task));
  CHECK_THAT(problem_of(limited("specific_film_thickness = { max = 0.5 }"), task).allowed, Contains("allowed is { min = ... }"));
  CHECK_THAT(problem_of(limited("edge_load = { min = 5 }"), task).allowed, Contains("allowed is { max = ... }"));
  // One of a hundred draws lies beyond their 99 % quantile, none of 99.
  const auto notes_of = [&](const std::string& draws, const std::string& statistic = "{ quantile = 0.99 }") {
    const Study study = read("[optimise.scatter]\niso_1328_class = 6\nstatistic = " + statistic + "\ndraws = " + draws + "\n", task);
    std::string all;
    for (const std::string& note : study_notes(study, make_gear_pair(study.pair))) all += note;
    return all;
  };
  CHECK_THAT(notes_of("99"), Contains("the 99 % quantile over 99 draws is the largest of them"));
  CHECK_THAT(notes_of("101"), !Contains("quantile"));
  CHECK_THAT(notes_of("99", "{ cvar = 0.99 }"), Contains("the mean beyond the 99 % quantile over 99 draws"));
  // The standard deviation of n draws of a normal distribution is known to 1/sqrt(2 (n - 1)).
  CHECK_THAT(notes_of("3", "{ mean_plus_sigma = 2 }"), Contains("the standard deviation over 3 draws is known to 50 % only"));
  CHECK_THAT(notes_of("101", "{ mean_plus_sigma = 2 }"), !Contains("standard deviation"));
}

TEST_CASE("A range beyond the largest amount is refused, and a limit on the stress of sharp edges", "[studies][grinding][input]") {
  CHECK_THAT(problem_of("[optimise.grinding]\nlargest_amount = 5\n[optimise.variables]\n\"pinion.modification.lead_slope\" = [10, 60]\n").allowed,
             Contains("a range that reaches optimise.grinding.largest_amount = 5 um"));
  const std::string sharp = "[pinion.edges]\ntip_rounding = 0\n", limit = "[optimise.constraints]\n\"edge_stress\" = { max = 900 }\n";
  const std::vector<Override> task{
      {"task", "\"optimise\""}, {"load.torque", "100"}, {"optimise.variables.pinion.modification.lead_crowning", "[0, 10]"}};
  CHECK_THAT(problem_of(sharp + limit, task).allowed, Contains("needs rounded tip edges: pinion.edges.tip_rounding above 0"));
  CHECK_NOTHROW(read(limit, task));
}

TEST_CASE("An output of tip edges needs the effect that has it", "[studies][optimise][edge][errors]") {
  std::vector<Override> task{{"task", "\"optimise\""}, {"load.torque", "100"}, {"optimise.variables.pinion.modification.lead_crowning", "[0, 10]"}};
  for (const char* output : {"edge_stress", "tip_edge_share"}) {
    const std::string limit = std::string("[optimise.constraints]\n\"") + output + "\" = { max = 0.5 }\n";
    CHECK_NOTHROW(read(limit, task));
    std::vector<Override> without = task;
    without.push_back({"fidelity.effects", "[\"bending\", \"hertzian_contact\", \"extended_contact_region\", \"modifications\"]"});
    CHECK_THAT(problem_of(limit, without).allowed, Contains("needs the effect edge_contact"));
  }
}

TEST_CASE("Limits of the grinding become named constraints", "[studies][grinding]") {
  const Study study = read(R"(
[pinion.modification]
tip_relief = { amount = 0, height = 1 }
[optimise.grinding]
largest_amount = 30
steepest_relief = 12
[optimise.variables]
"pinion.modification.lead_slope" = [-40, 40]
"pinion.modification.tip_relief.amount" = [0, 60]
)");
  const auto& limits = study.table<OptimiseTable>().modification_constraints;
  REQUIRE(limits.size() == 3);
  CHECK(limits[0].maximum == Approx(30.0 * units::um).epsilon(1e-14));  // round-off
  CHECK(limits[0].minimum == -limits[0].maximum);                       // a slope has either sign
  CHECK(limits[2].name == "steepest pinion tip relief");
  // 12 um over 1 mm is at the limit, 13 um beyond it.
  PerGear<Modification> m = study.modification;
  set(m.pinion, parameter_of("tip_relief.amount"), 12.0 * units::um);
  constexpr double round_off = 1e-15;  // mm
  CHECK(limits[2].value(m) == tests::about(limits[2].maximum, round_off));
  set(m.pinion, parameter_of("tip_relief.amount"), 13.0 * units::um);
  CHECK(limits[2].value(m) == Approx(units::um).epsilon(1e-12));
}

}  // namespace
}  // namespace flankwright::studies
