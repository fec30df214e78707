#include "studies/study_file/key_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace flankwright::studies {

namespace {

GivenGrid& grid(StudyBuilder& builder, Member m) { return builder.study.grid[m]; }
GivenGrid& opposite_grid(StudyBuilder& builder, Member m) { return builder.study.opposite_grid[m]; }
std::vector<std::string>& tooth_grids(StudyBuilder& builder, Member m) { return builder.study.tooth_grids[m]; }
ManufacturingError& error(Scene& scene, Member m) { return scene.error[m]; }

/// One number for all teeth, or one for each.
void store(const Value& v, double& of_all, std::vector<double>& of_each) {
  of_all = v.is_list ? 0.0 : v.numbers.front();
  of_each = v.is_list ? v.numbers : std::vector<double>{};
}

/// The key of a parameter, its range in the unit of its kind.
SchemaKey row_of(const ModificationDescriptor& d) {
  SchemaKey key{.path = "gear.modification." + std::string(d.key), .fallback = "0", .meaning = std::string(d.meaning), .store = d.parameter};
  switch (d.kind) {
    case ParameterKind::Amount:
      key.quantity = Quantity::Deviation;
      key.range = removal_range;
      break;
    case ParameterKind::Extent:
      key.quantity = Quantity::Length;
      key.range = from_zero(10000.0);  // mm; 0 is "not given"
      break;
    case ParameterKind::TeParabola:
      key.quantity = Quantity::ParabolicTe;
      key.range = from_zero(1000.0);
      break;
    case ParameterKind::Fraction:
      key.range = from_zero(1.0);
      break;
  }
  return key;
}

SchemaKey row_of(const ModificationChoice& c) {
  return {.path = "gear.modification." + std::string(c.key),
          .kind = ValueKind::Word,
          .words = {c.words.begin(), c.words.end()},
          .fallback = fmt::format("\"{}\"", c.words.front()),
          .meaning = std::string(c.meaning),
          .store = &c};
}

/// Every modification: its numbers, then its choices.
std::vector<SchemaKey> modification_rows() {
  std::vector<SchemaKey> rows;
  for_each_modification_key([&](const auto& key) { rows.push_back(row_of(key)); });
  return rows;
}

using enum ValueKind;

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> grid_and_error_rows() {
  return {
      {.path = "gear.modification.grid", .kind = Text, .fallback = "(none)",
       .meaning = "CSV file, beside the study unless its path says otherwise: measured or topological deviation, "
                  "columns radius_mm, z_mm, deviation_um (+ = metal added, normal to the flank)",
       .store = [](StudyBuilder& d, Member m, const Value& v) { grid(d, m).file = v.text; }},
      {.path = "gear.modification.grid_of_opposite_flank", .kind = Text, .fallback = "(none)",
       .meaning = "CSV file of the same form for the flank that pair.working_flank does not name, in the same z; used where a scene loads it",
       .store = [](StudyBuilder& d, Member m, const Value& v) { opposite_grid(d, m).file = v.text; }},
      {.path = "gear.modification.grid_smoothing.profile_pieces", .kind = Integer, .range = {.low = 1, .high = 1000},
       .fallback = "(through every point)",
       .meaning = "cubic pieces of the surface along the profile; the fewer, the smoother, fitted by least squares",
       .store = [](StudyBuilder& d, Member m, const Value& v) {
         grid(d, m).profile_pieces = opposite_grid(d, m).profile_pieces = static_cast<int>(v.integer);
       }},
      {.path = "gear.modification.grid_smoothing.face_pieces", .kind = Integer, .range = {.low = 1, .high = 1000},
       .fallback = "(through every point)", .meaning = "the same along the face",
       .store = [](StudyBuilder& d, Member m, const Value& v) {
         grid(d, m).face_pieces = opposite_grid(d, m).face_pieces = static_cast<int>(v.integer);
       }},

      {.path = "gear.error.helix_slope", .kind = NumberOrList, .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "f_Hbeta over the face width, metal added; + adds at z = +b/2, zero at mid face; a list: of each tooth",
       .store = [](Scene& s, Member m, const Value& v) { store(v, error(s, m).helix_slope, error(s, m).helix_slopes); }},
      {.path = "gear.error.profile_slope", .kind = NumberOrList, .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "f_Halpha, metal added; + adds at the tip, zero at the reference circle; a list: of each tooth",
       .store = [](Scene& s, Member m, const Value& v) { store(v, error(s, m).profile_slope, error(s, m).profile_slopes); }},
      {.path = "gear.error.pitch", .kind = NumberOrList, .quantity = Quantity::Deviation, .range = removal_range,
       .fallback = "0",
       .meaning = "adjacent pitch error, adds up from tooth to tooth; a list: cumulative deviation of each tooth",
       .store = [](Scene& s, Member m, const Value& v) {
         store(v, error(s, m).pitch_step, error(s, m).cumulative_pitch);
       }},
      {.path = "gear.error.grids", .kind = TextList, .fallback = "(none)",
       .meaning = "CSV files as modification.grid, one for each tooth, \"\" for none; on top of all else",
       .store = [](StudyBuilder& d, Member m, const Value& v) { tooth_grids(d, m) = v.words; }},
      {.path = "gear.error.twist", .kind = NumberOrList, .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "added twist * (y / h_active) * (z / b); + adds at the tip at z = +b/2; a list: of each tooth",
       .store = [](Scene& s, Member m, const Value& v) { store(v, error(s, m).twist, error(s, m).twists); }},
  };
}

// clang-format on

}  // namespace

std::vector<SchemaKey> flank_rows() {
  std::vector<SchemaKey> rows = modification_rows();
  std::ranges::move(grid_and_error_rows(), std::back_inserter(rows));
  return rows;
}

}  // namespace flankwright::studies
