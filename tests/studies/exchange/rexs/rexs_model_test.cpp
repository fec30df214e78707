#include "studies/exchange/rexs/rexs_model.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "core/base/units.hpp"
#include "studies/exchange/rexs/rexs_units.hpp"
#include "studies/study_file/study_file.hpp"

using namespace flankwright;
using namespace flankwright::studies::rexs;
using Catch::Contains;

namespace {

std::string model_refusal(const std::string& text) {
  try {
    parse_model(text, "gears.rexs");
  } catch (const studies::StudyErrors& errors) {
    return errors.what();
  }
  return "";
}

Model sample_model() {
  Model model{.version = "1.7", .application = "A \"B\" <C>", .application_version = "1", .date = "2026-01-01T00:00:00+00:00"};
  model.components.push_back({.id = 4, .type = "cylindrical_gear", .name = "Rad & \xc3\x84hnliches"});
  model.components.back().attributes = {{"number_of_teeth", "none", ValueType::Integer, "17"},
                                        {"normal_module", "mm", ValueType::Number, "0.1"},
                                        {"flag", "none", ValueType::Boolean, "true"},
                                        {"side", "none", ValueType::Word, "negative"},
                                        {"points", "mm", ValueType::NumberArray, "", {"1", "-2.5", "1e-07"}}};
  model.relations.push_back({.id = 1, .type = "stage", .order = 2, .refs = {{4, "gear_1", "cylindrical_gear"}}});
  model.load_cases.push_back({3, {{.id = 4, .type = "cylindrical_gear"}}});
  return model;
}

}  // namespace

TEST_CASE("A REXS model survives both of its forms", "[studies][rexs]") {
  const Form form = GENERATE(Form::Xml, Form::Json);
  const Model model = sample_model();
  const std::string text = model_text(model, form);
  CHECK(text.starts_with("\xef\xbb\xbf"));
  const Model back = parse_model(text, "a");
  CHECK(back.version == model.version);
  CHECK(back.application == model.application);
  CHECK(back.date == model.date);
  REQUIRE(back.components.size() == 1);
  const Component& gear = back.components.front();
  CHECK(gear.id == 4);
  CHECK(gear.type == "cylindrical_gear");
  CHECK(gear.name == model.components.front().name);
  REQUIRE(gear.attributes.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(gear.attributes[i].id == model.components.front().attributes[i].id);
    CHECK(gear.attributes[i].unit == model.components.front().attributes[i].unit);
    CHECK(gear.attributes[i].text == model.components.front().attributes[i].text);
    CHECK(gear.attributes[i].array == model.components.front().attributes[i].array);
  }
  REQUIRE(back.relations.size() == 1);
  CHECK(back.relations.front().order == 2);
  CHECK(back.relations.front().role("gear_1") == 4);
  CHECK_FALSE(back.relations.front().role("gear_2"));
  REQUIRE(back.load_cases.size() == 1);
  CHECK(back.load_cases.front().id == 3);
  CHECK(model_text(parse_model(model_text(model, Form::Json), "a"), Form::Json) == model_text(model, Form::Json));
}

TEST_CASE("Elements of XML have their line", "[studies][rexs]") {
  const Model model = parse_model(
      "<model version='1.6'>\n<components>\n<component id='7' type='a'>\n\n<attribute id='b' unit='mm'> 3 </attribute></component>\n"
      "</components></model>",
      "a");
  CHECK(model.components.front().line == 3);
  CHECK(model.components.front().find("b")->line == 5);
  CHECK(model.components.front().find("b")->text == "3");
  CHECK(model.components.front().find("c") == nullptr);
}

TEST_CASE("A damaged REXS file is refused in one line with its position", "[studies][rexs][errors]") {
  CHECK_THAT(model_refusal(""), Contains("gears.rexs: file = without content"));
  CHECK_THAT(model_refusal("PK\x03\x04rest"), Contains("a damaged ZIP archive"));
  CHECK_THAT(model_refusal("hello"), Contains("XML starts with <, JSON with {"));
  CHECK_THAT(model_refusal("<model>\n<a>\xff</a></model>"), Contains("gears.rexs:2:1: byte = 0xff: allowed is UTF-8"));
  CHECK_THAT(model_refusal("<model>\n<relations>\n</model>"), Contains("gears.rexs:3:1: XML = Start-end tags mismatch"));
  CHECK_THAT(model_refusal("<model>\n"), Contains("gears.rexs:") && Contains("XML = "));
  CHECK_THAT(model_refusal("<gears/>"), Contains("element = gears: allowed is <model>"));
  CHECK_THAT(model_refusal("{\n\"model\": {\n\"relations\": [,]}}"), Contains("gears.rexs:3:1: JSON = "));
  CHECK_THAT(model_refusal("{\"model\": 3}"), Contains("model = 3"));
  CHECK_THAT(model_refusal("{\"gear\": {}}"), Contains("an object with \"model\""));
  CHECK_THAT(model_refusal("{\"model\": {\"components\": 3}}"), Contains("components = 3: allowed is a list"));
  const std::string component = "<component id='1' type='a'/>";
  CHECK_THAT(model_refusal("<model><components>" + component + "\n" + component + "</components></model>"),
             Contains("gears.rexs:2:1: component id = 1: allowed is each id once: a 1 has this one"));
  CHECK_THAT(model_refusal("<model><components>\n<component id='x1'/></components></model>"),
             Contains("gears.rexs:2:1: component id = x1: allowed is a whole number"));
  CHECK_THAT(model_refusal("<model><relations><relation id='1' type='a'><ref id='-3'/></relation></relations></model>"), Contains("ref id = -3"));
  const auto with_widths = [](const std::string& first, const std::string& second) {
    return "<model><components>\n<component id='1' type='a'>\n<attribute id='face_width' unit='mm'>" + first +
           "</attribute>\n<attribute id='face_width' unit='mm'>" + second + "</attribute></component></components></model>";
  };
  CHECK_THAT(model_refusal(with_widths("20", "25")), Contains("gears.rexs:4:1: a 1 face_width = 25: allowed is one value"));
  CHECK(model_refusal(with_widths("20", "20")).empty());
  // Neither nesting nor entities exhaust anything.
  std::string deep_json = "{\"model\": ", deep_xml = "<model>";
  for (int i = 0; i < 100000; ++i) {
    deep_json += '[';
    deep_xml += "<a>";
  }
  CHECK_FALSE(model_refusal(deep_json).empty());
  CHECK_FALSE(model_refusal(deep_xml).empty());
}

TEST_CASE("Packed arrays are unpacked", "[studies][rexs]") {
  using Numbers = std::vector<std::string>;
  // 1.0 and -2.5 as IEEE-754, little endian, as any base64 encoder gives them.
  CHECK(unpacked("AAAAAAAA8D8AAAAAAAAEwA==", "float64") == Numbers{"1", "-2.5"});
  CHECK(unpacked("AACAPwAAIMA=", "float32") == Numbers{"1", "-2.5"});
  CHECK(unpacked("AQAAAP7///8=", "int32") == Numbers{"1", "-2"});
  CHECK(unpacked("", "int32") == Numbers{});
  CHECK_FALSE(unpacked("AAAA", "float64"));
  CHECK_FALSE(unpacked("A*AA", "int32"));
  CHECK_FALSE(unpacked("AAAAAA==", "float16"));
}

TEST_CASE("Units are read however they are spelt", "[studies][rexs][units]") {
  CHECK(unit_size("deg", Dimension::Angle) == units::deg);
  CHECK(unit_size("\xc2\xb0", Dimension::Angle) == units::deg);
  CHECK(unit_size("N / mm^2", Dimension::Stress) == 1.0);
  CHECK(unit_size("MPa", Dimension::Stress) == 1.0);
  CHECK(unit_size("mum", Dimension::Length) == 1e-3);
  CHECK(unit_size("N\xc2\xb7m", Dimension::Torque) == 1e3);
  CHECK(unit_size("1 / min", Dimension::Speed) == 1.0);
  CHECK_FALSE(unit_size("deg", Dimension::Length));
  CHECK_FALSE(unit_size("furlong", Dimension::Length));
}
