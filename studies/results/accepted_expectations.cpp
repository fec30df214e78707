#include "studies/results/accepted_expectations.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "studies/results/expectations.hpp"
#include "studies/study_file/byte_of_column.hpp"

namespace flankwright::studies {

namespace {

/// Where the values of [expect] stand, by the key of their expectation.
void find_values(const toml::table& table, const std::string& above, std::map<std::string, toml::source_region>& found) {
  for (const auto& [name, node] : table) {
    const toml::table* inside = node.as_table();
    const std::string path = above + std::string(name.str());
    if (inside == nullptr) continue;
    const toml::node* value = inside->contains("is") ? inside->get("is") : inside->get("value");
    if (value != nullptr && !value->is_table()) {
      found[path] = value->source();
    } else {
      find_values(*inside, path + ".", found);
    }
  }
}

std::size_t byte_at(std::string_view text, const toml::source_position& at) {
  std::size_t begin = 0;  // of the line
  for (std::size_t line = 1; line < at.line; ++line) begin = text.find('\n', begin) + 1;
  return begin + byte_of_column(text.substr(begin), at.column);
}

/// What was found as the file would have it; nothing where no one value stands for all that was found.
std::optional<std::string> found_value(const Expectation& expectation, const std::vector<Comparison>& found) {
  if (!expectation.is.empty()) {
    const std::string& text = found.front().found_text;
    const bool is_one = !text.empty() && std::ranges::all_of(found, [&](const Comparison& c) { return c.found_text == text; });
    if (!is_one) return std::nullopt;
    return text == "true" || text == "false" ? text : Json(text).dump();
  }
  const auto is_number = [](const Comparison& c) { return std::isfinite(c.found); };
  if (std::isnan(expectation.value) || !std::ranges::all_of(found, is_number)) return std::nullopt;
  const auto [least, largest] = std::ranges::minmax(found, {}, &Comparison::found);
  const double middle = 0.5 * (least.found + largest.found);
  if (middle == 0.0 && !std::isnan(expectation.within_relative)) return std::nullopt;  // no percentage of 0
  return fmt::format("{:.10g}", middle);
}

}  // namespace

AcceptedStudy accept_results(const std::string& text, const std::vector<Expectation>& expectations, const Json& results) {
  AcceptedStudy accepted{text, 0, {}};
  const toml::table document = toml::parse(text);
  std::map<std::string, toml::source_region> places;
  if (const toml::table* expect = document["expect"].as_table()) find_values(*expect, "", places);
  std::map<std::size_t, std::pair<std::size_t, std::string>> by_byte;  // first byte: end, new text
  for (const Expectation& expectation : expectations) {
    const std::vector<Comparison> before = compare({expectation}, results);
    const auto place = places.find(expectation.key);
    const auto value = place == places.end() ? std::nullopt : found_value(expectation, before);
    Expectation now = expectation;
    if (value && expectation.is.empty()) now.value = std::stod(*value);
    if (value && !expectation.is.empty()) now.is = before.front().found_text;
    const std::vector<Comparison> after = compare({now}, results);
    if (const std::string unmet = differences(after); !unmet.empty()) {
      accepted.kept.push_back(unmet);
    } else if (value) {
      by_byte[byte_at(text, place->second.begin)] = {byte_at(text, place->second.end), *value};
    }
  }
  for (auto change = by_byte.rbegin(); change != by_byte.rend(); ++change) {
    accepted.text.replace(change->first, change->second.first - change->first, change->second.second);
    ++accepted.values;
  }
  return accepted;
}

}  // namespace flankwright::studies
