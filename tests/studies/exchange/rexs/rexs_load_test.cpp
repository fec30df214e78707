#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/gear/gear_pair.hpp"
#include "studies/exchange/rexs/rexs_import.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/study_file/study_shafts.hpp"
#include "tests/studies/exchange/rexs/gear_train.hpp"

using namespace flankwright;
using namespace flankwright::studies;
using namespace flankwright::studies::gear_trains;
using Catch::Contains;

namespace {

rexs::ImportedStudy stage_of_train(const GearTrain& train, int stage) {
  return rexs::import_stage(train.text(), "train.rexs", {.stage = stage, .grid_stem = "train"});
}
Study study_of_stage(const GearTrain& train, int stage) { return parse_study(stage_of_train(train, stage).text, "stage.toml"); }

UnitState state_of(const Study& study) { return make_shafts(study, make_gear_pair(study.pair))->state(study.torques.front()); }
UnitState state_of_stage(const GearTrain& train, int stage) {
  return state_of(parse_study(stage_of_train(train, stage).text, "stage.toml", {{"fidelity.compliance", "thin_slice"}}));
}

rexs::Attribute torque(double newton_metre) { return number("torque_around_u_axis", newton_metre, "N m"); }

/// A pair of 20 and 40 teeth on shafts that nothing describes, with a load on the pinion's.
struct PairFile {
  GearTrain train;
  int load, stage, data;

  PairFile() {
    const int input = train.bare_shaft(0, 0), output = train.bare_shaft(120, 0);
    load = train.load(input, 0, {torque(400)});
    const int pinion = train.gear(input, 100, 20, 4, 0.0), wheel = train.gear(output, 100, 40, 4, 0.0);
    stage = train.stage(pinion, wheel);
    data = train.stage_data(stage, pinion, {});
  }
};

/// Two stages on three shafts, 19 : 71 and 23 : 67, that a load drives.
struct TwoStages {
  GearTrain train;
  int input, load, output_load;

  explicit TwoStages(const Attributes& attributes) {
    const double first = reference_distance(19, 71, 3, 18), second = reference_distance(23, 67, 5, 14);
    input = train.shaft(0, 0);
    const int middle = train.shaft(first, 0), output = train.shaft(first, second);
    load = train.load(input, 0, attributes);
    output_load = train.load(output, 300, {word("transmits_torque", "true")});
    train.stage(train.gear(input, 100, 19, 3, 18.0), train.gear(middle, 100, 71, 3, -18.0));
    train.stage(train.gear(middle, 200, 23, 5, -14.0), train.gear(output, 200, 67, 5, 14.0));
  }
};

/// 21, 37 and 64 teeth; the second gear is an idler.
GearTrain idler_train(bool with_stage_data) {
  const double first = reference_distance(21, 37, 4, 12), second = reference_distance(37, 64, 4, 12);
  GearTrain train;
  const int input = train.shaft(0, 0), middle = train.shaft(first, 0), output = train.shaft(first, second);
  train.load(input, 0, {torque(300)});
  train.load(output, 300, {word("transmits_torque", "true")});
  const int driver = train.gear(input, 150, 21, 4, 12.0), idler = train.gear(middle, 150, 37, 4, -12.0),
            driven = train.gear(output, 150, 64, 4, 12.0);
  const int stage_1 = train.stage(driver, idler), stage_2 = train.stage(idler, driven);
  if (with_stage_data) {
    // As programs write it: all torques are positive.
    train.stage_data(stage_1, driver, {number("torque", 300, "N m")});
    train.stage_data(stage_2, idler, {number("torque", 300.0 * 37 / 21, "N m")});
  }
  return train;
}

constexpr double round_off_of_torques = 1e-12;

}  // namespace

TEST_CASE("A load case of reversed torque is a scene on the other flank", "[studies][rexs][import]") {
  PairFile file;
  const auto check = [&](WorkingFlank own) {
    const Study study = study_of_stage(file.train, 1);
    CHECK(study.pair.working_flank == own);
    REQUIRE(study.scenes.size() == 3);
    CHECK_FALSE(loads_other_flanks(study, study.scenes[0]));
    CHECK(loads_other_flanks(study, study.scenes[1]));
    CHECK_FALSE(loads_other_flanks(study, study.scenes[2]));
    CHECK(study.scenes[0].torques.front() == Approx(400e3).epsilon(round_off_of_torques));
    CHECK(study.scenes[1].torques.front() == Approx(150e3).epsilon(round_off_of_torques));
    CHECK(study.scenes[2].torques.front() == Approx(600e3).epsilon(round_off_of_torques));
  };
  const auto flank = [](const std::string& side) { return word("loaded_tooth_flank", side); };
  const auto in_data = [](double newton_metre) { return number("torque", newton_metre, "N m"); };
  SECTION("by the signs of an external load") {
    for (const double newton_metre : {400.0, -150.0, 600.0}) file.train.load_case({{file.load, {torque(newton_metre)}}});
    check(WorkingFlank::Right);
    // What the model says of the flank is meant for the first case.
    file.train.set(file.data, flank("left"));
    check(WorkingFlank::Left);
  }
  SECTION("by the power of an external load") {
    // At 1000 / min, so that 1 N m is 1000 pi / 30 W.
    for (const double newton_metre : {400.0, -150.0, 600.0}) {
      file.train.load_case({{file.load, {number("power", newton_metre * units::pi / 30.0, "kW")}}});
    }
    file.train.set(2, number("rotational_speed", 1000, "1 / min"));
    check(WorkingFlank::Right);
  }
  SECTION("by the signs of the stage's data") {
    for (const double newton_metre : {400.0, -150.0, 600.0}) file.train.load_case({{file.data, {in_data(newton_metre)}}});
    check(WorkingFlank::Right);
  }
  SECTION("by the loaded flank of the load case") {
    file.train.load_case({{file.data, {in_data(400), flank("left")}}});
    file.train.load_case({{file.data, {in_data(150), flank("right")}}});
    file.train.load_case({{file.data, {in_data(600)}}});
    check(WorkingFlank::Left);
  }
}

TEST_CASE("A reversed case of a unit is a scene on the other flank, unless forces would turn round with it", "[studies][rexs][import][unit]") {
  const auto with_forces = [](std::initializer_list<double> newtons) {
    TwoStages file({word("transmits_torque", "true")});
    auto force = newtons.begin();
    for (const double newton_metre : {400.0, -150.0, 600.0})
      file.train.load_case({{file.load, {torque(newton_metre), number("force_v_direction", *force++, "N")}}});
    return file;
  };
  for (const int stage : {1, 2}) {
    // None, and a weight that is the same in all cases.
    for (const double weight : {0.0, 500.0}) {
      const rexs::ImportedStudy imported = stage_of_train(with_forces({weight, weight, weight}).train, stage);
      CHECK(imported.warnings.empty());
      const Study study = parse_study(imported.text, "stage.toml");
      REQUIRE(study.scenes.size() == 3);
      CHECK(study.scenes[1].working_flank == opposite(study.pair.working_flank));
      REQUIRE(study.unit.loads.size() == (weight > 0.0 ? 1u : 0u));
      if (weight > 0.0) CHECK(study.unit.loads[0].constant);
    }
    // In proportion to the torque, which would turn them round.
    const rexs::ImportedStudy imported = stage_of_train(with_forces({400, 150, 600}).train, stage);
    const Study study = parse_study(imported.text, "stage.toml");
    REQUIRE(study.scenes.size() == 2);
    CHECK(study.scenes[1].name == "load case 3");
    REQUIRE(study.unit.loads.size() == 1);
    CHECK_FALSE(study.unit.loads[0].constant);
    REQUIRE(imported.warnings.size() == 1);
    CHECK_THAT(imported.warnings.front(), Contains("load case 2: left out") && Contains("a gear unit"));
  }
}

TEST_CASE("Loads that contradict each other are warned of, losses are not", "[studies][rexs][import][errors]") {
  // 19 : 71 and 23 : 67 turn 100 N m into 1088.6 N m, all about x.
  const double output_torque = 100.0 * 71 / 19 * 67 / 23;
  const auto warnings = [&](double stated) {
    TwoStages file({torque(100)});
    file.train.set(file.output_load, torque(-stated));
    const rexs::ImportedStudy imported = stage_of_train(file.train, 1);
    CHECK(parse_study(imported.text, "stage.toml").torques.front() == Approx(100e3).epsilon(round_off_of_torques));
    return imported.warnings;
  };
  CHECK(warnings(output_torque).empty());
  CHECK(warnings(0.97 * output_torque).empty());  // two meshes lose 3 %
  for (const double wrong : {0.5, 1.2, -1.0}) {
    CAPTURE(wrong);
    const std::vector<std::string> said = warnings(wrong * output_torque);
    REQUIRE_FALSE(said.empty());
    CHECK_THAT(said.front(), Contains("external loads contradict each other") && Contains("N m"));
  }
}

TEST_CASE("A torque in the stage's data is held against the external loads", "[studies][rexs][import][errors]") {
  PairFile file;
  file.train.set(file.data, number("torque", 300, "N m"));
  const rexs::ImportedStudy imported = stage_of_train(file.train, 1);
  CHECK(parse_study(imported.text, "stage.toml").torques.front() == Approx(300e3).epsilon(round_off_of_torques));
  REQUIRE(imported.warnings.size() == 1);
  CHECK_THAT(imported.warnings.front(), Contains("300 N m") && Contains("400 N m") && Contains("the first is taken"));
  file.train.set(file.data, number("torque", 392, "N m"));  // 2 % less, as losses are
  CHECK(stage_of_train(file.train, 1).warnings.empty());
}

TEST_CASE("What a load case says of a torque comes before what the model says", "[studies][rexs][import]") {
  PairFile file;
  file.train.set(file.data, number("torque", 400, "N m"));  // as of a calculation of the nominal load
  const auto torques = [&] {
    const rexs::ImportedStudy imported = stage_of_train(file.train, 1);
    CHECK(imported.warnings.empty());
    const Study study = parse_study(imported.text, "stage.toml");
    std::vector<double> newton_metres;
    for (const Scene& scene : study.scenes) newton_metres.push_back(std::round(scene.torques.front() / units::newton_metre));
    return newton_metres;
  };
  for (const double newton_metre : {250.0, 500.0}) file.train.load_case({{file.load, {torque(newton_metre)}}});
  CHECK(torques() == std::vector{250.0, 500.0});
  file.train.load_case({{file.data, {number("torque", 350, "N m")}}});
  CHECK(torques() == std::vector{250.0, 500.0, 350.0});
}

TEST_CASE("A load case without torque is left out and named", "[studies][rexs][import]") {
  PairFile file;
  for (const double newton_metre : {0.0, 400.0, 600.0}) file.train.load_case({{file.load, {torque(newton_metre)}}});
  const rexs::ImportedStudy imported = stage_of_train(file.train, 1);
  CHECK(parse_study(imported.text, "stage.toml").scenes.size() == 2);
  REQUIRE(imported.warnings.size() == 1);
  CHECK_THAT(imported.warnings.front(), Contains("load case 1: left out"));
}

TEST_CASE("An idler is driven on one flank and drives with the other", "[studies][rexs][import][unit]") {
  const GearTrain train = idler_train(GENERATE(false, true));
  const Study first = study_of_stage(train, 1), second = study_of_stage(train, 2);
  CHECK(first.torques.front() == Approx(300e3).epsilon(round_off_of_torques));
  CHECK(second.torques.front() == Approx(300e3 * 37 / 21).epsilon(round_off_of_torques));
  CHECK(first.pair.working_flank == WorkingFlank::Right);
  CHECK(second.pair.working_flank == WorkingFlank::Left);
  REQUIRE(first.unit.meshes.size() == 1);
  REQUIRE(second.unit.meshes.size() == 1);
  // The balance of the first stage's unit finds the same for the second mesh, and the other way round.
  const UnitState from_first = state_of_stage(train, 1), from_second = state_of_stage(train, 2);
  CHECK(from_first.meshes[1].first_flank == second.pair.working_flank);
  CHECK(from_first.meshes[1].torque[0] == Approx(-300e3 * 37 / 21).epsilon(round_off_of_torques));
  CHECK(from_second.meshes[1].first_flank == first.pair.working_flank);
  CHECK(from_second.meshes[1].torque[0] == Approx(300e3).epsilon(round_off_of_torques));
  for (std::size_t i = 0; i < 2; ++i) CHECK(from_first.meshes[i].normal_force == Approx(from_second.meshes[1 - i].normal_force).epsilon(1e-9));
}

TEST_CASE("A power at a speed is a torque with its sign", "[studies][rexs][import][unit]") {
  // 50 kW at -1200 / min turn the input the other way; neither load says that it transmits torque.
  TwoStages by_power({number("power", 50, "kW")}), by_torque({torque(-50e3 / (1200 * units::pi / 30.0))});
  by_power.train.set(by_power.input, number("rotational_speed", -1200, "1 / min"));
  for (const int stage : {1, 2}) {
    const Study one = study_of_stage(by_power.train, stage), other = study_of_stage(by_torque.train, stage);
    CHECK(one.pair.working_flank == (stage == 1 ? WorkingFlank::Left : WorkingFlank::Right));
    CHECK(one.pair.working_flank == other.pair.working_flank);
    CHECK(one.torques.front() == Approx(other.torques.front()).epsilon(round_off_of_torques));
    CHECK_FALSE(one.unit.empty());
    CHECK_FALSE(other.unit.empty());
    CHECK(one.unit.reference_torque == Approx(other.unit.reference_torque).epsilon(round_off_of_torques));
  }
}

TEST_CASE("Forces of a unit are those of the case whose torque is the reference", "[studies][rexs][import][unit]") {
  TwoStages file({word("transmits_torque", "true")});
  file.train.load_case({{file.load, {torque(0), number("force_v_direction", 9000, "N")}}});
  file.train.load_case({{file.load, {torque(400), number("force_v_direction", 300, "N")}}});
  const Study study = study_of_stage(file.train, 1);
  CHECK(study.unit.reference_torque == Approx(400e3).epsilon(round_off_of_torques));
  REQUIRE(study.unit.loads.size() == 1);
  CHECK(study.unit.loads[0].force.norm() == Approx(300.0).epsilon(round_off_of_torques));
}
