#include <catch2/catch.hpp>
#include <optional>
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

/// How a file states the teeth of its first stage: 18 deg of helix angle, 25 deg of pressure angle.
struct Stating {
  const char* version{"1.6"};
  const char* flank_type{"cylindrical_gear_flank"};
  std::optional<double> pinion_helix{18.0}, wheel_helix{-18.0};
  bool by_tool{false};
  bool by_wheel_only{false};
};

std::string unit_stating(const Stating& stating) {
  const double first = reference_distance(19, 71, 3, 18), second = reference_distance(23, 67, 5, 14);
  GearTrain train(stating.version);
  const int input = train.shaft(0, 0), middle = train.shaft(first, 0), output = train.shaft(first, second);
  train.load(input, 0, {number("torque_around_u_axis", 400, "N m")});
  train.load(output, 300, {word("transmits_torque", "true")});
  const int pinion = train.gear(input, 100, 19, 3, stating.pinion_helix), wheel = train.gear(middle, 100, 71, 3, stating.wheel_helix);
  const Attributes angle{number("normal_pressure_angle", 25, "deg")};
  for (const int gear : {pinion, wheel}) {
    if (stating.by_wheel_only && gear == pinion) continue;
    if (stating.by_tool) {
      train.tool(gear, angle);
    } else {
      train.flanks(gear, stating.flank_type, angle);
    }
  }
  train.stage(pinion, wheel);
  train.stage(train.gear(middle, 200, 23, 5, -14.0), train.gear(output, 200, 67, 5, 14.0));
  return train.text();
}

rexs::ImportedStudy second_stage(const std::string& text) { return rexs::import_stage(text, "unit.rexs", {.stage = 2, .grid_stem = "unit"}); }

}  // namespace

TEST_CASE("Another mesh of a unit has its teeth from either gear, however the file states them", "[studies][rexs][import][unit]") {
  const auto mesh_of = [](const Stating& stating) {
    const Study study = parse_study(second_stage(unit_stating(stating)).text, "second.toml", {{"fidelity.compliance", "thin_slice"}});
    REQUIRE(study.unit.meshes.size() == 1);
    const UnitMesh& mesh = study.unit.meshes.front();
    CHECK(mesh.pressure_angle == Approx(25 * units::deg).epsilon(1e-14));
    CHECK(mesh.helix_angle == Approx(18 * units::deg).epsilon(1e-14));
    CHECK(mesh.hand == Hand::Right);
    return make_shafts(study, make_gear_pair(study.pair))->state(study.torques.front()).meshes.at(1);
  };
  const MeshState usual = mesh_of({});
  const Stating stating = GENERATE(Stating{.version = "1.2", .flank_type = "flank_geometry"}, Stating{.pinion_helix = std::nullopt},
                                   Stating{.wheel_helix = std::nullopt}, Stating{.by_tool = true}, Stating{.by_wheel_only = true});
  const MeshState other = mesh_of(stating);
  CHECK((other.force - usual.force).norm() <= 1e-12 * usual.force.norm());
}

TEST_CASE("Angles that another mesh does not state are said to be taken", "[studies][rexs][import][unit]") {
  const std::string text = second_stage(unit_stating({.pinion_helix = std::nullopt, .wheel_helix = std::nullopt})).text;
  CHECK_THAT(text, Contains("not in the file: spur"));
}

TEST_CASE("Gears of another mesh that contradict each other are refused with the unit", "[studies][rexs][import][unit][errors]") {
  const rexs::ImportedStudy imported = second_stage(unit_stating({.wheel_helix = 18.0}));
  CHECK(parse_study(imported.text, "second.toml").unit.empty());
  CHECK_THAT(imported.text,
             Contains("the unit around the stage: not taken") && Contains("helix_angle_reference_diameter = 18: allowed is -18 deg, opposite"));
}
