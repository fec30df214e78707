#include "studies/study_file/grid_header.hpp"

#include <algorithm>
#include <array>

#include "core/base/units.hpp"

namespace flankwright::studies {

namespace {

struct Name {
  std::string_view name;
  GridQuantity quantity;
  double sense;  ///< of a number: half a diameter is a radius, what is removed is not added
};

using enum GridQuantity;
constexpr std::array<Name, 19> names{{{"radius", Radius, 1.0},
                                      {"r", Radius, 1.0},
                                      {"diameter", Radius, 0.5},
                                      {"d", Radius, 0.5},
                                      {"durchmesser", Radius, 0.5},
                                      {"z", Z, 1.0},
                                      {"face", Z, 1.0},
                                      {"facewidth", Z, 1.0},
                                      {"width", Z, 1.0},
                                      {"axial", Z, 1.0},
                                      {"breite", Z, 1.0},
                                      {"zahnbreite", Z, 1.0},
                                      {"deviation", Deviation, 1.0},
                                      {"dev", Deviation, 1.0},
                                      {"abweichung", Deviation, 1.0},
                                      {"removal", Deviation, -1.0},
                                      {"removed", Deviation, -1.0},
                                      {"abtrag", Deviation, -1.0},
                                      {"error", Deviation, 1.0}}};

struct UnitName {
  std::string_view name;
  double size;  ///< [mm]
};
constexpr std::array<UnitName, 7> unit_names{{{"mm", 1.0},
                                              {"um", units::um},
                                              {"mum", units::um},
                                              {"\xc2\xb5m", units::um},
                                              {"\xce\xbcm", units::um},
                                              {"in", units::inch},
                                              {"mil", 1e-3 * units::inch}}};

/// In small letters, without quotes, blanks, brackets and what joins name and unit.
std::string bare(std::string_view cell) {
  std::string text;
  for (const char c : cell) {
    if (std::string_view(" \t\"'_/[](){}-.").find(c) != std::string_view::npos) continue;
    text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return text;
}

}  // namespace

std::optional<double> grid_unit(std::string_view cell) {
  const auto found = std::ranges::find(unit_names, bare(cell), &UnitName::name);
  return found == unit_names.end() ? std::nullopt : std::optional(found->size);
}

std::optional<GridColumn> grid_column(std::string_view cell) {
  const std::string text = bare(cell);
  for (const Name& known : names) {
    if (!text.starts_with(known.name)) continue;
    const std::string unit = text.substr(known.name.size());
    if (unit.empty()) return GridColumn{known.quantity, known.sense * (known.quantity == Deviation ? units::um : 1.0), false};
    if (const auto size = grid_unit(unit)) return GridColumn{known.quantity, known.sense * *size, true};
  }
  return std::nullopt;
}

}  // namespace flankwright::studies
