#include "studies/study_file/study_schema.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <set>

namespace flankwright::studies {

namespace {

constexpr std::string_view scene_prefix = "scenes[].";

std::string number_text(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.10g", value);
  return buffer.data();
}

/// Letters to insert, delete or replace to get from one word to the other (Levenshtein).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

std::string parent_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot + 1);
}

KeyIndex make_study_keys() {
  KeyIndex keys;
  for (const SchemaKey& key : study_schema()) {
    if (key.path.find("[].") == std::string::npos) keys.emplace(key.path, &key);
  }
  return keys;
}

KeyIndex make_scene_keys() {
  KeyIndex keys;
  for (const SchemaKey& key : study_schema()) {
    if (!std::holds_alternative<StoreInScene>(key.store)) continue;
    const bool own = key.path.starts_with(scene_prefix);
    keys.emplace(own ? key.path.substr(scene_prefix.size()) : key.path, &key);
  }
  return keys;
}

}  // namespace

const KeyIndex& study_keys() {
  static const KeyIndex keys = make_study_keys();
  return keys;
}

const KeyIndex& scene_keys() {
  static const KeyIndex keys = make_scene_keys();
  return keys;
}

KeyIndex element_keys(const std::string& list) {
  const std::string prefix = list + "[].";
  KeyIndex keys;
  for (const SchemaKey& key : study_schema()) {
    const bool in_list_below = key.path.find("[].", prefix.size()) != std::string::npos;  // a key of a table of a list in these tables
    if (key.path.starts_with(prefix) && !in_list_below) keys.emplace(key.path.substr(prefix.size()), &key);
  }
  return keys;
}

bool is_table(const KeyIndex& keys, const std::string& path) {
  const auto next = keys.lower_bound(path + ".");
  return next != keys.end() && next->first.starts_with(path + ".");
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& words) {
  // A third of the letters may be wrong, and two always; longer words than any key are not worth the comparison.
  constexpr std::size_t longest = 100;
  if (word.empty() || word.size() > longest) return "";
  std::size_t nearest = std::max<std::size_t>(2, word.size() / 3) + 1;
  std::string found;
  for (const std::string& candidate : words) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < nearest && distance < candidate.size()) {
      nearest = distance;
      found = candidate;
    }
  }
  return found;
}

std::string nearest_key_hint(const KeyIndex& keys, const std::string& path) {
  const auto below = std::ranges::find_if(keys, [&](const auto& key) { return key.first.starts_with(path + "."); });
  if (below != keys.end()) return ", a table: did you mean " + below->first + "?";
  const std::string parent = parent_of(path);
  const std::string last = path.substr(parent.size());
  std::vector<std::string> siblings;
  for (const auto& [name, key] : keys) {
    if (name.starts_with(parent)) siblings.push_back(name.substr(parent.size(), name.find('.', parent.size()) - parent.size()));
  }
  const std::string sibling = nearest_word(last, siblings);
  if (!sibling.empty()) return ", did you mean " + sibling + "?";
  std::set<std::string> longer;  // of which the word is one end: module, normal_module
  for (const std::string& name : siblings) {
    if (name.starts_with(last + "_") || name.ends_with("_" + last)) longer.insert(name);
  }
  if (longer.size() == 1) return ", did you mean " + *longer.begin() + "?";
  std::string namesake;  // the one that lies least deep
  for (const auto& [name, key] : keys) {
    const bool is_namesake = name == last || name.ends_with("." + last);
    if (is_namesake && (namesake.empty() || std::ranges::count(name, '.') < std::ranges::count(namesake, '.'))) namesake = name;
  }
  return namesake.empty() ? "" : ", did you mean " + namesake + "?";
}

bool is_described_fallback(const SchemaKey& key) { return key.fallback.starts_with('('); }

bool is_required(const SchemaKey& key) { return key.fallback.starts_with("(required"); }

std::string quoted_list(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "\"" : ", \"") + word + "\"";
  return list;
}

std::string range_in_words(const Range& range, Quantity quantity) {
  const bool has_low = std::isfinite(range.low);
  const bool has_high = std::isfinite(range.high);
  const std::string low = number_text(range.low);
  const std::string high = number_text(range.high);
  std::string words;
  if (has_low && has_high && !range.low_open && !range.high_open) {
    words.append(" ").append(low).append(" .. ").append(high);
  } else {
    if (has_low) words += (range.low_open ? " above " : " of at least ") + low;
    if (has_low && has_high) words += " and";
    if (has_high) words += (range.high_open ? " below " : " at most ") + high;
  }
  if (quantity != Quantity::Number) words.append(" ").append(default_unit(quantity));
  return words;
}

std::string allowed_values(const SchemaKey& key) {
  const std::string range = range_in_words(key.range, key.quantity);
  switch (key.kind) {
    case ValueKind::Number:
      return "a number" + range;
    case ValueKind::NumberOrList:
      return "a number" + range + ", or a list of them";
    case ValueKind::NumberList:
      return "a list of numbers" + range;
    case ValueKind::Integer:
      return "an integer" + range;
    case ValueKind::Percentage:
      return "a percentage" + range + ", such as \"1 %\"";
    case ValueKind::IntegerOrAuto:
      return "an integer" + range + ", or \"auto\"";
    case ValueKind::NumberOrNone:
      return "a number" + range + ", or \"none\"";
    case ValueKind::Text:
      return "a text";
    case ValueKind::TextList:
      return "a list of texts";
    case ValueKind::Word:
      return quoted_list(key.words);
    case ValueKind::WordOrTable:
      return quoted_list(key.words) + ", or a table of the keys below it";
    case ValueKind::WordList:
      return "\"auto\", or a list of " + quoted_list(key.words);
    case ValueKind::TableList:
      return "a list of tables of the keys below it, at least one";
    case ValueKind::TableListOrFile:
      return "a list of tables of the keys below it, at least one, { file = \"x.csv\" } or { signal = \"x.csv\" }";
    case ValueKind::Free:
      return key.allowed;
  }
  return "";
}

}  // namespace flankwright::studies
