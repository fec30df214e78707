#include "studies/analysis/fidelity_choice.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"
#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/tasks/optimise/optimise_tables.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

/// Thin slices, so that no finite elements are solved; `fidelity` adds to that.
Study small_study(const std::string& fidelity, const std::string& more = "", const std::string& task = "") {
  return parse_study(task + small::crowned_pair() + R"([load]
torque = 150
[misalignment]
mesh_misalignment = 5
[fidelity]
compliance = "thin_slice"
)" + fidelity + "\n" + more,
                     "small.toml");
}

}  // namespace

TEST_CASE("An accuracy chooses the settings that the study leaves open, reports them and is kept", "[studies][accuracy][fidelity-choice]") {
  const StudyResults results = run_study(small_study("accuracy = \"10 %\""));
  CHECK(results.requirements.empty());
  REQUIRE(results.fidelity_choice);
  const FidelityChoice& choice = *results.fidelity_choice;
  CHECK(choice.compliance_given);
  CHECK_FALSE((choice.gap_given || choice.quadrature_given || choice.positions_given));
  CHECK(choice.kept);
  CHECK(headline(choice.error()) <= 0.10);
  // What was chosen is what ran.
  CHECK(results.study.fidelity.quadrature.intervals == choice.fidelity.quadrature.intervals);
  CHECK(static_cast<int>(results.phases.size()) == choice.positions);
  const auto json = Json::parse(results_json(results));
  CHECK(json.at("accuracy_choice").at("kept") == true);
  CHECK(json.at("accuracy_choice").at("compliance").at("estimate_percent").is_null());
  CHECK(json.at("used").at("cycle").at("positions") == choice.positions);
  // The last level is the one that is shown, and those before did not suffice.
  const Json& levels = json.at("accuracy_choice").at("quadrature").at("levels");
  CHECK(levels.back().at("positions") == choice.positions);
  CHECK(levels.back().at("outputs").at("te_peak_to_peak_um") == json.at("loaded").at(0).at("summary").at("te_peak_to_peak_um"));
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) CHECK(levels[i].at("error_percent").at("worst").get<double>() > 10.0);
  CHECK(json.at("used").at("fidelity").at("accuracy") == Approx(0.10).epsilon(1e-14));  // round-off
}

TEST_CASE("Effects below what an accuracy leaves are left out of an analysis, with their size as the reason", "[studies][accuracy][effects]") {
  // Relieved far below the tips: nothing of their corners is felt.
  const std::string wide = "[pinion.modification.tip_relief]\namount = 60\nheight = 4\n[wheel.modification.tip_relief]\namount = 60\nheight = 4\n";
  const StudyResults results = run_study(small_study("accuracy = \"30 %\"", wide));
  REQUIRE(results.fidelity_choice);
  CHECK(headline(results.fidelity_choice->effects_budget()) > 0.0);
  const auto tip = std::ranges::find(results.effects, "tip_corner", &EffectDecision::name);
  REQUIRE(tip != results.effects.end());
  CHECK_FALSE(tip->on);
  CHECK_THAT(tip->why, Catch::Contains("below the budget"));
  CHECK_FALSE(results.models.front().effects.has("tip_corner"));
  // Solved with and without, its part is stated with the rest.
  CHECK(std::ranges::find(results.fidelity_choice->left_out.names, "tip_corner") != results.fidelity_choice->left_out.names.end());
  CHECK(headline(results.fidelity_choice->error()) <= 0.30);
  // Without an accuracy nothing is dropped, whatever its size.
  CHECK(is_on(run_study(small_study("", wide)).effects, "tip_corner"));
}

TEST_CASE("The figures of a run with an accuracy are within it of a far finer run", "[studies][accuracy][fidelity-choice]") {
  const StudyResults chosen = run_study(small_study("accuracy = \"5 %\"", "[cycle]\npeaks = \"sampled\"\n"));
  const StudyResults fine = run_study(
      small_study("gap = \"whole_surface\"\nquadrature = { rule = \"graded\", intervals = 32 }", "[cycle]\npositions = 128\npeaks = \"sampled\"\n"));
  const CycleSummary &coarse = chosen.loaded.at(0).summary, &truth = fine.loaded.at(0).summary;
  CHECK(coarse.te_peak_to_peak == Approx(truth.te_peak_to_peak).epsilon(0.05));
  CHECK(std::abs(coarse.te_harmonics[0] - truth.te_harmonics[0]) <= 0.05 * truth.te_peak_to_peak);
  CHECK(coarse.peak_contact_stress == Approx(truth.peak_contact_stress).epsilon(0.05));
  // The line load's peak is no headline figure: within what is stated of it.
  const double line_load_error = chosen.fidelity_choice->error()[static_cast<std::size_t>(Figure::PeakLineLoad)];
  CHECK(coarse.peak_line_load == Approx(truth.peak_line_load).epsilon(line_load_error));
}

TEST_CASE("Settings that a study gives beside an accuracy are kept", "[studies][accuracy][fidelity-choice]") {
  const StudyResults results = run_study(
      small_study("accuracy = \"20 %\"\ngap = \"plane_of_action\"\nquadrature = { rule = \"gauss2\", intervals = 7 }", "[cycle]\npositions = 18\n"));
  REQUIRE(results.fidelity_choice);
  CHECK(results.study.fidelity.quadrature.rule == QuadratureRule::Gauss2);
  CHECK(results.study.fidelity.quadrature.intervals == 7);
  CHECK(results.phases.size() == 18);
  CHECK(results.study.fidelity.gap == GapModel::PlaneOfAction);
  CHECK(largest(results.fidelity_choice->resolution_error) == 0.0);  // nothing was left to choose
}

TEST_CASE("An accuracy is not known to be kept at phases that a study lists", "[studies][accuracy][fidelity-choice]") {
  const StudyResults results = run_study(small_study("accuracy = \"20 %\"", "[cycle]\nphases = [0.1, 0.6]\n"));
  REQUIRE(results.fidelity_choice);
  CHECK_FALSE(results.fidelity_choice->kept);
  REQUIRE(results.requirements.size() == 1);
  CHECK_THAT(results.requirements[0], Catch::Contains("no error is estimated at listed phases"));
}

TEST_CASE("The optimum of a study with an accuracy keeps it", "[studies][accuracy][fidelity-choice]") {
  const std::string search = R"([optimise]
objective = "peak_contact_stress"
comparison.rules = "off"
[optimise.variables]
"pinion.modification.lead_crowning" = [0, 20]
)";
  const StudyResults found = run_study(small_study("accuracy = \"2 %\"", search, "task = \"optimise\"\n"));
  REQUIRE(found.fidelity_choice);
  const FidelityChoice& choice = *found.fidelity_choice;
  CHECK(choice.kept);
  CHECK(headline(choice.error()) <= 0.02);
  CHECK(choice.fidelity.quadrature.intervals == found.study.fidelity.quadrature.intervals);
  // Its stress beside that of the same flanks, resolved more finely than the search.
  const auto after = std::ranges::find(found.loaded, "after", &LoadedResult::design);
  REQUIRE(after != found.loaded.end());
  Study finer = found.study;
  finer.task = small_study("").task;
  finer.modification = found.designs.back().modification;
  finer.fidelity.accuracy.reset();
  finer.fidelity.quadrature.intervals = 48;
  finer.cycle.positions = 128;
  const StudyResults fine = run_study(finer);
  CHECK(after->summary.peak_contact_stress == Approx(fine.loaded.at(0).summary.peak_contact_stress).epsilon(0.02));
}

TEST_CASE("A search that a finer look confirms ends as well as one that goes on there", "[studies][accuracy][fidelity-choice]") {
  const std::string search = R"([optimise]
objective = "peak_contact_stress"
step = "none"
comparison.rules = "off"
[optimise.variables]
"pinion.modification.lead_crowning" = [0, 20]
"pinion.modification.lead_slope" = [-10, 10]
)";
  const auto optimised_with = [&](const std::string& fidelity, const std::string& more) {
    return run_study(small_study(fidelity, search + more, "task = \"optimise\"\n"));
  };
  const StudyResults found = optimised_with("accuracy = \"0.5 %\"", "");
  const SearchWork& work = optimised(found).search_work;
  CHECK(found.fidelity_choice->kept);  // of the design that is shown, whose errors may be larger than those of the search
  REQUIRE(work.confirmed);
  const MeshResolution &ended = work.confirmed->work.resolution, &shown = work.fine.resolution;
  CHECK(ended.quadrature.intervals * ended.phases.size() < shown.quadrature.intervals * shown.phases.size());
  CHECK(shown.phases.size() == found.phases.size());
  CHECK(work.confirmed->objective_seen == Approx(work.confirmed->design.objective).epsilon(0.005));
  // What makes it an optimum is of the search, where it is one.
  const Assessment& assessment = optimised(found).assessment;
  CHECK(optimised(found).design.optimality.satisfied());
  REQUIRE(assessment.optimum);
  CHECK(assessment.optimum->resolution <= 1e-3 * assessment.optimum->value);
  for (const Sensitivity& sensitivity : assessment.sensitivities) CHECK(sensitivity.intervals == ended.quadrature.intervals);
  CHECK(optimise_summary(found).find("where the search did not go on") != std::string::npos);
  const std::string gap = std::string("gap = \"") + to_string(found.study.fidelity.gap) + "\"\n";
  const std::string intervals = "quadrature = { rule = \"graded\", intervals = " + std::to_string(shown.quadrature.intervals) + " }\n";
  const StudyResults finer = optimised_with(gap + intervals, "[cycle]\npositions = " + std::to_string(shown.phases.size()) + "\n");
  const double best = optimised(finer).search_work.objective_at_positions;
  CHECK(work.objective_at_positions <= 1.005 * best);
  CHECK(work.objective_at_positions >= (1.0 - 1e-3) * best);
}

TEST_CASE("An accuracy that no resolution keeps is a requirement not met", "[studies][accuracy][fidelity-choice]") {
  const StudyResults results = run_study(small_study(
      "accuracy = \"0.001 %\"\ngap = \"plane_of_action\"\nquadrature = { rule = \"graded\", intervals = 4 }", "[cycle]\npeaks = \"sampled\"\n"));
  REQUIRE(results.fidelity_choice);
  CHECK_FALSE(results.fidelity_choice->kept);
  REQUIRE(results.requirements.size() == 1);
  CHECK_THAT(results.requirements[0], Catch::Contains("an accuracy of 0.001 % is not kept"));
}

TEST_CASE("Without load there is nothing to choose by", "[studies][accuracy][fidelity-choice]") {
  CHECK_FALSE(run_study(parse_study("[pair]\nnormal_module = 4\n[pinion]\nteeth = 20\nface_width = 20\n[wheel]\nteeth = 40\nface_width = 20\n"
                                    "[fidelity]\naccuracy = \"1 %\"\n",
                                    "unloaded.toml"))
                  .fidelity_choice.has_value());
}
