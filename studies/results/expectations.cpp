#include "studies/results/expectations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "studies/base/json_format.hpp"
#include "studies/study_file/study_schema.hpp"

namespace flankwright::studies {

namespace {

std::string in_words(const Expectation& e) {
  if (!e.is.empty()) return e.is;
  std::string words;
  if (!std::isnan(e.value)) {
    words = fmt::format("{:.6g}", e.value);
    if (!std::isnan(e.within_relative)) words += fmt::format(" within {:.3g} %", 100.0 * e.within_relative);
    if (!std::isnan(e.within_absolute)) words += fmt::format(" within {:.3g}", e.within_absolute);
  }
  if (std::isfinite(e.minimum)) words += fmt::format("{}at least {:.6g}", words.empty() ? "" : ", ", e.minimum);
  if (std::isfinite(e.maximum)) words += fmt::format("{}at most {:.6g}", words.empty() ? "" : ", ", e.maximum);
  return words;
}

bool is_met(const Expectation& e, double found) {
  if (!std::isfinite(found) || found < e.minimum || found > e.maximum) return false;
  if (std::isnan(e.value)) return true;
  double allowed = 0.0;
  if (!std::isnan(e.within_relative)) allowed = std::max(allowed, e.within_relative * std::abs(e.value));
  if (!std::isnan(e.within_absolute)) allowed = std::max(allowed, e.within_absolute);
  return std::abs(found - e.value) <= allowed;
}

/// "te_harmonics_um.1" for "te_harmonic_2_um" where the object has such a list: tables of columns name each entry, results list them.
std::string entry_of_list(const Json& object, const std::string& name) {
  const std::size_t from = name.find_first_of("0123456789");
  if (from == std::string::npos || from == 0 || name[from - 1] != '_') return {};
  const std::size_t to = std::min(name.find_first_not_of("0123456789", from), name.size());
  const std::string list = name.substr(0, from - 1) + "s" + name.substr(to);
  const auto found = object.find(list);
  if (found == object.end() || !found->is_array() || to - from > 4) return {};
  const std::size_t number = std::stoul(name.substr(from, to - from));
  return number >= 1 && number <= found->size() ? fmt::format("{}.{}", list, number - 1) : std::string();
}

/// Paths to a name anywhere below a node, without the indices of lists.
void find_name(const Json& node, const std::string& above, const std::string& name, std::set<std::string>& found) {
  if (node.is_array()) {
    for (const Json& entry : node) find_name(entry, above, name, found);
  }
  if (!node.is_object()) return;
  for (const auto& [key, value] : node.items()) {
    const std::string path = above.empty() ? key : above + "." + key;
    if (key == name) found.insert(path);
    if (value.is_structured()) find_name(value, path, name, found);
  }
}

/// A path as [expect] has it, for every entry of a list: "loaded.summary" for "loaded[0].summary".
std::string for_every_entry(const std::string& path) {
  std::string without;
  bool inside = false;
  for (const char c : path) {
    if (c == '[') inside = true;
    if (!inside) without += c;
    if (c == ']') inside = false;
  }
  return without;
}

/// Whether a dotted path leads to something below a node, in some entry of its lists.
bool leads_somewhere(const Json& node, const std::string& path) {
  if (path.empty()) return true;
  if (node.is_array()) return std::ranges::any_of(node, [&](const Json& entry) { return leads_somewhere(entry, path); });
  const std::size_t dot = path.find('.');
  const auto found = node.is_object() ? node.find(path.substr(0, dot)) : node.end();
  return node.is_object() && found != node.end() && leads_somewhere(*found, dot == std::string::npos ? "" : path.substr(dot + 1));
}

/// What was meant by a name that the object at `path` does not have; `rest` followed it.
std::string hint_at(const Json& results, const Json& object, const std::string& path, const std::string& step, const std::string& rest) {
  const std::string above = path.empty() ? "" : for_every_entry(path) + ".", behind = rest.empty() ? "" : "." + rest;
  if (const std::string entry = entry_of_list(object, step); !entry.empty()) return above + entry + behind;
  std::vector<std::string> siblings;
  for (const auto& [key, value] : object.items()) siblings.push_back(key);
  const std::string near = nearest_word(step, siblings);
  if (!near.empty() && leads_somewhere(object, near + behind)) return above + near + behind;
  const std::string name = rest.empty() ? step : rest.substr(rest.rfind('.') + 1);
  std::set<std::string> elsewhere;
  find_name(results, "", name, elsewhere);
  const auto depth = [](const std::string& p) { return std::ranges::count(p, '.'); };
  const auto least = std::ranges::min_element(elsewhere, {}, depth);
  return least == elsewhere.end() ? std::string() : *least;
}

/// Follows the rest of a dotted path from a node; adds a comparison for every leaf it reaches.
void follow(const Json& results, const Json* node, const std::string& path, const std::string& rest, const Expectation& e,
            std::vector<Comparison>& found) {
  if (node && rest.empty() && (node->is_string() || node->is_boolean())) {
    const std::string text = node->is_string() ? node->get<std::string>() : node->dump();
    found.push_back({path, in_words(e), not_given, text, !e.is.empty() && text == e.is, {}});
    return;
  }
  if (node && rest.empty() && node->is_array()) {
    for (std::size_t i = 0; i < node->size(); ++i) follow(results, &(*node)[i], path + "[" + std::to_string(i) + "]", rest, e, found);
    if (!node->empty()) return;
  }
  if (!node || (rest.empty() && !node->is_number())) {
    found.push_back({path + (rest.empty() ? "" : "." + rest), in_words(e), not_given, {}, false, {}});
    return;
  }
  if (rest.empty()) {
    const double value = node->get<double>();
    found.push_back({path, in_words(e), value, {}, e.is.empty() && is_met(e, value), {}});
    return;
  }
  const std::size_t dot = rest.find('.');
  const std::string step = rest.substr(0, dot), after = dot == std::string::npos ? "" : rest.substr(dot + 1);
  const std::string name = path.empty() ? step : path + "." + step;
  if (node->is_array()) {
    const bool is_index = !step.empty() && step.find_first_not_of("0123456789") == std::string::npos && step.size() < 9;
    if (is_index) {
      const std::size_t index = std::stoul(step);
      return follow(results, index < node->size() ? &(*node)[index] : nullptr, path + "[" + step + "]", after, e, found);
    }
    if (node->empty()) return follow(results, nullptr, path, rest, e, found);
    for (std::size_t i = 0; i < node->size(); ++i) follow(results, &(*node)[i], path + "[" + std::to_string(i) + "]", rest, e, found);
    return;
  }
  const bool known = node->is_object() && node->contains(step);
  follow(results, known ? &(*node)[step] : nullptr, name, after, e, found);
  if (!known && node->is_object()) found.back().hint = hint_at(results, *node, path, step, after);
}

}  // namespace

std::vector<Comparison> compare(const std::vector<Expectation>& expectations, const Json& results) {
  std::vector<Comparison> comparisons;
  for (const Expectation& e : expectations) follow(results, &results, "", e.key, e, comparisons);
  return comparisons;
}

std::string differences(const std::vector<Comparison>& comparisons) {
  std::string table;
  for (const Comparison& c : comparisons) {
    if (c.met) continue;
    const std::string number = std::isnan(c.found) ? std::string("nothing") : fmt::format("{:.6g}", c.found);
    const std::string hint = c.hint.empty() ? "" : fmt::format("; did you mean {}?", c.hint);
    table += fmt::format("  {}: expected {}, found {}{}\n", c.key, c.expected, c.found_text.empty() ? number : c.found_text, hint);
  }
  return table;
}

}  // namespace flankwright::studies
