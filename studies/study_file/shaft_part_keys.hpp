#pragma once

#include <array>
#include <string>
#include <vector>

#include "studies/study_file/key_rows.hpp"

namespace flankwright::studies {

// What the shafts of the pair and those of a unit have in common.

/// Of places and bores on shafts [mm].
inline constexpr Range on_shaft = from_zero(10000.0);

/// The types of bearing that a study can name. Words and values of the key both follow from this list.
inline constexpr std::array bearing_types{BearingType::DeepGrooveBall, BearingType::AngularContactBall, BearingType::CylindricalRoller,
                                          BearingType::TaperedRoller};

/// Keys of a bearing's stiffness beyond a number for each direction: a matrix, or where it depends on the load a table, or the bearing's type and its
/// rolling elements.
/// @param list  "unit.joints[]", the table that the keys belong to
template <ShaftBearing& (*bearing)(StudyBuilder&, Member)>
std::vector<SchemaKey> bearing_law_rows(const std::string& list) {
  using enum ValueKind;
  std::vector<std::string> type_names;
  for (const BearingType type : bearing_types) type_names.push_back(name_of(type));
  // A row is read as a row:
  // clang-format off
  return {
      {.path = list + ".stiffness_matrix", .kind = NumberList, .range = within(1e15), .fallback = "(none: the stiffnesses one by one)",
       .meaning = "5 x 5, row by row: forces x, y, z and moments about x and y by displacements x, y, z and turns about x and y, in N, mm and rad; symmetric, zeros where it does not hold; instead of all other stiffnesses",
       .store = [](StudyBuilder& d, Member m, const Value& v) {
         constexpr Eigen::Index size = 5;
         Eigen::MatrixXd& stiffness = bearing(d, m).stiffness_matrix;
         stiffness = Eigen::Map<const Eigen::VectorXd>(v.numbers.data(), std::ssize(v.numbers));
         if (std::ssize(v.numbers) == size * size) stiffness.resize(size, size);
       }},
      {.path = list + ".force_table", .kind = NumberList, .quantity = Quantity::Force, .range = from_zero(1e9), .fallback = "(none: a constant stiffness)",
       .meaning = "radial forces, increasing, of which deflection_table has the deflections; linear between the points, from the origin on and beyond the last; instead of radial_stiffness",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).law.table_force = v.numbers; }},
      {.path = list + ".deflection_table", .kind = NumberList, .quantity = Quantity::Deviation, .range = from_zero(1e5), .fallback = "(none)",
       .meaning = "radial deflections under the forces of force_table, increasing; without the clearance",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).law.table_deflection = v.numbers; }},
      {.path = list + ".type", .kind = Word, .words = type_names, .fallback = "(none: a constant stiffness)",
       .meaning = "the bearing yields radially as Palmgren's formula for this type has it; instead of radial_stiffness",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).law.type = bearing_types[static_cast<std::size_t>(v.integer)]; }},
      {.path = list + ".elements", .kind = Integer, .range = {.low = 3, .high = 1000}, .fallback = "(none; a type needs it)", .meaning = "Z, balls or rollers of all rows",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).law.elements = static_cast<int>(v.integer); }},
      {.path = list + ".element_diameter", .quantity = Quantity::Length, .range = any_length, .fallback = "(none; a type of ball bearing needs it)", .meaning = "D, of the balls",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).law.element_diameter = v.number; }},
      {.path = list + ".element_length", .quantity = Quantity::Length, .range = any_length, .fallback = "(none; a type of roller bearing needs it)",
       .meaning = "l, of the rollers, effective",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).law.element_length = v.number; }},
      {.path = list + ".contact_angle", .quantity = Quantity::Angle, .range = from_zero(60.0),
       .fallback = "(0 of deep_groove_ball and cylindrical_roller; the other types need it)", .meaning = "alpha, against the plane across the shaft",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).law.contact_angle = v.number; }},
  };
  // clang-format on
}

/// What holds a shaft along its axis, as read_shafts() has it.
inline constexpr const char* held_by_first =
    "(0: slides; where nothing holds the shaft axially, neither a bearing nor one to another shaft, its first bearing without a stiffness_matrix is rigid)";

/// What is said of keys that are not given, where it depends on whose bearing it is.
struct BearingFallbacks {
  const char *axial, *name;
};

/// Keys of a bearing, but for where it is. @param list  as in bearing_law_rows()
template <ShaftBearing& (*bearing)(StudyBuilder&, Member)>
std::vector<SchemaKey> bearing_rows(const std::string& list, const BearingFallbacks& fallbacks) {
  // clang-format off
  std::vector<SchemaKey> rows{
      {.path = list + ".radial_stiffness", .quantity = Quantity::Stiffness, .range = above_zero(1e9), .fallback = "(rigid)",
       .meaning = "the same in every direction",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).radial_stiffness = v.number; }},
      {.path = list + ".axial_stiffness", .quantity = Quantity::Stiffness, .range = from_zero(1e9), .fallback = fallbacks.axial,
       .meaning = "along the shaft",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).axial_stiffness = v.number; }},
      {.path = list + ".tilting_stiffness", .quantity = Quantity::Torque, .range = from_zero(1e12), .fallback = "(0: swivels)",
       .meaning = "moment per rad",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).tilting_stiffness = v.number; }},
      {.path = list + ".radial_clearance", .quantity = Quantity::Deviation, .range = from_zero(10000.0), .fallback = "(0)",
       .meaning = "as catalogues have it: from one side to the other; the bearing is then linearised at each load case's equilibrium",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).radial_clearance = v.number; }},
      {.path = list + ".name", .kind = ValueKind::Text, .fallback = fallbacks.name, .meaning = "for results, and for unit.housing.seats",
       .store = [](StudyBuilder& d, Member m, const Value& v) { bearing(d, m).name = v.text; }},
  };
  // clang-format on
  const std::vector<SchemaKey> by_load = bearing_law_rows<bearing>(list);
  rows.insert(rows.end(), by_load.begin(), by_load.end());
  return rows;
}

/// Keys of a shaft's lengths. @param list  "unit.shafts[]", the table of the shaft
template <ShaftData& (*shaft)(StudyBuilder&, Member)>
std::vector<SchemaKey> shaft_section_rows(const std::string& list) {
  // clang-format off
  return {
      {.path = list + ".sections[].length", .quantity = Quantity::Length, .range = any_length, .fallback = "(required)", .meaning = "of constant section",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).sections.back().length = v.number; }},
      {.path = list + ".sections[].outer_diameter", .quantity = Quantity::Length, .range = any_length, .fallback = "(required)", .meaning = "d",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).sections.back().outer_diameter = v.number; }},
      {.path = list + ".sections[].inner_diameter", .quantity = Quantity::Length, .range = on_shaft, .fallback = "(0: solid)",
       .meaning = "of a hollow shaft; below the outer one",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).sections.back().inner_diameter = v.number; }},
  };
  // clang-format on
}

/// Keys of a shaft's material.
template <ShaftData& (*shaft)(StudyBuilder&, Member)>
std::vector<SchemaKey> shaft_material_rows(const std::string& list, const char* fallback) {
  // clang-format off
  return {
      {.path = list + ".material.youngs_modulus", .quantity = Quantity::Stress, .range = above_zero(1e7), .fallback = fallback, .meaning = "E of the shaft",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).material.youngs_modulus = v.number; }},
      {.path = list + ".material.poissons_ratio", .range = {.low = 0.0, .high = 0.5, .high_open = true}, .fallback = fallback, .meaning = "nu of the shaft",
       .store = [](StudyBuilder& d, Member m, const Value& v) { shaft(d, m).material.poissons_ratio = v.number; }},
  };
  // clang-format on
}

}  // namespace flankwright::studies
