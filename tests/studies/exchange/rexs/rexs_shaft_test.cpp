#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "studies/exchange/rexs/rexs_import.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/study_texts.hpp"

using namespace flankwright;
using namespace flankwright::studies;
using Catch::Contains;
using study_texts::replaced;

namespace {

std::string of_shaft(const std::string& id, const std::string& value, const std::string& unit = "mm") {
  return "<attribute id=\"" + id + "\" unit=\"" + unit + "\">" + value + "</attribute>\n";
}

/// A spur pair of 40 mm face; the pinion's shaft (7) has two sections of 70 and 90 mm, bearings at 15 and 150 mm, its torque at the end of low u.
std::string file_with_shaft(const std::string& u_axis = "1") {
  const auto gear = [](const std::string& id, const std::string& teeth, const std::string& more) {
    return "<component id=\"" + id + "\" type=\"cylindrical_gear\">\n" + of_shaft("number_of_teeth", teeth, "none") + of_shaft("normal_module", "4") +
           of_shaft("face_width", "40") + more + "</component>\n";
  };
  const auto ref = [](const std::string& type, const std::string& one, const std::string& role, const std::string& two, const std::string& other) {
    static int id = 100;
    return "<relation id=\"" + std::to_string(id++) + "\" type=\"" + type + "\"><ref id=\"" + one + "\" role=\"" + role + "\"/><ref id=\"" + two +
           "\" role=\"" + other + "\"/></relation>\n";
  };
  const auto side = [](const std::string& bearing, const std::string& mate) {
    return "<relation id=\"9" + bearing + "\" type=\"side\"><ref id=\"" + bearing +
           "\" role=\"assembly\"/><ref id=\"7\" role=\"inner_part\"/><ref id=\"" + mate + "\" role=\"outer_part\"/></relation>\n";
  };
  return "<model version=\"1.6\">\n<relations>\n<relation id=\"1\" type=\"stage\"><ref id=\"1\" role=\"stage\"/><ref id=\"2\" role=\"gear_1\"/><ref id=\"3\" role=\"gear_2\"/></relation>\n" +
         ref("assembly", "7", "assembly", "2", "part") + ref("assembly", "7", "assembly", "11", "part") +
         ref("assembly", "7", "assembly", "12", "part") + ref("assembly", "7", "assembly", "15", "part") + side("13", "16") + side("14", "16") +
         "</relations>\n<components>\n<component id=\"1\" type=\"cylindrical_stage\"/>\n" + gear("2", "20", of_shaft("u_coordinate_on_shaft", "80")) +
         gear("3", "40", "") + "<component id=\"7\" type=\"shaft\">\n" +
         of_shaft("u_axis_vector", "<array><c>" + u_axis + "</c><c>0</c><c>0</c></array>") + "</component>\n" +
         // The sections stand in the file in any order.
         "<component id=\"12\" type=\"shaft_section\">\n" + of_shaft("u_coordinate_on_shaft", "70") + of_shaft("length", "90") +
         of_shaft("outer_diameter_begin", "50") + of_shaft("outer_diameter_end", "50") +
         "</component>\n<component id=\"11\" type=\"shaft_section\">\n" + of_shaft("u_coordinate_on_shaft", "0") + of_shaft("length", "70") +
         of_shaft("outer_diameter_begin", "45") + of_shaft("outer_diameter_end", "45") + of_shaft("inner_diameter_begin", "10") +
         of_shaft("inner_diameter_end", "10") + "</component>\n<component id=\"13\" type=\"concept_bearing\">\n" +
         of_shaft("u_coordinate_on_shaft_inner_side", "15") + of_shaft("radial_stiffness", "4E+8", "N / m") +
         of_shaft("axial_stiffness", "1E+8", "N / m") + of_shaft("bending_stiffness", "2E+9", "N mm / rad") +
         "</component>\n<component id=\"14\" type=\"rolling_bearing_with_catalog_geometry\">\n" +
         of_shaft("u_coordinate_on_shaft_inner_side", "150") + "</component>\n<component id=\"15\" type=\"external_load\">\n" +
         of_shaft("u_coordinate_on_shaft", "0") + of_shaft("torque_around_u_axis", "100", "N m") +
         "</component>\n<component id=\"16\" type=\"gear_casing\"/>\n</components>\n</model>\n";
}

constexpr double shaft_round_off = 1e-12;  // of units

rexs::ImportedStudy shaft_study(const std::string& text) { return rexs::import_stage(text, "gears.rexs", {}); }

}  // namespace

TEST_CASE("A shaft with its bearings is imported with all numbers", "[studies][rexs][import]") {
  const rexs::ImportedStudy imported = shaft_study(file_with_shaft());
  const Study study = parse_study(imported.text, "gears.toml");
  REQUIRE(study.shaft.pinion);
  CHECK_FALSE(study.shaft.wheel);
  const ShaftData& shaft = *study.shaft.pinion;
  REQUIRE(shaft.sections.size() == 2);
  CHECK(shaft.sections[0].length == 70.0);
  CHECK(shaft.sections[0].inner_diameter == 10.0);
  CHECK(shaft.sections[1].outer_diameter == 50.0);
  REQUIRE(shaft.bearings.size() == 2);
  CHECK(shaft.bearings[0].radial_stiffness == Approx(4e5).epsilon(shaft_round_off));  // N/mm
  CHECK(shaft.bearings[0].axial_stiffness == Approx(1e5).epsilon(shaft_round_off));
  CHECK(shaft.bearings[0].tilting_stiffness == Approx(2e9).epsilon(shaft_round_off));  // N mm/rad
  CHECK(std::isinf(shaft.bearings[1].radial_stiffness));
  CHECK(shaft.gear_position == 80.0);
  CHECK(shaft.torque_position == 0.0);
  CHECK_THAT(imported.text, Contains("rolling_bearing_with_catalog_geometry 14: without radial_stiffness, taken as rigid"));
}

TEST_CASE("Where no bearing supports a shaft axially its first one does, and this is reported", "[studies][rexs][import]") {
  const rexs::ImportedStudy imported = shaft_study(replaced(file_with_shaft(), of_shaft("axial_stiffness", "1E+8", "N / m"), ""));
  const Study study = parse_study(imported.text, "gears.toml");
  REQUIRE(study.shaft.pinion);
  CHECK(std::isinf(study.shaft.pinion->bearings[0].axial_stiffness));
  CHECK_THAT(imported.text, Contains("shaft 7: no bearing has an axial_stiffness"));
}

TEST_CASE("A shaft whose axis runs against the pinion's is the same from its other end", "[studies][rexs][import]") {
  const Study study = parse_study(shaft_study(file_with_shaft("-1")).text, "gears.toml");
  REQUIRE(study.shaft.pinion);
  const ShaftData& shaft = *study.shaft.pinion;
  CHECK(shaft.sections[0].length == 90.0);
  CHECK(shaft.bearings[0].position == 10.0);
  CHECK(shaft.bearings[1].position == 145.0);
  CHECK(shaft.bearings[1].tilting_stiffness == Approx(2e9).epsilon(shaft_round_off));
  CHECK(shaft.gear_position == 80.0);
  CHECK(shaft.torque_position == 160.0);
}

TEST_CASE("A shaft that a study cannot have is named with the reason", "[studies][rexs][import]") {
  const std::string good = file_with_shaft();
  const auto why = [](const std::string& text) {
    const rexs::ImportedStudy imported = shaft_study(text);
    CHECK_FALSE(parse_study(imported.text, "gears.toml").shaft.pinion);
    std::string all;
    for (const std::string& warning : imported.warnings) all += warning + "\n";
    return all;
  };
  CHECK_THAT(why(replaced(good, "\"gear_casing\"", "\"shaft\"")), Contains("shaft 7: not taken, its concept_bearing 13 sits on shaft 16"));
  CHECK_THAT(why(replaced(good, of_shaft("u_coordinate_on_shaft", "70"), of_shaft("u_coordinate_on_shaft", "75"))),
             Contains("shaft_section 12 does not begin where the one before it ends"));
  CHECK_THAT(why(replaced(good, of_shaft("outer_diameter_begin", "45"), of_shaft("outer_diameter_begin", "-5"))),
             Contains("shaft 7: not taken, shaft_section 11 has an outer_diameter below 0"));  // not the mean of -5 and 45 mm
  CHECK_THAT(why(replaced(good, of_shaft("torque_around_u_axis", "100", "N m"), "")), Contains("nothing says where its torque enters"));
  CHECK_THAT(why(replaced(good, of_shaft("u_coordinate_on_shaft", "80"), of_shaft("u_coordinate_on_shaft", "150"))), Contains("gear_position"));
  CHECK_THAT(why(replaced(good, "<ref id=\"15\" role=\"part\"/>", "<ref id=\"3\" role=\"part\"/>")), Contains("it carries 2 gears"));
}
