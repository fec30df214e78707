#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "core/gear/gear_pair.hpp"
#include "studies/exchange/rexs/rexs_import.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/study_file/study_shafts.hpp"
#include "tests/studies/command_line.hpp"
#include "tests/studies/exchange/rexs/gear_train.hpp"
#include "tests/studies/study_texts.hpp"

using namespace flankwright;
using namespace flankwright::studies;
using Catch::Contains;

namespace {

std::string unit_file() {
  std::ifstream file(std::string(FLANKWRIGHT_SOURCE_DIR) + "/tests/studies/exchange/rexs/data/coaxial_unit.rexs");
  REQUIRE(file);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Two input pinions of 25 teeth, 120 deg apart, on a wheel of 101, each with a load of this torque.
/// @param in_stages  whether the torques are in the data of the stages, too
std::string ship_file(double newton_metre, bool in_stages) {
  using namespace gear_trains;
  const double distance = reference_distance(25, 101, 4, 10);
  GearTrain train;
  const int wheel_shaft = train.shaft(0, 0);
  const int wheel = train.gear(wheel_shaft, 150, 101, 4, -10.0);
  train.load(wheel_shaft, 300, {word("transmits_torque", "true")});
  for (const double side : {-1.0, 1.0}) {
    const int shaft = train.shaft(side * distance * std::cos(30 * units::deg), distance * std::sin(30 * units::deg));
    const int pinion = train.gear(shaft, 150, 25, 4, 10.0);
    train.load(shaft, 0, {number("torque_around_u_axis", newton_metre, "N m")});
    const int stage = train.stage(pinion, wheel);
    if (in_stages) train.stage_data(stage, pinion, {number("torque", std::abs(newton_metre), "N m")});
  }
  return train.text();
}

rexs::UnitImport import_of(const std::string& text) { return rexs::import_unit(text, "unit.rexs", {.grid_stem = "unit"}); }

}  // namespace

TEST_CASE("A unit of two stages gives a study for each, on the common unit", "[studies][rexs][import][unit]") {
  const rexs::UnitImport imported = import_of(unit_file());
  REQUIRE(imported.stages.size() == 2);
  CHECK(imported.left_out.empty());
  const Study first = parse_study(imported.stages[0].study.text, "first"), second = parse_study(imported.stages[1].study.text, "second");
  for (const Study& study : {first, second}) {
    REQUIRE(study.shaft.pinion);
    REQUIRE(study.shaft.wheel);
    CHECK(study.unit.shafts.size() == 1);
    CHECK(study.unit.meshes.size() == 1);
    CHECK(study.unit.loads.size() == 1);
    CHECK(study.unit.joints.size() == 1);
    CHECK(study.scenes.size() == 2);
  }
  // The input turns +u; the intermediate shaft the other way, so its pinion works on its left flank.
  CHECK(first.pair.working_flank == WorkingFlank::Right);
  CHECK(second.pair.working_flank == WorkingFlank::Left);
  CHECK(second.pair.pinion_hand == Hand::Left);
  CHECK(second.shaft.pinion->gear_position == 165.0);
  CHECK(std::isnan(second.shaft.pinion->torque_position));
  CHECK(second.shaft.wheel->torque_position == 190.0);
  CHECK(second.unit.shafts[0].torque_position == 0.0);
  CHECK(second.torques.front() == Approx(400e3 * 48 / 26).epsilon(1e-12));
  CHECK(second.unit.reference_torque == Approx(second.torques.front()).epsilon(1e-12));
  // Input and output lie on one axis: seen from the input the intermediate shaft lies where the second stage has its pinion.
  CHECK(std::cos(second.unit.meshes[0].angle) == Approx(-1.0).epsilon(1e-9));
  CHECK(second.unit.joints[0].bearing.position == 160.0);
  CHECK(second.unit.joints[0].outer_position == 20.0);
  CHECK(second.unit.joints[0].outer_shaft == "wheel");
  // x points from the intermediate shaft up to the output, W's z: v = w x u is then against y = z x x.
  CHECK(std::abs(second.unit.loads[0].force.y()) == Approx(600.0).epsilon(1e-12));
}

TEST_CASE("An imported unit is in balance, the same unit seen from either stage", "[studies][rexs][import][unit]") {
  const rexs::UnitImport imported = import_of(unit_file());
  REQUIRE(imported.stages.size() == 2);
  std::vector<UnitState> states;
  for (const rexs::ImportedOfUnit& stage : imported.stages) {
    const Study study = parse_study(stage.study.text, "stage", {{"fidelity.compliance", "thin_slice"}});
    states.push_back(make_shafts(study, make_gear_pair(study.pair))->state(study.torques.front()));
    for (const ShaftState& shaft : states.back().shafts) CHECK(shaft.residual < 1e-9);
    CHECK(states.back().linear);
  }
  // The meshes change places, their torques do not. Seen from the second stage, x and y point the other way.
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(std::abs(states[0].meshes[i].torque[0]) == Approx(std::abs(states[1].meshes[1 - i].torque[0])).epsilon(1e-9));
    CHECK(states[0].meshes[i].normal_force == Approx(states[1].meshes[1 - i].normal_force).epsilon(1e-9));
    CHECK(states[0].meshes[i].first_flank == states[1].meshes[1 - i].first_flank);
  }
  // Every bearing of one is a bearing of the other with the same radial force, to what pair and mesh say differently of shafts below gears (root
  // circle of the gear, of the basic rack): model.
  for (const BearingState& bearing : states[0].bearings) {
    double nearest = INFINITY;
    for (const BearingState& other : states[1].bearings) {
      nearest = std::min(nearest, std::abs(other.force.head<2>().norm() - bearing.force.head<2>().norm()) / bearing.force.head<2>().norm());
    }
    CAPTURE(bearing.name);
    CHECK(nearest < 0.02);
  }
}

TEST_CASE("What an import leaves out is listed beside the study, and summed up in it", "[studies][rexs][import][unit][cli]") {
  using command_line::ScratchFolder;
  const ScratchFolder folder;
  folder.file("unit.rexs", unit_file());
  const command_line::Ending ending = command_line::run(folder, {"import", "unit.rexs", "--out", "out/gearbox.toml"});
  CAPTURE(ending.err);
  REQUIRE(ending.exit_code == 0);
  CHECK(folder.names("out") ==
        std::vector<std::string>{"gearbox-stage-1-not-taken.txt", "gearbox-stage-1.toml", "gearbox-stage-2-not-taken.txt", "gearbox-stage-2.toml"});
  for (const char* study : {"out/gearbox-stage-1.toml", "out/gearbox-stage-2.toml"}) {
    CHECK(command_line::run(folder, {"check", study}).exit_code == 0);
    const std::string text = command_line::text_of(folder.path() / study);
    std::size_t comments = 0;
    for (std::size_t at = text.find("\n# "); at != std::string::npos; at = text.find("\n# ", at + 1)) ++comments;
    CHECK(comments < 15);
  }
}

TEST_CASE("A unit that a study cannot describe is left out with its reason, and its stage is imported", "[studies][rexs][import][unit]") {
  // A shaft across the others.
  const std::string text = study_texts::replaced(
      unit_file(), "<component id=\"4\" type=\"shaft\">\n      <attribute id=\"u_axis_vector\" unit=\"mm\"><array><c>1</c><c>0</c>",
      "<component id=\"4\" type=\"shaft\">\n      <attribute id=\"u_axis_vector\" unit=\"mm\"><array><c>0</c><c>1</c>");
  const rexs::UnitImport imported = import_of(text);
  REQUIRE(imported.stages.size() == 2);
  for (const rexs::ImportedOfUnit& stage : imported.stages) {
    CHECK(parse_study(stage.study.text, "stage").unit.empty());
    CHECK_THAT(stage.study.text, Contains("the unit around the stage: not taken, shaft 4 is not parallel"));
  }
  // Loads counted from no direction.
  const std::string axis = "<attribute id=\"w_axis_vector\" unit=\"mm\"><array><c>0</c><c>0</c>";
  const rexs::UnitImport undirected = import_of(study_texts::replaced(unit_file(), axis + "<c>1</c>", axis + "<c>0</c>"));
  REQUIRE(undirected.stages.size() == 2);
  CHECK_THAT(undirected.stages[0].study.text, Contains("has a w_axis_vector that is no direction across its axis"));
}

TEST_CASE("Two pinions on one wheel are a unit, and both load the wheel", "[studies][rexs][import][unit]") {
  const double newton_metre = GENERATE(800.0, -800.0);
  const std::string text = ship_file(newton_metre, GENERATE(false, true));
  for (const int stage : {1, 2}) {
    const rexs::ImportedStudy imported = rexs::import_stage(text, "ship.rexs", {.stage = stage, .grid_stem = "ship"});
    CHECK(imported.warnings.empty());
    const Study study = parse_study(imported.text, "ship.toml", {{"fidelity.compliance", "thin_slice"}});
    CHECK(study.pair.working_flank == (newton_metre > 0.0 ? WorkingFlank::Right : WorkingFlank::Left));
    REQUIRE(study.unit.meshes.size() == 1);
    CHECK(study.unit.meshes[0].torque == Approx(1e3 * newton_metre).epsilon(1e-12));
    const GearPair pair = make_gear_pair(study.pair);
    const UnitState state = make_shafts(study, pair)->state(study.torques.front());
    CHECK(state.meshes[1].normal_force == Approx(state.meshes[0].normal_force).epsilon(1e-9));
    // Independent route: both meshes push the wheel with T / r_b across its axis, in directions 120 deg apart, so that their sum is as large as each.
    Eigen::Vector2d on_wheel = Eigen::Vector2d::Zero();
    for (const BearingState& bearing : state.bearings) {
      if (bearing.shaft == "wheel") on_wheel += bearing.force.head<2>();
    }
    CHECK(on_wheel.norm() == Approx(1e3 * std::abs(newton_metre) / pair.pinion.base_radius).epsilon(1e-6));
    for (const ShaftState& shaft : state.shafts) {
      if (shaft.name == "wheel") CHECK(std::abs(shaft.coupling_torque) == Approx(2e3 * std::abs(newton_metre) * 101 / 25).epsilon(1e-9));
    }
  }
}

TEST_CASE("A gear with several meshes is not taken for one with a single mesh", "[studies][rexs][import][unit]") {
  // How much torque the second pinion's load transmits is not in the file.
  std::string text = ship_file(800.0, false);
  const std::string known = "<attribute id=\"torque_around_u_axis\" unit=\"N m\">800</attribute>";
  text.replace(text.rfind(known), known.size(), "<attribute id=\"transmits_torque\" unit=\"none\">true</attribute>");
  const rexs::ImportedStudy imported = rexs::import_stage(text, "ship.rexs", {.stage = 1, .grid_stem = "ship"});
  const Study study = parse_study(imported.text, "ship.toml");
  CHECK(study.unit.empty());
  CHECK_FALSE(study.shaft.wheel);
  CHECK_THAT(imported.text, Contains("the unit around the stage: not taken") && Contains("its gear has 2 meshes"));
}
