#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "studies/analysis/study_notes.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/study_file/study_file.hpp"

namespace flankwright::studies {
namespace {

/// A wheel that two pinions drive, on a spectrum of two loads.
const std::string two_pinions = R"([pair]
normal_module = 6
[pinion]
teeth = 25
face_width = 40
[pinion.shaft]
sections = [{ length = 200, outer_diameter = 80 }]
bearings = [{ position = 20, radial_stiffness = 900 }, { position = 180, radial_stiffness = 900 }]
gear_position = 80
torque_position = 0
[wheel]
teeth = 60
face_width = 40
[wheel.shaft]
sections = [{ length = 200, outer_diameter = 120 }]
bearings = [{ position = 20, radial_stiffness = 900 }, { position = 180, radial_stiffness = 900 }]
gear_position = 80
torque_position = 200
[load]
spectrum = [{ torque = 800, cycles = 1e5 }, { torque = 500, cycles = 1e7 }]
[material]
contact_endurance_limit = 900
[cycle]
positions = 4
peaks = "sampled"
[fidelity]
compliance = "thin_slice"
effect_sizes = "off"
quadrature = { rule = "graded", intervals = 6 }
[unit]
shafts = [{ name = "second", sections = [{ length = 200, outer_diameter = 80 }], bearings = [{ position = 20, radial_stiffness = 900 }, { position = 180, radial_stiffness = 900 }], torque_position = 0 }]
meshes = [{ name = "second mesh", shaft_1 = "second", position_1 = 80, teeth_1 = 25, face_width_1 = 40, shaft_2 = "wheel", position_2 = 80, teeth_2 = 60, face_width_2 = 40, normal_module = 6, angle = 90, torque_1 = 800 }]
)";

Json life_of(const std::vector<Override>& overrides) {
  const StudyResults results = run_study(parse_study(two_pinions, "unit.toml", overrides));
  const Json written = Json::parse(results_json(results));
  REQUIRE(written.at("notes").dump().find("not summed") == std::string::npos);
  return written.at("life");
}

double damage(const Json& life, const std::string& gear) { return life.at("spectra").at(0).at(gear).at("contact").at("damage").get<double>(); }

constexpr double round_off = 1e-12;

}  // namespace

TEST_CASE("A wheel that two pinions drive has two load cycles in a revolution, an idler's flank has one", "[studies][unit][life]") {
  const Json both = life_of({}), one = life_of({{"wheel.meshes_per_revolution", "1"}});
  CHECK(both.at("wheel").at("meshes_per_revolution") == 2);
  CHECK(both.at("pinion").at("meshes_per_revolution") == 1);
  CHECK(damage(both, "wheel") == Approx(2.0 * damage(one, "wheel")).epsilon(round_off));
  CHECK(damage(both, "pinion") == damage(one, "pinion"));
  // The second gear takes the torque of the first: it loads the wheel's other flank.
  const Json idler = life_of({{"unit.meshes.0.torque_1", "-800"}});
  CHECK(idler.at("wheel").at("meshes_per_revolution") == 1);
  // Its roots bend both ways, which is said where they are rated.
  const auto has_note = [](const std::vector<Override>& overrides) {
    const Study study = parse_study(two_pinions, "unit.toml", overrides);
    const std::vector<std::string> notes = study_notes(study, make_gear_pair(study.pair));
    return std::ranges::any_of(notes, [](const std::string& note) { return note.starts_with("the wheel's teeth are loaded on both flanks"); });
  };
  CHECK(has_note({{"unit.meshes.0.torque_1", "-800"}, {"material.root_endurance_limit", "400"}}));
  CHECK_FALSE(has_note({{"unit.meshes.0.torque_1", "-800"}}));
  CHECK_FALSE(has_note({{"material.root_endurance_limit", "400"}}));
}

TEST_CASE("Damage is summed where bearings make a mesh of its own for each load", "[studies][unit][life][shaft]") {
  const Json linear = life_of({}), loose = life_of({{"pinion.shaft.bearings.0.radial_clearance", "1e-3"}});
  REQUIRE(loose.at("spectra").size() == 1);
  // A nanometre of clearance moves what the flanks carry by about as much of their deflection, and damage by 13 times that.
  for (const char* gear : {"pinion", "wheel"}) CHECK(damage(loose, gear) == Approx(damage(linear, gear)).epsilon(1e-2));
  // With enough of it the shaft leans, and the damage is another one.
  CHECK(std::abs(damage(life_of({{"pinion.shaft.bearings.0.radial_clearance", "60"}}), "pinion") / damage(linear, "pinion") - 1.0) > 0.1);
}

TEST_CASE("Loads of a unit are meant at its largest torque, in whichever order a spectrum has it", "[studies][unit][life]") {
  const std::string loads = R"([{ shaft = "wheel", position = 150, force_x = 4000 }])";
  const auto ordered = [&](const std::string& spectrum) {
    return life_of({{"load.spectrum", spectrum}, {"unit.loads", loads}, {"unit.meshes.0.torque_1", "800"}});
  };
  const Json falling = ordered("[{ torque = 800, cycles = 1e5 }, { torque = 500, cycles = 1e7 }]");
  const Json rising = ordered("[{ torque = 500, cycles = 1e7 }, { torque = 800, cycles = 1e5 }]");
  for (const char* gear : {"pinion", "wheel"}) CHECK(damage(rising, gear) == Approx(damage(falling, gear)).epsilon(round_off));
}

TEST_CASE("A shaft that nothing loads lies in the middle of its clearances, and the pair's shafts are as without it", "[studies][unit][shaft]") {
  const std::string second =
      R"({ name = "second", sections = [{ length = 200, outer_diameter = 80 }], bearings = [{ position = 20, radial_stiffness = 900 }, )"
      R"({ position = 180, radial_stiffness = 900 }], torque_position = 0 })";
  const std::string idle = R"({ name = "idle", sections = [{ length = 100, outer_diameter = 30 }], torque_position = 50, )"
                           R"(bearings = [{ position = 10, radial_clearance = 20 }, { position = 90, radial_clearance = 20 }] })";
  const std::string with_idle = "[" + second + ", " + idle + "]";
  const Json without = life_of({}), with = life_of({{"unit.shafts", with_idle}});
  for (const char* gear : {"pinion", "wheel"}) CHECK(damage(with, gear) == Approx(damage(without, gear)).epsilon(1e-9));  // the solver's residual
}

}  // namespace flankwright::studies
