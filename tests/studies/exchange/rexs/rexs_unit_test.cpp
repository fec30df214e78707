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
}
