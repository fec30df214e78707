#include "studies/study_file/given_units.hpp"

#include <array>

#include "studies/study_file/study_schema.hpp"

namespace flankwright::studies {

namespace {

/// Tables whose keys are keys of the study again, with their suffix: a step, a distribution, or nothing.
constexpr std::array<std::string_view, 2> tables_of_keys{"optimise.variables.", "sweep.parameters."};
constexpr std::array<std::string_view, 7> parts_with_unit{".range", ".step", ".normal", ".truncated_normal", ".uniform", ".values", ".grid"};

std::string_view unit_of(const KeyIndex& keys, const std::string& path) {
  const auto found = keys.find(path);
  if (found == keys.end() || found->second->quantity == Quantity::Number) return {};
  return default_unit(found->second->quantity);
}

}  // namespace

std::string_view unit_of_given(const GivenValue& given) {
  if (given.value.find_first_of("\"'") != std::string::npos) return {};
  std::string_view key = given.key;
  if (key.starts_with("scenes.")) {
    const std::size_t end = key.find('.', std::string_view("scenes.").size());
    return end == std::string_view::npos ? std::string_view{} : unit_of(scene_keys(), std::string(key.substr(end + 1)));
  }
  for (const std::string_view table : tables_of_keys) {
    if (!key.starts_with(table)) continue;
    key.remove_prefix(table.size());
    for (const std::string_view part : parts_with_unit) {
      // A grid is [low, high, levels] and a truncated distribution has bounds: all but the levels are in the unit of the key.
      if (key.ends_with(part)) {
        key.remove_suffix(part.size());
        break;
      }
    }
    break;
  }
  // Keys of a list's tables have its index in them: "load.spectrum.1.torque".
  for (std::size_t dot = key.find('.'); dot != std::string_view::npos; dot = key.find('.', dot + 1)) {
    const std::size_t end = key.find_first_not_of("0123456789", dot + 1);
    if (end == dot + 1 || end == std::string_view::npos || key[end] != '.') continue;
    return unit_of(element_keys(std::string(key.substr(0, dot))), std::string(key.substr(end + 1)));
  }
  return unit_of(study_keys(), std::string(key));
}

}  // namespace flankwright::studies
