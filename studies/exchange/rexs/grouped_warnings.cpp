#include "studies/exchange/rexs/grouped_warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <optional>

namespace flankwright::studies::rexs {

namespace {

/// "concept_bearing 27: no radial_stiffness" in its parts.
struct OfComponent {
  std::string type, id, what;
};

/// Nothing where a text does not begin with a type of letters and a number.
std::optional<OfComponent> parted(const std::string& warning) {
  const std::size_t colon = warning.find(": ");
  if (colon == std::string::npos) return std::nullopt;
  const std::size_t space = warning.rfind(' ', colon);
  if (space == std::string::npos || space + 1 >= colon) return std::nullopt;
  OfComponent of{warning.substr(0, space), warning.substr(space + 1, colon - space - 1), warning.substr(colon + 2)};
  const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0 || c == '_' || c == ' '; };
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  if (!std::ranges::all_of(of.type, is_letter) || !std::ranges::all_of(of.id, is_digit)) return std::nullopt;
  return of;
}

/// Components that have the same said of them, by their types.
struct Group {
  std::string what;
  std::vector<std::pair<std::string, std::vector<std::string>>> ids_by_type;
  std::string whole;  ///< of a text without a component

  void add(const OfComponent& of) {
    auto type = std::ranges::find(ids_by_type, of.type, [](const auto& entry) { return entry.first; });
    if (type == ids_by_type.end()) type = ids_by_type.insert(ids_by_type.end(), {of.type, {}});
    type->second.push_back(of.id);
  }
  std::string text() const {
    if (ids_by_type.empty()) return whole;
    std::vector<std::string> names;
    for (const auto& [type, ids] : ids_by_type) names.push_back(fmt::format("{} {}", type, fmt::join(ids, ", ")));
    return fmt::format("{}: {}", fmt::join(names, ", "), what);
  }
};

}  // namespace

std::vector<std::string> grouped_by_component(const std::vector<std::string>& warnings) {
  std::vector<Group> groups;
  for (const std::string& warning : warnings) {
    const std::optional<OfComponent> of = parted(warning);
    if (!of) {
      groups.push_back({.what = {}, .ids_by_type = {}, .whole = warning});
      continue;
    }
    auto group = std::ranges::find_if(groups, [&](const Group& g) { return !g.ids_by_type.empty() && g.what == of->what; });
    if (group == groups.end()) group = groups.insert(groups.end(), {.what = of->what, .ids_by_type = {}, .whole = {}});
    group->add(*of);
  }
  std::vector<std::string> texts;
  for (const Group& group : groups) texts.push_back(group.text());
  return texts;
}

std::vector<std::string> grouped_by_stage(const std::vector<StageWarnings>& stages) {
  std::vector<std::pair<std::string, std::vector<int>>> numbers_by_text;
  for (const StageWarnings& stage : stages) {
    for (const std::string& warning : stage.warnings) {
      auto known = std::ranges::find(numbers_by_text, warning, [](const auto& entry) { return entry.first; });
      if (known == numbers_by_text.end()) known = numbers_by_text.insert(numbers_by_text.end(), {warning, {}});
      known->second.push_back(stage.number);
    }
  }
  std::vector<std::string> texts;
  for (const auto& [text, numbers] : numbers_by_text) {
    const bool of_all = stages.size() > 1 && numbers.size() == stages.size();
    texts.push_back(of_all ? text : fmt::format("stage {}: {}", fmt::join(numbers, ", "), text));
  }
  return texts;
}

}  // namespace flankwright::studies::rexs
