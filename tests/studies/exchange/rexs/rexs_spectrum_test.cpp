#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "core/compliance/shaft/shaft_pair.hpp"
#include "core/gear/gear_pair.hpp"
#include "studies/exchange/rexs/rexs_import.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/study_file/study_shafts.hpp"
#include "tests/studies/exchange/rexs/gear_train.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using namespace flankwright::studies;
using namespace flankwright::studies::gear_trains;
using Catch::Contains;

namespace {

constexpr double spectrum_round_off = 1e-12;

/// What one load case of the two stages says.
struct SpectrumCase {
  double torque;      ///< N m
  double speed;       ///< 1/min, of the input
  double share;       ///< %
  double force{0.0};  ///< N, across the input
};

/// Two stages on three shafts, 19 : 71 and 23 : 67; the casing holds oil of 70 deg C.
struct SpectrumUnit {
  GearTrain train;
  int unit, input, load;

  SpectrumUnit() {
    const double first = reference_distance(19, 71, 3, 18), second = reference_distance(23, 67, 5, 14);
    unit = train.unit();
    input = train.shaft(0, 0);
    const int middle = train.shaft(first, 0), output = train.shaft(first, second);
    load = train.load(input, 0, {word("transmits_torque", "true")});
    train.load(output, 300, {word("transmits_torque", "true")});
    train.stage(train.gear(input, 100, 19, 3, 18.0), train.gear(middle, 100, 71, 3, -18.0));
    train.stage(train.gear(middle, 200, 23, 5, -14.0), train.gear(output, 200, 67, 5, 14.0));
    train.lubricant({number("viscosity_at_40_degree_celsius", 100, "mm^2 / s"), number("viscosity_at_100_degree_celsius", 11, "mm^2 / s"),
                     number("density_at_15_degree_celsius", 0.88, "kg / dm^3")});
  }

  void load_case(const SpectrumCase& c, const std::string& share_id = "operating_time_fraction") {
    train.load_case({{unit, {number(share_id, c.share, "%")}},
                     {input, {number("rotational_speed", c.speed, "1 / min")}},
                     {load, {number("torque_around_u_axis", c.torque, "N m"), number("force_v_direction", c.force, "N")}},
                     {train.casing(), {number("temperature_lubricant", 70, "C")}}});
  }

  rexs::ImportedStudy stage(int number, std::optional<double> hours = {}) const {
    return rexs::import_stage(train.text(), "unit.rexs", {.stage = number, .hours = hours, .grid_stem = "unit"});
  }
};

Study spectrum_study_of(const rexs::ImportedStudy& imported) {
  return parse_study(imported.text, "stage.toml", {{"fidelity.compliance", "thin_slice"}});
}

double in_rpm(double radians_per_second) { return radians_per_second * 30.0 / units::pi; }

}  // namespace

TEST_CASE("Load cases with speeds, shares and a life are a load spectrum of either stage", "[studies][rexs][import][spectrum]") {
  const bool in_file = GENERATE(true, false);
  SpectrumUnit file;
  file.load_case({400, 543, 20});
  file.load_case({250, -3456, 80}, GENERATE("operating_time_fraction", "load_duration_fraction"));
  if (in_file) file.train.set(file.unit, number("operating_time", 20000, "h"));
  for (const int stage : {1, 2}) {
    const Study study = spectrum_study_of(file.stage(stage, in_file ? std::nullopt : std::optional(20000.0)));
    const double ratio = stage == 1 ? 1.0 : 71.0 / 19.0;
    REQUIRE(study.spectrum.size() == 2);
    CHECK(study.spectrum[0].torque == Approx(400e3 * ratio).epsilon(spectrum_round_off));
    CHECK(in_rpm(study.spectrum[0].speed) == Approx(543 / ratio).epsilon(spectrum_round_off));
    CHECK(in_rpm(study.spectrum[1].speed) == Approx(3456 / ratio).epsilon(spectrum_round_off));
    CHECK(study.spectrum[0].hours == Approx(4000 * 3600.0).epsilon(spectrum_round_off));
    CHECK(study.spectrum[1].hours == Approx(16000 * 3600.0).epsilon(spectrum_round_off));
    CHECK(study.spectrum[0].temperature == 70.0);
    CHECK(study.spectrum[1].mesh_misalignment == 0.0);
    CHECK_FALSE(study.unit.empty());
  }
}

TEST_CASE("Load cases with shares of an unknown life are scenes with speeds and weights", "[studies][rexs][import][spectrum]") {
  SpectrumUnit file;
  file.load_case({400, 543, 20});
  file.load_case({250, 3456, 80});
  const rexs::ImportedStudy imported = file.stage(1);
  const Study study = spectrum_study_of(imported);
  CHECK(study.spectrum.empty());
  REQUIRE(study.scenes.size() == 2);
  CHECK(in_rpm(study.scenes[1].speed) == Approx(3456).epsilon(spectrum_round_off));
  CHECK(study.scenes[1].weight == Approx(0.8).epsilon(spectrum_round_off));
  CHECK_THAT(imported.text, Contains("--hours"));
}

TEST_CASE("The lubricant of the casing is imported, with a roughness that is named where the file has none", "[studies][rexs][import][spectrum]") {
  SpectrumUnit file;
  file.load_case({400, 543, 100});
  const rexs::ImportedStudy imported = file.stage(1);
  const Study study = spectrum_study_of(imported);
  REQUIRE(study.life.has_lubricant);
  CHECK(study.life.lubricant.viscosity_40 == 100.0);
  CHECK(study.life.lubricant.viscosity_100 == 11.0);
  CHECK(study.life.lubricant.density_15 == Approx(880.0).epsilon(spectrum_round_off));
  CHECK(study.life.lubricant.temperature == 70.0);
  REQUIRE(imported.warnings.size() == 1);
  CHECK_THAT(imported.warnings.front(), Contains("no roughness of the flanks"));
  // A viscosity that rises with the temperature is none.
  file.train.set(file.train.last("lubricant"), number("viscosity_at_100_degree_celsius", 110, "mm^2 / s"));
  CHECK_THROWS_WITH(file.stage(1), Contains("viscosity_at_100_degree_celsius = 110 mm^2/s"));
}

TEST_CASE("An oil that a study does not know is named by attribute and value", "[studies][rexs][import][spectrum]") {
  const auto with = [](const rexs::Attribute& attribute) {
    SpectrumUnit file;
    file.load_case({400, 543, 100});
    file.train.set(file.train.last("lubricant"), attribute);
    return file.stage(1);
  };
  const rexs::ImportedStudy no_kind = with(word("kind", "false")), no_type = with(word("lubricant_type_iso_6336_2006", "false"));
  CHECK_FALSE(spectrum_study_of(no_kind).life.has_lubricant);
  CHECK_THAT(no_kind.text, Contains("not taken, kind = \"false\", and a study knows oils"));
  CHECK(spectrum_study_of(no_type).life.has_lubricant);
  CHECK_THAT(no_type.text, Contains("lubricant_type_iso_6336_2006 = \"false\" names no oil of a study, and mineral oil is taken"));
}

TEST_CASE("Negative times are refused with component, attribute, value and line", "[studies][rexs][import][errors][spectrum]") {
  SpectrumUnit file;
  file.load_case({400, 543, 105});
  file.load_case({250, 3456, -5});
  try {
    file.stage(1);
    FAIL("a case of -5 % of the time was imported");
  } catch (const StudyErrors& errors) {
    REQUIRE(errors.problems().size() == 1);
    const StudyProblem& problem = errors.problems().front();
    CHECK_THAT(problem.key, Contains("gear_unit 2 operating_time_fraction of load case 2"));
    CHECK_THAT(problem.value, Contains("-5 %"));
    CHECK(problem.line > 0);
  }
  CHECK_THROWS_AS(rexs::import_unit(file.train.text(), "unit.rexs", {.grid_stem = "unit"}), StudyErrors);
}

TEST_CASE("Shares of time that are none, or add up to more than the whole, are named", "[studies][rexs][import][errors][spectrum]") {
  const auto warned = [](const rexs::ImportedStudy& imported, const std::string& what) {
    return std::ranges::any_of(imported.warnings, [&](const std::string& warning) { return warning.find(what) != std::string::npos; });
  };
  SpectrumUnit more;
  more.load_case({400, 543, 70});
  more.load_case({250, 3456, 50});
  CHECK(warned(more.stage(1), "add up to 120 %"));
  SpectrumUnit none;
  none.load_case({400, 543, 100});
  none.load_case({900, 543, 0});
  const rexs::ImportedStudy imported = none.stage(1);
  CHECK(warned(imported, "load case 2: left out, its 900 N m take 0 % of the time"));
  CHECK(spectrum_study_of(imported).torques == std::vector{400e3});
}

TEST_CASE("Speeds that contradict each other are named", "[studies][rexs][import][errors][spectrum]") {
  SpectrumUnit file;
  file.load_case({400, 1500, 100});
  file.train.set(file.train.last("shaft"), number("rotational_speed", 400, "1 / min"));
  CHECK(file.stage(1).warnings.size() == 1);  // of the model, which the load case overrides: only the roughness is said
  SpectrumUnit both;
  both.train.set(both.input, number("rotational_speed", 1500, "1 / min"));
  both.train.set(both.train.last("shaft"), number("rotational_speed", 400, "1 / min"));
  CHECK_THAT(both.stage(1).text, Contains("the pinion turns with 1500 rpm by shaft"));
}

TEST_CASE("Loads from outside that do not scale with the torque add their misalignment to their case", "[studies][rexs][import][unit][spectrum]") {
  SpectrumUnit both, second_alone;
  both.load_case({400, 1500, 50, 3000});
  both.load_case({200, 1500, 50, 9000});
  second_alone.load_case({200, 1500, 100, 9000});
  for (const int stage : {1, 2}) {
    const rexs::ImportedStudy imported = both.stage(stage, 10000.0);
    // With the compliance that an imported study has: its gear body moves with the shaft at mid face.
    const Study study = parse_study(imported.text, "stage.toml"), own = parse_study(second_alone.stage(stage).text, "own.toml");
    REQUIRE(study.spectrum.size() == 2);
    CHECK(study.spectrum[0].mesh_misalignment == 0.0);
    const auto misalignment = [](const Study& of, double torque) {
      return make_shafts(of, make_gear_pair(of.pair))->state(torque).mesh_misalignment;
    };
    // Independent route: the second case by itself, with its own forces.
    constexpr double digits = 1e-3;  // misalignments are written with four, and below 0.01 um not at all
    const double torque = study.spectrum[1].torque, expected = misalignment(own, torque);
    CHECK(misalignment(study, torque) + study.spectrum[1].mesh_misalignment == tests::about(expected, digits * std::abs(expected) + 1e-5));
    if (stage == 1) CHECK(std::abs(study.spectrum[1].mesh_misalignment) > 0.1 * std::abs(expected));
    CHECK_THAT(imported.text, Contains("load case 2: loads from outside are not those of load case 1"));
  }
}

TEST_CASE("Loads from outside that scale with the torque need no misalignment and no remark", "[studies][rexs][import][unit][spectrum]") {
  SpectrumUnit file;
  file.load_case({400, 1500, 50, 3000});
  file.load_case({200, 1500, 50, 1500});
  const rexs::ImportedStudy imported = file.stage(1, 10000.0);
  CHECK(spectrum_study_of(imported).spectrum[1].mesh_misalignment == 0.0);
  CHECK(imported.warnings.size() == 1);  // the roughness
}

TEST_CASE("What is not taken of a load case is listed by name", "[studies][rexs][import][spectrum]") {
  SpectrumUnit file;
  file.load_case({400, 543, 100});
  file.train.load_case({{file.load, {number("torque_around_u_axis", 200, "N m")}}, {file.input, {number("mean_operating_temperature", 65, "C")}}});
  CHECK_THAT(file.stage(1).not_taken, Contains("load case 2, shaft 3: mean_operating_temperature"));
}
