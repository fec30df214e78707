#include "studies/results/expectations.hpp"

#include <fmt/format.h>

#include <cmath>

#include "studies/base/json_format.hpp"

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

/// Follows the rest of a dotted path from a node; adds a comparison for every leaf it reaches.
void follow(const Json* node, const std::string& path, const std::string& rest, const Expectation& e, std::vector<Comparison>& found) {
  if (node && rest.empty() && (node->is_string() || node->is_boolean())) {
    const std::string text = node->is_string() ? node->get<std::string>() : node->dump();
    found.push_back({path, in_words(e), not_given, text, !e.is.empty() && text == e.is});
    return;
  }
  if (!node || (rest.empty() && !node->is_number())) {
    found.push_back({path + (rest.empty() ? "" : "." + rest), in_words(e), not_given, {}, false});
    return;
  }
  if (rest.empty()) {
    const double value = node->get<double>();
    found.push_back({path, in_words(e), value, {}, e.is.empty() && is_met(e, value)});
    return;
  }
  const std::size_t dot = rest.find('.');
  const std::string step = rest.substr(0, dot), after = dot == std::string::npos ? "" : rest.substr(dot + 1);
  const std::string name = path.empty() ? step : path + "." + step;
  if (node->is_array()) {
    const bool is_index = !step.empty() && step.find_first_not_of("0123456789") == std::string::npos && step.size() < 9;
    if (is_index) {
      const std::size_t index = std::stoul(step);
      return follow(index < node->size() ? &(*node)[index] : nullptr, path + "[" + step + "]", after, e, found);
    }
    if (node->empty()) return follow(nullptr, path, rest, e, found);
    for (std::size_t i = 0; i < node->size(); ++i) follow(&(*node)[i], path + "[" + std::to_string(i) + "]", rest, e, found);
    return;
  }
  const bool known = node->is_object() && node->contains(step);
  follow(known ? &(*node)[step] : nullptr, name, after, e, found);
}

}  // namespace

std::vector<Comparison> compare(const std::vector<Expectation>& expectations, const Json& results) {
  std::vector<Comparison> comparisons;
  for (const Expectation& e : expectations) follow(&results, "", e.key, e, comparisons);
  return comparisons;
}

std::string differences(const std::vector<Comparison>& comparisons) {
  std::string table;
  for (const Comparison& c : comparisons) {
    if (c.met) continue;
    const std::string number = std::isnan(c.found) ? std::string("nothing") : fmt::format("{:.6g}", c.found);
    table += fmt::format("  {}: expected {}, found {}\n", c.key, c.expected, c.found_text.empty() ? number : c.found_text);
  }
  return table;
}

}  // namespace flankwright::studies
