#include <catch2/catch.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "studies/exchange/rexs/rexs_import.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/exchange/rexs/gear_train.hpp"

using namespace flankwright;
using namespace flankwright::studies;
using namespace flankwright::studies::gear_trains;
using Catch::Contains;

namespace {

/// Two stages on three shafts. The bearings of the middle shaft and the places of its gears are what a test says.
GearTrain stages_on(const std::vector<double>& bearings, double wheel_at = 100, double pinion_at = 200, bool is_loose = false) {
  const double first = reference_distance(19, 71, 3, 18), second = reference_distance(23, 67, 5, 14);
  GearTrain train;
  const int input = train.shaft(0, 0), middle = train.shaft_on(first, 0, bearings), output = train.shaft(first, second);
  train.load(input, 0, {number("torque_around_u_axis", 100, "N m")});
  train.load(output, 300, {word("transmits_torque", "true")});
  train.stage(train.gear(input, wheel_at, 19, 3, 18.0), train.gear(middle, wheel_at, 71, 3, -18.0));
  const int pinion = is_loose ? train.loose_gear(pinion_at, 23, 5, -14.0) : train.gear(middle, pinion_at, 23, 5, -14.0);
  train.stage(pinion, train.gear(output, pinion_at, 67, 5, 14.0));
  return train;
}

std::vector<StudyProblem> defects_of(const GearTrain& train, std::optional<int> stage = {}) {
  try {
    rexs::import_unit(train.text(), "unit.rexs", {.stage = stage, .grid_stem = "unit"});
  } catch (const StudyErrors& errors) {
    return errors.problems();
  }
  return {};
}

StudyProblem one_defect_of(const GearTrain& train, std::optional<int> stage = {}) {
  const std::vector<StudyProblem> problems = defects_of(train, stage);
  REQUIRE(problems.size() == 1);
  CHECK(problems.front().line > 0);
  return problems.front();
}

}  // namespace

TEST_CASE("A sound unit has no defects", "[studies][rexs][import][unit][errors]") { CHECK(defects_of(stages_on({20, 280})).empty()); }

TEST_CASE("Two bearings at one place of a shaft are refused with component and line", "[studies][rexs][import][unit][errors]") {
  const StudyProblem problem = one_defect_of(stages_on({20, 280, 280}));
  CHECK_THAT(problem.key, Contains("concept_bearing") && Contains("u_coordinate_on_shaft_inner_side"));
  CHECK(problem.value == "280 mm");
  CHECK_THAT(problem.allowed, Contains("of its own") && Contains("concept_bearing"));
}

TEST_CASE("A bearing beside its shaft is refused", "[studies][rexs][import][unit][errors]") {
  CHECK_THAT(one_defect_of(stages_on({20, 310})).allowed, Contains("0 .. 300 mm"));
}

TEST_CASE("A shaft that one bearing holds is a mechanism and refused", "[studies][rexs][import][unit][errors]") {
  const StudyProblem one = one_defect_of(stages_on({20})), none = one_defect_of(stages_on({}));
  CHECK_THAT(one.key, Contains("shaft"));
  CHECK_THAT(one.value, Contains("on concept_bearing") && Contains("alone"));
  CHECK_THAT(one.allowed, Contains("can move as a rigid body"));
  CHECK(none.value == "on no bearing");
}

TEST_CASE("Gears that overlap on a shaft are refused", "[studies][rexs][import][unit][errors]") {
  const StudyProblem problem = one_defect_of(stages_on({20, 280}, 100, 139));
  CHECK_THAT(problem.key, Contains("cylindrical_gear") && Contains("u_coordinate_on_shaft"));
  CHECK_THAT(problem.allowed, Contains("which takes 80 .. 120 mm"));
  CHECK(defects_of(stages_on({20, 280}, 100, 140)).empty());  // faces of 40 mm that touch
}

TEST_CASE("A gear on no shaft is refused, and named where the wanted stage does not turn with it", "[studies][rexs][import][unit][errors]") {
  GearTrain train = stages_on({20, 280}, 100, 200, true);
  CHECK_THAT(one_defect_of(train).key, Contains("cylindrical_gear"));
  CHECK(one_defect_of(train).value == "on no shaft");
  // With the pinion on no shaft the second stage does not turn with the first one.
  const rexs::UnitImport first = rexs::import_unit(train.text(), "unit.rexs", {.stage = 1, .grid_stem = "unit"});
  REQUIRE(first.stages.size() == 1);
  CHECK(parse_study(first.stages.front().study.text, "stage.toml").pair.pinion.teeth == 19);
}

TEST_CASE("A defect of another gear train in the file is named and blocks only its own stages", "[studies][rexs][import][unit][errors]") {
  GearTrain train = stages_on({20, 280});
  const double distance = reference_distance(20, 41, 2, 0);
  const int lone = train.shaft_on(1000, 0, {20, 20}), other = train.shaft(1000 + distance, 0);
  train.stage(train.gear(lone, 100, 20, 2, 0.0), train.gear(other, 100, 41, 2, 0.0));
  CHECK(defects_of(train).size() == 1);
  CHECK(defects_of(train, 3).size() == 1);
  for (const int stage : {1, 2}) {
    const rexs::ImportedStudy imported = rexs::import_stage(train.text(), "unit.rexs", {.stage = stage, .grid_stem = "unit"});
    CHECK_FALSE(parse_study(imported.text, "stage.toml").unit.empty());
    REQUIRE(imported.warnings.size() == 1);
    CHECK_THAT(imported.warnings.front(), Contains("does not turn with the stage") && Contains("concept_bearing"));
  }
}
