#include "studies/results/gathered.hpp"

#include <fmt/format.h>

#include "studies/results/expectations.hpp"

namespace flankwright::studies {

namespace {

/// @param found  becomes true where the path leads anywhere
Json follow(const Json& node, std::string_view rest, bool& found) {
  if (rest.empty()) {
    found = true;
    return node;
  }
  const std::size_t dot = rest.find('.');
  const std::string step(rest.substr(0, dot));
  const std::string_view after = dot == std::string_view::npos ? std::string_view{} : rest.substr(dot + 1);
  if (node.is_array()) {
    constexpr std::size_t longest_index = 9;
    if (!step.empty() && step.size() < longest_index && step.find_first_not_of("0123456789") == std::string::npos) {
      const std::size_t index = std::stoul(step);
      return index < node.size() ? follow(node[index], after, found) : Json();
    }
    Json all = Json::array();
    for (const Json& entry : node) all.push_back(follow(entry, rest, found));
    return all;
  }
  const auto member = node.is_object() ? node.find(step) : node.end();
  // A name of an object may have dots itself: variables are named by their keys.
  if (node.is_object() && member == node.end()) {
    for (const auto& [key, value] : node.items()) {
      if (rest == key) return follow(value, {}, found);
      if (rest.starts_with(key + ".")) return follow(value, rest.substr(key.size() + 1), found);
    }
  }
  return node.is_object() && member != node.end() ? follow(*member, after, found) : Json();
}

}  // namespace

Json gathered(const Json& results, const std::string& name) {
  bool found = false;
  Json values = follow(results, name, found);
  if (found) return values;
  const std::string hint = compare({Expectation{.key = name}}, results).back().hint;
  throw InvalidInput("quantity", name, "a name of these results" + (hint.empty() ? std::string() : fmt::format("; did you mean {}?", hint)));
}

}  // namespace flankwright::studies
