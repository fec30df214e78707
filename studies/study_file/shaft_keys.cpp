#include <algorithm>

#include "studies/study_file/shaft_part_keys.hpp"
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

using enum ValueKind;

}  // namespace

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> shaft_rows() {
  std::vector<SchemaKey> rows{
      {.path = "gear.shaft.sections", .kind = TableList, .fallback = "(none: a rigid shaft)",
       .meaning = "lengths of the shaft that carries this gear, from its end of lowest z on; with a shaft, its bending, shear and torsion enter",
       .store = [](StudyBuilder& d, Member m, const Value&) { shaft(d, m).sections.emplace_back(); }},
      {.path = "gear.shaft.bearings", .kind = TableList, .fallback = "(none; a shaft needs it)",
       .meaning = "two or more, or one that holds against tilting",
       .store = [](StudyBuilder& d, Member m, const Value&) { shaft(d, m).bearings.emplace_back(); }},
      {.path = "gear.shaft.bearings[].position", .quantity = Quantity::Length, .range = on_shaft, .fallback = "(required)",
       .meaning = "from the shaft's end of lowest z",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).position = v.number; }},
      {.path = "gear.shaft.gear_position", .quantity = Quantity::Length, .range = on_shaft, .fallback = "(none; a shaft needs it)",
       .meaning = "of the gear's mid face, from the shaft's end of lowest z",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).gear_position = v.number; }},
      {.path = "gear.shaft.torque_position", .quantity = Quantity::Length, .range = on_shaft, .fallback = "(none; a shaft needs it, or a gear of unit.meshes)",
       .meaning = "where the torque enters or leaves and the shaft does not turn; not within the gear's face",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).torque_position = v.number; }},
      {.path = "gear.shaft.gear_stiffens", .kind = Word, .words = {"yes", "no"}, .fallback = "(\"yes\")",
       .meaning = "yes: the gear is one with the shaft, which is as thick as its root (bending: mean of tip and root) over the face",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).gear_stiffens = v.integer == 0; }},
  };
  const auto insert = [&](std::vector<SchemaKey>::const_iterator before, const std::vector<SchemaKey>& more) {
    rows.insert(before, more.begin(), more.end());
  };
  insert(std::ranges::find(rows, "gear.shaft.bearings", &SchemaKey::path), shaft_section_rows<shaft>("gear.shaft"));
  insert(std::ranges::find(rows, "gear.shaft.gear_position", &SchemaKey::path),
         bearing_rows<bearing>("gear.shaft.bearings[]", {.axial = held_by_first,
                                                         .name = "(the shaft and a number: \"pinion 1\")"}));
  insert(rows.end(), shaft_material_rows<shaft>("gear.shaft", "(as the gear's)"));
  return rows;
}

// clang-format on

}  // namespace flankwright::studies
