#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "studies/analysis/run_study.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"

/// Scenes that load the flanks behind the pair's own, which the same tool grinds.
namespace flankwright::studies {
namespace {

StudyResults run(const std::string& text, const std::vector<Override>& overrides = {}) {
  return run_study(parse_study(text, "small.toml", overrides));
}

StudyProblem refused(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    parse_study(text, "small.toml", overrides);
  } catch (const StudyErrors& errors) {
    return errors.problems().front();
  }
  FAIL("nothing was refused");
  return {};
}

}  // namespace

TEST_CASE("A scene on the other flank is a study of that flank with what the tool leaves there", "[studies][other-flank]") {
  const std::string modified = small::analysis() + R"(working_flank = "left"
)";
  const std::vector<Override> shape{{"pinion.modification.lead_slope", "6"}, {"pinion.modification.twist", "4"}};
  const StudyResults both = run(modified, shape);
  // By hand: the helix angle is the same, so that the slope removes at the other end of the face.
  const StudyResults alone =
      run(small::analysis(), {{"pair.working_flank", "left"}, {"pinion.modification.lead_slope", "-6"}, {"pinion.modification.twist", "-4"}});
  const StudyResults own = run(small::analysis(), shape);
  REQUIRE(both.loaded.size() == 2);
  CHECK(both.loaded[0].summary.peak_contact_stress == own.loaded[0].summary.peak_contact_stress);
  CHECK_FALSE(both.loaded[0].condition.other_flanks);
  CHECK(both.loaded[1].summary.peak_contact_stress == Approx(alone.loaded[1].summary.peak_contact_stress).epsilon(1e-9));
  CHECK(both.loaded[1].summary.te_peak_to_peak == Approx(alone.loaded[1].summary.te_peak_to_peak).epsilon(1e-9));
  CHECK(std::abs(both.loaded[1].summary.peak_contact_stress / own.loaded[1].summary.peak_contact_stress - 1.0) > 0.01);
  REQUIRE(both.unloaded.size() == 2);
  CHECK(both.unloaded[1].mesh.peak_to_peak == Approx(alone.unloaded[1].mesh.peak_to_peak).epsilon(1e-9));
  const auto says_what_it_takes = [](const std::string& note) { return note.starts_with("scene \"bent\" loads the left flank"); };
  CHECK(std::ranges::count_if(both.notes, says_what_it_takes) == 1);
  CHECK(std::ranges::count_if(own.notes, says_what_it_takes) == 0);
  const Json results = Json::parse(results_json(both));
  CHECK_FALSE(results["loaded"][0].contains("working_flank"));
  CHECK(results["loaded"][1]["working_flank"] == "left");
}

TEST_CASE("Drive and coast are optimised together: what one misaligned flank gains by a lead slope the other pays for", "[studies][other-flank]") {
  const std::string head = small::optimisation();
  const std::string two = head.substr(0, head.find("[[scenes]]"));
  const std::string search = "\n" + head.substr(head.find("[optimise]"));
  const auto scenes = [&](const std::string& coast) {
    return two + "[[scenes]]\nname = \"drive\"\nmisalignment.mesh_misalignment = 12\n" + coast + search;
  };
  const auto coast = [](const char* misalignment) {
    return "[[scenes]]\nname = \"coast\"\nworking_flank = \"left\"\nmisalignment.mesh_misalignment = " + std::string(misalignment) + "\n";
  };
  const StudyResults drive = run(scenes(""));
  // The coast flank opens at the end where the drive flank is closed: turned over it is the same flank in the same condition.
  const StudyResults turned = run(scenes(coast("-12")));
  CHECK(turned.design->after.objective == Approx(drive.design->after.objective).epsilon(1e-4));  // tolerance of the search
  CHECK(turned.loaded.back().summary.peak_contact_stress ==
        Approx(turned.loaded[turned.loaded.size() - 2].summary.peak_contact_stress).epsilon(1e-7));
  // Both open at the same end: one lead slope cannot serve both.
  const StudyResults opposed = run(scenes(coast("12")));
  CHECK(opposed.design->after.objective > 1.02 * drive.design->after.objective);
  const auto lead_slope = [](const StudyResults& results) { return results.design->after.analysis.modification.pinion.lead_slope / units::um; };
  CHECK(std::abs(lead_slope(drive)) > 3.0);
  CHECK(std::abs(lead_slope(opposed)) < 0.2 * std::abs(lead_slope(drive)));
}

TEST_CASE("What is known of one flank alone keeps scenes to that flank", "[studies][other-flank]") {
  const std::string text = small::analysis() + "working_flank = \"left\"\n";
  const StudyProblem webbed = refused(text, {{"pinion.body.rim_thickness", "30"}, {"pinion.body.web_thickness", "30"}});
  CHECK(webbed.key == "scenes.1.working_flank");
  CHECK(webbed.value == "\"left\"");
  CHECK_THAT(webbed.allowed, Catch::Contains("pinion.body with a web"));
  CHECK_THAT(refused(text, {{"wheel.shaft.sections", "[{ length = 300, outer_diameter = 100 }]"},
                            {"wheel.shaft.bearings", "[{ position = 20 }, { position = 280 }]"},
                            {"wheel.shaft.gear_position", "150"}})
                 .allowed,
             Catch::Contains("wheel.shaft"));
  CHECK(refused(text, {{"scenes.1.working_flank", "\"front\""}}).key == "scenes.1.working_flank");
  CHECK_NOTHROW(parse_study(text, "small.toml"));
}

}  // namespace flankwright::studies
