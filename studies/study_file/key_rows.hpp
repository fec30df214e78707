#pragma once

#include <vector>

#include "studies/study_file/study_schema.hpp"

/// Helpers for the parts of the table of keys. One row describes a key completely; a row "gear.x" represents "pinion.x" and "wheel.x".
namespace flankwright::studies {

std::vector<SchemaKey> geometry_rows();           ///< title, task, pair, gears and how they are generated
std::vector<SchemaKey> flank_rows();              ///< modifications and manufacturing errors
std::vector<SchemaKey> working_condition_rows();  ///< misalignment, material, load and how it is analysed
std::vector<SchemaKey> life_rows();               ///< load spectrum, strength of materials and lubricant
std::vector<SchemaKey> body_rows();               ///< gears below their teeth
std::vector<SchemaKey> shaft_rows();              ///< shafts and their bearings
std::vector<SchemaKey> unit_rows();               ///< the gear unit around the pair
std::vector<SchemaKey> scene_rows();              ///< scenes and expectations

constexpr Range above_zero(double high) { return {.low = 0.0, .high = high, .low_open = true}; }
constexpr Range from_zero(double high) { return {.low = 0.0, .high = high}; }
constexpr Range within(double magnitude) { return {.low = -magnitude, .high = magnitude}; }

inline constexpr Range removal_range = within(1000.0);                // um: beyond a millimetre it is no micro-geometry
inline constexpr Range any_length = {.low = 0.001, .high = 10000.0};  // mm: from watches to girth gears

}  // namespace flankwright::studies
