#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iterator>

#include "studies/tasks/optimise/optimise_results.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/command_line.hpp"
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
  CHECK(optimised(turned).design.after.objective == Approx(optimised(drive).design.after.objective).epsilon(1e-4));  // tolerance of the search
  CHECK(turned.loaded.back().summary.peak_contact_stress ==
        Approx(turned.loaded[turned.loaded.size() - 2].summary.peak_contact_stress).epsilon(1e-7));
  // Both open at the same end: one lead slope cannot serve both.
  const StudyResults opposed = run(scenes(coast("12")));
  CHECK(optimised(opposed).design.after.objective > 1.02 * optimised(drive).design.after.objective);
  const auto lead_slope = [](const StudyResults& results) {
    return optimised(results).design.after.analysis.modification.pinion.lead_slope / units::um;
  };
  CHECK(std::abs(lead_slope(drive)) > 3.0);
  CHECK(std::abs(lead_slope(opposed)) < 0.2 * std::abs(lead_slope(drive)));
}

TEST_CASE("On the other flank a gear unit's forces turn round, but for those that are constant", "[studies][other-flank][unit]") {
  // The unit's meshes, a motor's torque and the pull of a belt, as a study of the other flank has them: torques the other way round.
  const std::string scenes = "[[scenes]]\nname = \"drive\"\n[[scenes]]\nname = \"coast\"\n";
  const auto load = [](const char* torque) {
    return std::string("[[unit.loads]]\nshaft = \"input\"\nposition = 5\nforce_x = 900\nforce_y = 400\nconstant = \"yes\"\n") +
           "[[unit.loads]]\nshaft = \"input\"\nposition = 155\ntorque = " + torque + "\n";
  };
  const std::string matrix = "[[500e3, 0, 2e4, 0, 1e6], [0, 400e3, 0, -1e6, 0], [2e4, 0, 3e5, 0, 0], [0, -1e6, 0, 2e8, 0], [1e6, 0, 0, 0, 2e8]]";
  std::string flat;
  std::ranges::copy_if(matrix, std::back_inserter(flat), [](char c) { return c != '[' && c != ']'; });
  const std::vector<Override> bearing{{"unit.shafts.0.bearings.0.stiffness_matrix", "[" + flat + "]"},
                                      {"unit.meshes.0.face_width_1", "30"},
                                      {"unit.meshes.0.face_width_2", "30"},
                                      {"unit.meshes.0.stiffness", "20"}};
  const auto with = [&](const char* torque, const char* path, const char* value) {
    std::vector<Override> overrides = bearing;
    overrides.push_back({path, value});
    return Json::parse(results_json(run(small::unit_pair() + small::unit() + load(torque) + scenes, overrides)));
  };
  const Json both = with("20", "scenes.1.working_flank", "right"), alone = with("-20", "pair.working_flank", "right");
  const Json &there = both.at("loaded").at(1), &here = alone.at("loaded").at(1), &own = both.at("loaded").at(0);
  const auto number = [](const Json& loaded, const char* at) { return loaded.at(Json::json_pointer(at)).get<double>(); };
  constexpr double round_off = 1e-8;
  for (const char* figure :
       {"/summary/shaft_misalignment_um", "/summary/te_peak_to_peak_um", "/summary/peak_load_N_per_mm", "/unit/mesh_misalignment_um",
        "/unit/meshes/1/misalignment_um", "/unit/meshes/1/face_load_factor", "/unit/bearings/0/force_N/0", "/unit/bearings/0/force_N/1",
        "/unit/bearings/2/force_N/0", "/unit/bearings/2/force_N/1", "/unit/bearings/2/moment_Nm/1", "/unit/shafts/1/largest_deflection_um"}) {
    CAPTURE(figure);
    CHECK(number(there, figure) == Approx(number(here, figure)).epsilon(round_off));
  }
  CHECK(number(there, "/unit/meshes/1/torque_1_Nm") == Approx(-number(own, "/unit/meshes/1/torque_1_Nm")).epsilon(round_off));
  CHECK(std::abs(number(there, "/unit/mesh_misalignment_um") - number(own, "/unit/mesh_misalignment_um")) > 1.0);
  // A force that would turn round with the torque is refused.
  const StudyProblem turns =
      refused(small::unit_pair() + small::unit() + load("20") + scenes, {{"scenes.1.working_flank", "right"}, {"unit.loads.0.constant", "no"}});
  CHECK(turns.key == "scenes.1.working_flank");
  CHECK_THAT(turns.allowed, Catch::Contains("unit.loads.0"));
}

TEST_CASE("Measured grids of both flanks are each of the flank that a scene loads", "[studies][other-flank][grid]") {
  // The pinion of the small study, r_a = 113.9 mm: a slope along the face, which another grid has the other way round and half as large.
  const auto grid = [](double slope) {
    std::string csv = "radius_mm;z_mm;deviation_um\n";
    for (const int radius : {98, 102, 106, 110, 113}) {
      for (const int z : {-58, -20, 20, 58}) csv += std::to_string(radius) + ";" + std::to_string(z) + ";" + std::to_string(slope * z) + "\n";
    }
    return csv;
  };
  const command_line::ScratchFolder folder;
  folder.file("drive.csv", grid(0.2));
  folder.file("coast.csv", grid(-0.1));
  const auto run_in_folder = [&](const std::string& text, const std::vector<Override>& overrides) {
    return run_study(read_study(folder.file("small.toml", text), overrides));
  };
  const std::string turned = small::analysis() + "working_flank = \"left\"\n";
  const std::vector<Override> drive{{"pinion.modification.grid", "drive.csv"}};
  const std::vector<Override> both_grids{drive.front(), {"pinion.modification.grid_of_opposite_flank", "coast.csv"}};
  const StudyResults both = run_in_folder(turned, both_grids);
  const StudyResults coast = run_in_folder(small::analysis(), {{"pair.working_flank", "left"}, {"pinion.modification.grid", "coast.csv"}});
  const StudyResults own = run_in_folder(small::analysis(), drive);
  constexpr double round_off = 1e-9;
  CHECK(both.loaded[0].summary.peak_contact_stress == Approx(own.loaded[0].summary.peak_contact_stress).epsilon(round_off));
  CHECK(both.loaded[1].summary.peak_contact_stress == Approx(coast.loaded[1].summary.peak_contact_stress).epsilon(round_off));
  CHECK(both.loaded[1].summary.te_mean == Approx(coast.loaded[1].summary.te_mean).epsilon(round_off));
  CHECK(std::abs(both.loaded[1].summary.peak_contact_stress / own.loaded[1].summary.peak_contact_stress - 1.0) > 0.05);  // they do differ
  // One grid alone is of one flank, and one that nothing loads is named.
  CHECK_THROWS_AS(run_in_folder(turned, drive), StudyErrors);
  const auto is_unused = [](const std::string& note) { return note.starts_with("pinion.modification.grid_of_opposite_flank is not used"); };
  CHECK(std::ranges::count_if(both.notes, is_unused) == 0);
  CHECK(std::ranges::count_if(run_in_folder(small::analysis(), both_grids).notes, is_unused) == 1);
}

TEST_CASE("What is known of one flank alone keeps scenes to that flank", "[studies][other-flank]") {
  const std::string text = small::analysis() + "working_flank = \"left\"\n";
  CHECK(refused(text, {{"scenes.1.working_flank", "\"front\""}}).key == "scenes.1.working_flank");
  CHECK_NOTHROW(parse_study(text, "small.toml"));
  CHECK_NOTHROW(parse_study(text, "small.toml", {{"wheel.body.rim_thickness", "40"}, {"wheel.body.web_thickness", "40"}}));
  // A grid is of the flank that it was measured on.
  try {
    parse_study(text, "small.toml", {{"wheel.error.grids", "[\"tooth.csv\"]"}});
    FAIL("nothing was refused");
  } catch (const StudyErrors& errors) {
    const auto on_grid = [](const StudyProblem& p) {
      return p.key == "scenes.1.working_flank" && p.allowed.find("wheel.error.grids") != std::string::npos;
    };
    CHECK(std::ranges::count_if(errors.problems(), on_grid) == 1);
  }
}

}  // namespace flankwright::studies
