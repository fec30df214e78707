#include <algorithm>

#include "studies/study_file/bearing_keys.hpp"
#include "studies/study_file/key_rows.hpp"

namespace flankwright::studies {

namespace {

/// The gear's shaft, made by the first of its keys; its material is unknown until the keys of materials say.
ShaftData& shaft(StudyBuilder& builder, Member m) {
  std::optional<ShaftData>& of_gear = builder.study.shaft[m];
  if (!of_gear) of_gear = ShaftData{.material = {not_given, not_given}};
  return *of_gear;
}

ShaftBearing& bearing(StudyBuilder& builder, Member m) { return shaft(builder, m).bearings.back(); }

constexpr Range on_shaft = from_zero(10000.0);  // mm

using enum ValueKind;

}  // namespace

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> shaft_rows() {
  std::vector<SchemaKey> rows{
      {.path = "gear.shaft.sections", .kind = TableList, .fallback = "(none: a rigid shaft)",
       .meaning = "lengths of the shaft that carries this gear, from its end of lowest z on; with a shaft, its bending, shear and torsion enter",
       .store = [](StudyBuilder& d, Member m, const Value&) { shaft(d, m).sections.emplace_back(); }},
      {.path = "gear.shaft.sections[].length", .quantity = Quantity::Length, .range = any_length, .fallback = "(required)",
       .meaning = "of constant section",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).sections.back().length = v.number; }},
      {.path = "gear.shaft.sections[].outer_diameter", .quantity = Quantity::Length, .range = any_length, .fallback = "(required)",
       .meaning = "d",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).sections.back().outer_diameter = v.number; }},
      {.path = "gear.shaft.sections[].inner_diameter", .quantity = Quantity::Length, .range = on_shaft, .fallback = "(0: solid)",
       .meaning = "of a hollow shaft; below the outer one",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).sections.back().inner_diameter = v.number; }},
      {.path = "gear.shaft.bearings", .kind = TableList, .fallback = "(none; a shaft needs it)",
       .meaning = "two or more, or one that holds against tilting",
       .store = [](StudyBuilder& d, Member m, const Value&) { shaft(d, m).bearings.emplace_back(); }},
      {.path = "gear.shaft.bearings[].position", .quantity = Quantity::Length, .range = on_shaft, .fallback = "(required)",
       .meaning = "from the shaft's end of lowest z",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).position = v.number; }},
      {.path = "gear.shaft.bearings[].radial_stiffness", .quantity = Quantity::Stiffness, .range = above_zero(1e9),
       .fallback = "(rigid)", .meaning = "the same in every direction",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).radial_stiffness = v.number; }},
      {.path = "gear.shaft.bearings[].axial_stiffness", .quantity = Quantity::Stiffness, .range = from_zero(1e9),
       .fallback = "(0: slides; where none is given, the first bearing is rigid)", .meaning = "along the shaft",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).axial_stiffness = v.number; }},
      {.path = "gear.shaft.bearings[].tilting_stiffness", .quantity = Quantity::Torque, .range = from_zero(1e12),
       .fallback = "(0: swivels)", .meaning = "moment per rad",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).tilting_stiffness = v.number; }},
      {.path = "gear.shaft.bearings[].radial_clearance", .quantity = Quantity::Deviation, .range = from_zero(10000.0), .fallback = "(0)",
       .meaning = "as catalogues have it: from one side to the other; the bearing is then linearised at each load case's equilibrium",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).radial_clearance = v.number; }},
      {.path = "gear.shaft.bearings[].name", .kind = Text, .fallback = "(the shaft and a number: \"pinion 1\")",
       .meaning = "for results, and for unit.housing.seats",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).name = v.text; }},
      {.path = "gear.shaft.gear_position", .quantity = Quantity::Length, .range = on_shaft, .fallback = "(none; a shaft needs it)",
       .meaning = "of the gear's mid face, from the shaft's end of lowest z",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).gear_position = v.number; }},
      {.path = "gear.shaft.torque_position", .quantity = Quantity::Length, .range = on_shaft, .fallback = "(none; a shaft needs it, or a gear of unit.meshes)",
       .meaning = "where the torque enters or leaves and the shaft does not turn; not within the gear's face",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).torque_position = v.number; }},
      {.path = "gear.shaft.gear_stiffens", .kind = Word, .words = {"yes", "no"}, .fallback = "(\"yes\")",
       .meaning = "yes: the gear is one with the shaft, which is as thick as its root (bending: mean of tip and root) over the face",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).gear_stiffens = v.integer == 0; }},
      {.path = "gear.shaft.material.youngs_modulus", .quantity = Quantity::Stress, .range = above_zero(1e7),
       .fallback = "(as the gear's)", .meaning = "E of the shaft",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).material.youngs_modulus = v.number; }},
      {.path = "gear.shaft.material.poissons_ratio", .range = {.low = 0.0, .high = 0.5, .high_open = true},
       .fallback = "(as the gear's)", .meaning = "nu of the shaft",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).material.poissons_ratio = v.number; }},
  };
  const std::vector<SchemaKey> by_load = bearing_law_rows<bearing>("gear.shaft.bearings[]");
  rows.insert(std::ranges::find(rows, "gear.shaft.gear_position", &SchemaKey::path), by_load.begin(), by_load.end());
  return rows;
}

// clang-format on

}  // namespace flankwright::studies
