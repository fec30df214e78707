#include "core/compliance/shaft/shaft_data.hpp"
#include "core/gear/gear_pair.hpp"

#include <catch2/catch.hpp>

using namespace flankwright;

namespace {

constexpr double kGearWidth = 40;

ShaftData sound() {
  ShaftData shaft;
  shaft.sections = {{50, 40}, {60, 50, 20}, {50, 40}};
  shaft.bearings = {{.position = 10, .axial_stiffness = 1e6}, {.position = 150}};
  shaft.gear_position = 80;
  shaft.torque_position = 0;
  return shaft;
}

}  // namespace

TEST_CASE("A sound shaft has no problem, its length and its side of torque", "[core][compliance][shaft]") {
  ShaftData shaft = sound();
  CHECK(find_problems(shaft, kGearWidth).empty());
  CHECK(shaft.length() == 160);
  CHECK(shaft.torque_side() == -1);
  shaft.torque_position = 100;  // right at the face end
  CHECK(find_problems(shaft, kGearWidth).empty());
  CHECK(shaft.torque_side() == 1);
}

TEST_CASE("An impossible shaft is refused by the name of its field", "[core][compliance][shaft]") {
  struct Case {
    const char* field;
    void (*spoil)(ShaftData&);
  };
  const Case wrong = GENERATE(
      Case{"sections", [](ShaftData& s) { s.sections.clear(); }}, Case{"sections.1.length", [](ShaftData& s) { s.sections[1].length = 0; }},
      Case{"sections.0.outer_diameter", [](ShaftData& s) { s.sections[0].outer_diameter = not_given; }},
      Case{"sections.1.inner_diameter", [](ShaftData& s) { s.sections[1].inner_diameter = 50; }},
      Case{"bearings", [](ShaftData& s) { s.bearings.pop_back(); }}, Case{"bearings", [](ShaftData& s) { s.bearings[0].axial_stiffness = 0; }},
      Case{"bearings.1.position", [](ShaftData& s) { s.bearings[1].position = 161; }},
      Case{"bearings.1.position", [](ShaftData& s) { s.bearings[1].position = 10; }},
      Case{"bearings.1.name", [](ShaftData& s) { s.bearings[0].name = s.bearings[1].name = "left"; }},
      Case{"bearings.0.radial_stiffness", [](ShaftData& s) { s.bearings[0].radial_stiffness = 0; }},
      Case{"bearings.0.tilting_stiffness", [](ShaftData& s) { s.bearings[0].tilting_stiffness = -1; }},
      Case{"gear_position", [](ShaftData& s) { s.gear_position = 19, s.torque_position = 160; }},
      Case{"gear_position", [](ShaftData& s) { s.gear_position = 141; }}, Case{"torque_position", [](ShaftData& s) { s.torque_position = 90; }},
      Case{"torque_position", [](ShaftData& s) { s.torque_position = 161; }},
      Case{"torque_position", [](ShaftData& s) { s.torque_position = not_given; }},
      Case{"material.youngs_modulus", [](ShaftData& s) { s.material.youngs_modulus = 0; }});
  CAPTURE(wrong.field);
  ShaftData shaft = sound();
  wrong.spoil(shaft);
  const std::vector<InvalidInput> problems = find_problems(shaft, kGearWidth);
  REQUIRE(problems.size() == 1);
  CHECK(problems.front().field() == wrong.field);
}

TEST_CASE("One bearing is enough where it holds against tilting", "[core][compliance][shaft]") {
  ShaftData shaft = sound();
  shaft.bearings.pop_back();
  shaft.bearings[0].tilting_stiffness = 1e9;
  CHECK(find_problems(shaft, kGearWidth).empty());
}
