#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "studies/analysis/run_study.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/results/tables.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"

namespace flankwright::studies {
namespace {

const std::string unit_pair = small::unit_pair(), unit_text = small::unit();

Study read_unit_study(const std::string& text, const std::vector<Override>& overrides = {}) { return parse_study(text, "unit.toml", overrides); }

Json run_unit(const std::string& text, const std::vector<Override>& overrides = {}) {
  return Json::parse(results_json(run_study(read_unit_study(text, overrides))));
}

/// "file:line: key = value: allowed"
std::string unit_refusal(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    read_unit_study(text, overrides);
  } catch (const StudyErrors& errors) {
    const StudyProblem& first = errors.problems().front();
    return first.file + ":" + std::to_string(first.line) + ": " + first.key + " = " + first.value + ": " + first.allowed;
  }
  return {};
}

}  // namespace

TEST_CASE("A study's unit misaligns the pair, and its results say by what", "[studies][shaft][unit]") {
  const Json with = run_unit(unit_pair + unit_text), loaded = with.at("loaded").at(0), unit = loaded.at("unit");
  CHECK(unit.at("bearings_are") == "linear");
  CHECK(unit.at("meshes").at(1).at("torque_2_Nm").get<double>() == Approx(300).epsilon(1e-9));
  CHECK(unit.at("meshes").at(1).at("torque_1_Nm").get<double>() == Approx(120).epsilon(1e-9));
  CHECK(unit.at("meshes").at(0).at("torque_1_Nm").get<double>() == Approx(-300).epsilon(1e-9));
  CHECK(unit.at("meshes").at(1).at("driver") == "input");
  CHECK(unit.at("bearings").size() == 4);
  for (const Json& shaft : unit.at("shafts")) CHECK(shaft.at("equilibrium_residual").get<double>() < 1e-9);
  CHECK(with.at("used").at("unit").at("meshes").at(0).at("shaft_2") == "pinion");
  // What the loads to be found do to the shaft is near what their mean does: model, their resultant is not quite at mid face.
  const double mean = unit.at("mesh_misalignment_um"), found = loaded.at("summary").at("shaft_misalignment_um");
  CHECK(found == Approx(mean).epsilon(0.2));
  CHECK(std::abs(unit.at("misalignment_by_other_forces_um").get<double>()) > 1.0);
  CHECK_FALSE(run_unit(unit_pair, {{"pinion.shaft.torque_position", "0"}}).at("loaded").at(0).contains("unit"));
  // Without the effect nothing of the unit is left.
  CHECK_FALSE(run_unit(unit_pair + unit_text, {{"fidelity.effects", "[\"bending\", \"hertzian_contact\"]"}}).at("loaded").at(0).contains("unit"));
}

TEST_CASE("The terminal has the misalignment of the load cases that govern", "[studies][shaft][unit][output]") {
  // The largest torque governs all stresses; of the few positions the peak to peak may be governed by another, so that only its line is looked for.
  const StudyResults results = run_study(read_unit_study(unit_pair + unit_text, {{"load.torque", "[30, 300]"}}));
  const Json loaded = Json::parse(results_json(results)).at("loaded").at(1);
  const double misalignment = loaded.at("summary").at("shaft_misalignment_um"), others = loaded.at("unit").at("misalignment_by_other_forces_um");
  constexpr double face_width = 40;  // mm
  const auto row = [](const StudyResults& of, double torque) -> std::vector<double> {
    std::istringstream lines(analysis_table(of));
    bool is_in_table = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("misalignment")) is_in_table = true;
      if (!is_in_table || !line.starts_with("nominal")) continue;
      std::istringstream cells(line.substr(std::string("nominal").size()));
      std::vector<double> numbers;
      for (double number = 0.0; cells >> number;) numbers.push_back(number);
      if (numbers.front() == torque) return numbers;
    }
    return {};
  };
  const std::vector<double> line = row(results, 300);
  REQUIRE(line.size() == 4);
  constexpr double printed_um = 6e-4, printed_urad = 0.06;  // half of the last digit, and its round-off
  CHECK(std::abs(line[1] - misalignment) < printed_um);
  CHECK(std::abs(line[2] - 1e3 * misalignment / face_width) < printed_urad);
  CHECK(std::abs(line[3] - others) < printed_um);
  // Shafts without a unit have no other forces, rigid shafts no table.
  CHECK(row(run_study(read_unit_study(unit_pair, {{"pinion.shaft.torque_position", "0"}})), 300).size() == 3);
  CHECK(row(run_study(read_unit_study(unit_pair + unit_text, {{"fidelity.effects", "[\"bending\", \"hertzian_contact\"]"}})), 300).empty());
}

TEST_CASE("Other meshes act as the misalignment that they make", "[studies][shaft][unit][physics]") {
  // The same shaft, its torque through a coupling at the other gear: without that gear's forces. What these open is added as mesh_misalignment.
  const Json with = run_unit(unit_pair + unit_text), without = run_unit(unit_pair, {{"pinion.shaft.torque_position", "50"}});
  const double opened = with.at("/loaded/0/unit/misalignment_by_other_forces_um"_json_pointer);
  const Json instead = run_unit(unit_pair, {{"pinion.shaft.torque_position", "50"}, {"misalignment.mesh_misalignment", std::to_string(opened)}});
  const auto peak = [](const Json& results) { return results.at("/loaded/0/summary/peak_load_N_per_mm"_json_pointer).get<double>(); };
  CAPTURE(opened, peak(with), peak(without), peak(instead));
  CHECK(std::abs(peak(with) - peak(without)) > 0.015 * peak(without));
  CHECK(peak(with) == Approx(peak(instead)).epsilon(0.003));  // model: the shaft bends over the face as well
}

TEST_CASE("The derivative by torque knows the other meshes", "[studies][gradient][shaft][unit]") {
  const auto at = [&](double torque, const std::vector<Override>& more = {}) {
    std::vector<Override> overrides{{"load.torque", std::to_string(torque)}};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return run_unit(unit_pair + unit_text, overrides).at("loaded").at(0);
  };
  const Json here = at(300, {{"analyse.gradients", R"(["load.torque"])"}}), up = at(300.5), down = at(299.5);
  constexpr double difference_error = 1e-4;  // step^2 times curvature
  for (const char* place : {"/summary/te_mean_um", "/cycle/1/te_um", "/cycle/2/te_um", "/shafts/1/mesh_misalignment_um",
                            "/summary/shaft_misalignment_um", "/summary/iso6336/F_beta_y_um", "/summary/iso6336/K_Hbeta"}) {
    CAPTURE(place);
    const Json::json_pointer where(place);
    const double difference = up.at(where).get<double>() - down.at(where).get<double>();
    CHECK(here.at("gradients").at(where).at(0).get<double>() == Approx(difference).epsilon(difference_error));
  }
}

TEST_CASE("Derivatives by torque are refused where bearings yield in another way at each torque", "[studies][gradient][shaft][unit]") {
  const auto read = [](const std::vector<Override>& overrides) { return parse_study(unit_pair + unit_text, "unit.toml", overrides); };
  const Override by_torque{"analyse.gradients", R"(["load.torque"])"}, clearance{"pinion.shaft.bearings.1.radial_clearance", "40"};
  CHECK_NOTHROW(read({by_torque}));
  CHECK_NOTHROW(read({{"analyse.gradients", R"(["misalignment.mesh_misalignment"])"}, clearance}));
  CHECK_THROWS_WITH(read({by_torque, clearance}), Catch::Contains("analyse.gradients") && Catch::Contains("none by load.torque"));
}

TEST_CASE("Clearances make a mesh for each torque, and the results say so", "[studies][shaft][unit]") {
  const std::vector<Override> loose{{"pinion.shaft.bearings.1.radial_clearance", "40"}};
  const Json linear = run_unit(unit_pair + unit_text, {{"load.torque", "[150, 300]"}});
  std::vector<Override> both = loose;
  both.push_back({"load.torque", "[150, 300]"});
  const Json with = run_unit(unit_pair + unit_text, both);
  const auto misalignment = [](const Json& results, int load) {
    return results.at("loaded").at(load).at("unit").at("mesh_misalignment_um").get<double>();
  };
  CHECK(misalignment(linear, 1) == Approx(2 * misalignment(linear, 0)).epsilon(1e-9));
  // The shift across the clearance is the same at both torques.
  CHECK(misalignment(with, 0) - misalignment(linear, 0) == Approx(misalignment(with, 1) - misalignment(linear, 1)).epsilon(1e-6));
  const Json& unit = with.at("loaded").at(1).at("unit");
  CHECK(unit.at("bearings_are") == "linearised at their equilibrium under mean forces");
  CHECK(unit.at("clearances").at("converged") == true);
  CHECK(std::hypot(unit.at("/bearings/1/shift_um/0"_json_pointer).get<double>(), unit.at("/bearings/1/shift_um/1"_json_pointer).get<double>()) ==
        Approx(20.0).epsilon(1e-9));
  // By itself the second torque gives the same.
  std::vector<Override> alone = loose;
  alone.push_back({"load.torque", "300"});
  CHECK(run_unit(unit_pair + unit_text, alone).at("/loaded/0/summary/te_mean_um"_json_pointer) ==
        with.at("/loaded/1/summary/te_mean_um"_json_pointer));
}

TEST_CASE("Units that cannot be are refused with their position in the file", "[studies][shaft][unit]") {
  using Catch::Contains;
  CHECK(unit_refusal(unit_pair + unit_text).empty());
  CHECK_THAT(unit_refusal(unit_pair + unit_text, {{"unit.meshes.0.shaft_1", "outer"}}),
             Contains("unit.meshes.0.shaft_1 = outer: allowed is one of pinion, input"));
  CHECK_THAT(unit_refusal(unit_pair + unit_text + "position_3 = 5\n"), Contains("unit.toml:39: unit.meshes.0.position_3") && Contains("unknown key"));
  CHECK_THAT(unit_refusal(unit_pair + unit_text, {{"unit.meshes.0.position_2", "181"}}),
             Contains("unit.meshes.0.position_2 = 181") && Contains("0 .. 180 mm"));
  CHECK_THAT(unit_refusal(unit_pair + unit_text, {{"unit.shafts.0.bearings.1.position", "20"}}), Contains("a position of its own"));
  // Names are unique; of shafts they are by what meshes refer to them.
  CHECK_THAT(unit_refusal(unit_pair + unit_text, {{"unit.shafts.0.bearings.0.name", "left"}, {"unit.shafts.0.bearings.1.name", "left"}}),
             Contains("unit.shafts.0.bearings.1.name = left: allowed is a name of its own: unit.shafts.0.bearings.0.name has this one"));
  std::string twice = unit_pair + unit_text;
  twice.replace(twice.find("{ position = 10,"), 16, "{ name = \"left\", position = 10,");
  twice.replace(twice.find("{ position = 20 }"), 17, "{ name = \"left\", position = 20 }");
  CHECK_THAT(unit_refusal(twice),
             Contains("unit.toml:26: unit.shafts.0.bearings.0.name = left: allowed is a name of its own: pinion.shaft.bearings.0.name"));
  CHECK_THAT(unit_refusal(unit_pair + unit_text + unit_text.substr(unit_text.find("[[unit.meshes]]"))),
             Contains("unit.toml:40: unit.meshes.1.name = first: allowed is a name of its own: unit.meshes.0.name has this one"));
  CHECK_THAT(unit_refusal(unit_pair + unit_text.substr(0, unit_text.find("[[unit.meshes]]")) + unit_text),
             Contains("unit.shafts.1.name = input: allowed is a name of its own"));
  CHECK_THAT(unit_refusal(unit_pair + "[[unit.shafts]]\nname = \"input\"\nsections = [{ length = 100 }]\n"),
             Contains("unit.shafts.0.sections.0.outer_diameter") && Contains("required"));
  const std::string two = "{ position = 20 }, { position = 150 }";
  std::string one_bearing = unit_pair + unit_text;
  one_bearing.replace(one_bearing.find(two), two.size(), "{ position = 20 }");
  CHECK_THAT(unit_refusal(one_bearing), Contains("unit.toml:26: unit.shafts.0.bearings") && Contains("held against tilting"));
  CHECK_THAT(unit_refusal(unit_pair), Contains("pinion.shaft.torque_position"));
  // A name of the pair's is refused where it stands, not where it would take the place of the pair's shaft.
  std::string named = unit_pair + unit_text;
  named.replace(named.find("\"input\""), 7, "\"pinion\"");
  CHECK_THAT(unit_refusal(named), Contains("unit.toml:24: unit.shafts.0.name = pinion"));
  CHECK_THAT(unit_refusal(unit_pair + unit_text, {{"unit.meshes.0.centre_distance", "200"}}),
             Contains("unit.meshes.0.centre_distance = 200") && Contains("do not reach each other"));
  CHECK_THAT(unit_refusal(unit_pair + unit_text, {{"unit.meshes.0.position_2", "125"}, {"unit.meshes.0.face_width_2", "20"}}),
             Contains("unit.meshes.0.position_2 = 125") && Contains("beside that of pinion (21 teeth"));
  CHECK(unit_refusal(unit_pair + unit_text, {{"unit.meshes.0.position_2", "100"}, {"unit.meshes.0.face_width_2", "20"}}).empty());  // side by side
}

}  // namespace flankwright::studies
