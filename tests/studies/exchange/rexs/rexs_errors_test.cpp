#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "studies/exchange/rexs/rexs_import.hpp"
#include "studies/exchange/rexs/rexs_origin.hpp"
#include "tests/studies/exchange/rexs/gear_train.hpp"
#include "tests/studies/exchange/rexs/small_rexs.hpp"
#include "tests/studies/study_texts.hpp"

using namespace flankwright;
using namespace flankwright::studies;
using Catch::Contains;
using study_texts::replaced;
using namespace small_rexs;

TEST_CASE("A stage that no study can describe is refused with component and attribute", "[studies][rexs][import][errors]") {
  const std::string good = small_file();
  REQUIRE(refusal(good).empty());
  CHECK_THAT(refusal(replaced(good, attribute("number_of_teeth", "20", "none"), attribute("number_of_teeth", "20.5", "none"))),
             Contains("gears.rexs:9:1: cylindrical_gear 2 number_of_teeth = 20.5"));
  CHECK_THAT(refusal(replaced(good, attribute("number_of_teeth", "40", "none"), attribute("number_of_teeth", "-40", "none"))),
             Contains("internal gears are not modelled"));
  CHECK_THAT(refusal(replaced(good, attribute("face_width", "40"), "")), Contains("cylindrical_gear 2 face_width = not given"));
  CHECK_THAT(refusal(replaced(good, attribute("face_width", "40"), attribute("face_width", "wide"))),
             Contains("face_width = wide: allowed is a finite number"));
  CHECK_THAT(refusal(replaced(good, attribute("face_width", "40"), attribute("face_width", "40", "kg"))),
             Contains("face_width = a value in kg: allowed is a unit of mm, m, cm"));
  CHECK_THAT(refusal(replaced(good, attribute("normal_module", "4"), attribute("normal_module", "5"))),
             Contains("cylindrical_gear 3 normal_module = 4: allowed is that of the mate, 5"));
  CHECK_THAT(
      refusal(replaced(good, attribute("helix_angle_reference_diameter", "0", "deg"), attribute("helix_angle_reference_diameter", "12", "deg"))),
      Contains("cylindrical_gear 3 helix_angle_reference_diameter = 0: allowed is -12 deg, opposite"));
  CHECK_THAT(refusal(replaced(good, "type=\"stage\"", "type=\"side\"")), Contains("no relation \"stage\""));
  CHECK_THAT(refusal(replaced(good, "<ref id=\"3\" role=\"gear_2\"/>", "<ref id=\"33\" role=\"gear_2\"/>")), Contains("relation 1 role gear_2 = 33"));
  CHECK_THAT(refusal(replaced(good, "<ref id=\"3\" role=\"gear_2\"/>", "")), Contains("without gear_2"));
  // Well-formed JSON, but its number is no double.
  const std::string overflow =
      R"({"model":{"components":[{"id":2,"type":"cylindrical_gear","attributes":[{"id":"face_width","floating_point":4e400}]}]}})";
  CHECK_THAT(refusal(overflow), Contains("JSON = number overflow parsing '4e400'"));
  // A pair that cannot run: the reason, and what of the file it came from.
  CHECK_THAT(
      refusal(replaced(good, "type=\"cylindrical_stage\"/>", "type=\"cylindrical_stage\">" + attribute("center_distance", "500") + "</component>")),
      Contains("gears.rexs:7:1: cylindrical_stage 1: pair.centre_distance (cylindrical_stage 1 center_distance) = 500"));
}

TEST_CASE("A value that no study allows is refused with the component, its name and the line that it came from", "[studies][rexs][import][errors]") {
  const auto with_material = [](const std::string& modulus) {
    return small_file(
        "<component id=\"30\" name=\"Steel\" type=\"material\">\n" + attribute("elastic_modulus", modulus, "N / mm^2") + "</component>\n",
        "<relation id=\"30\" type=\"reference\"><ref id=\"2\" role=\"origin\"/><ref id=\"30\" role=\"referenced\"/></relation>\n");
  };
  REQUIRE(refusal(with_material("206000")).empty());
  CHECK(
      refusal(with_material("-1")) ==
      "gears.rexs:26:1: cylindrical_stage 1: pinion.material.youngs_modulus (material 30 \"Steel\" elastic_modulus) = -1: allowed is a number above 0 "
      "and at most 10000000 MPa");
  // What the attribute's own reading refuses has the name, too.
  CHECK_THAT(refusal(with_material("soft")), Contains("gears.rexs:26:1: material 30 \"Steel\" elastic_modulus = soft"));
  // Forms without lines have the rest.
  const std::string json = rexs::model_text(rexs::parse_model(with_material("-1"), "gears.rexs"), rexs::Form::Json);
  CHECK_THAT(refusal(json), Contains("gears.rexs: cylindrical_stage 1: pinion.material.youngs_modulus (material 30 \"Steel\" elastic_modulus) = -1"));
}

TEST_CASE("A remark names components and the line of the first one's attribute", "[studies][rexs][import][errors]") {
  const rexs::Model model{
      .version = "1.6",
      .components = {{.id = 4, .type = "shaft", .name = "Input", .line = 3},
                     {.id = 6, .type = "gear", .name = "G \"1\"", .attributes = {{.id = "face_width", .unit = "mm", .line = 8}}, .line = 7}}};
  const auto origin = [&](const std::string& remark) { return rexs::origin_of(model, remark); };
  CHECK(origin("gear 6 face_width, in modules").words == "gear 6 \"G \"1\"\" face_width, in modules");
  CHECK(origin("gear 6 face_width, in modules").line == 8);
  CHECK(origin("gear 6 helix_angle").line == 7);
  CHECK(origin("shaft 4, gear 6 face_width").words == "shaft 4 \"Input\", gear 6 \"G \"1\"\" face_width");
  CHECK(origin("shaft 4, gear 6 face_width").line == 3);
  CHECK(origin("of load case 4").words == "of load case 4");  // a number, but no shaft
  CHECK(origin("of load case 4").component == nullptr);
  CHECK(origin("").words.empty());
}

TEST_CASE("Where no stage of a file can be imported the reasons are the error", "[studies][rexs][import][errors]") {
  const auto refusal_of_all = [](const std::string& text) {
    try {
      rexs::import_unit(text, "gears.rexs", {.grid_stem = "s"});
    } catch (const StudyErrors& errors) {
      return std::string(errors.what());
    }
    return std::string();
  };
  // Both stages need the load; what is wrong with it is said once.
  const std::string broken = refusal_of_all(replaced(sample_file("coaxial_unit.rexs"), "600.0</attribute>", "600,0</attribute>"));
  CHECK_THAT(broken,
             Contains("force_v_direction = 600,0") && Contains("a finite number with a decimal point") && !Contains("\n") && !Contains("--stage"));

  // Two lines for each of two stages: the active flanks do not meet, and the contact ratio is below 1.
  gear_trains::GearTrain train;
  const int first = train.bare_shaft(0, 0), second = train.bare_shaft(200, 0);
  for (const double at : {100.0, 200.0}) {
    const int small = train.gear(first, at, 20, 4, 0.0), large = train.gear(second, at, 80, 4, 0.0);
    train.set(train.stage(small, large), gear_trains::number("center_distance", at + 300.0, "mm"));
  }
  const std::string apart = refusal_of_all(train.text());
  CHECK_THAT(apart, Contains("centre_distance") && Contains("= 400") && Contains("= 500") && !Contains("\\x0a"));
  CHECK(std::ranges::count(apart, '\n') == 3);
}
