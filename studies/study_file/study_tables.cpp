#include "studies/study_file/study_tables.hpp"

#include <cmath>

#include "studies/study_file/study_items.hpp"

namespace flankwright::studies {

namespace {

/// Optional plain number of an [expect] entry.
void read_expected(StudyReading& reading, const Item& item, const std::string& name, double& value) {
  const toml::node* node = item.node->as_table()->get(name);
  if (node == nullptr) return;
  value = number_of(reading, item.position, "expect." + item.name + "." + name, *node, SchemaKey{});
}

/// { is = "text" } or { is = true }, on its own.
void read_expected_word(StudyReading& reading, const Item& item, const toml::node& node) {
  Expectation expectation{.key = item.name};
  if (const auto* text = node.as_string()) expectation.is = text->get();
  if (const auto* truth = node.as_boolean()) expectation.is = truth->get() ? "true" : "false";
  if (expectation.is.empty() || item.node->as_table()->size() != 1) {
    return reading.refuse(item.position, "expect." + item.name, item.node,
                          "allowed is { is = ... } with a text that is not empty, or true or false, and nothing else");
  }
  reading.builder.study.expect.push_back(expectation);
}

void read_within(StudyReading& reading, const Item& item, Expectation& expectation) {
  const toml::node* within = item.node->as_table()->get("within");
  if (within == nullptr) return;
  const std::string shown = "expect." + item.name + ".within";
  const std::string allowed = "allowed is a percentage such as \"2 %\", or a number in the unit of the value; above 0";
  double& tolerance = within->is_string() ? expectation.within_relative : expectation.within_absolute;
  if (const auto* text = within->as_string()) {
    try {
      tolerance = parse_percentage(text->get());
    } catch (const InvalidInput&) {
      return reading.refuse(item.position, shown, within, allowed);
    }
  } else if (within->is_number()) {
    tolerance = within->value<double>().value_or(0.0);
  }
  if (!(tolerance > 0.0 && std::isfinite(tolerance))) return reading.refuse(item.position, shown, within, allowed);
  if (within->is_string() && expectation.value == 0.0) {
    reading.refuse(item.position, shown, within, "allowed is a number where the value is 0: no percentage of 0");
  }
}

void read_expectation(StudyReading& reading, const Item& item) {
  const std::string shown = "expect." + item.name;
  const toml::table* table = item.node->as_table();
  const std::string allowed = "allowed is { value = ..., within = ... }, { min = ... }, { max = ... }, { min = ..., max = ... } or { is = ... }";
  if (table == nullptr) return reading.refuse(item.position, shown, item.node, allowed);
  for (const auto& [name, value] : *table) {
    if (name != "value" && name != "within" && name != "min" && name != "max" && name != "is") {
      return reading.refuse(item.position, shown + "." + std::string(name.str()), &value, "unknown key; " + allowed);
    }
  }
  const bool has_bound = table->contains("min") || table->contains("max");
  if (const toml::node* is = table->get("is")) return read_expected_word(reading, item, *is);
  if (table->contains("value") != table->contains("within") || table->contains("value") == has_bound) {
    return reading.refuse(item.position, shown, item.node, allowed);
  }
  Expectation expectation{.key = item.name};
  read_expected(reading, item, "value", expectation.value);
  read_expected(reading, item, "min", expectation.minimum);
  read_expected(reading, item, "max", expectation.maximum);
  read_within(reading, item, expectation);
  if (expectation.minimum > expectation.maximum) {
    return reading.refuse(item.position, shown, item.node, "allowed is min at most max");
  }
  reading.builder.study.expect.push_back(expectation);
}

}  // namespace

void read_scenes(StudyReading& reading) {
  std::vector<Scene>& scenes = reading.builder.study.scenes;
  const Match* match = reading.find("scenes");
  if (match == nullptr) {
    scenes = {reading.builder.base};
    return;
  }
  const toml::array* tables = match->node->as_array();
  if (tables == nullptr || tables->empty() || !tables->is_homogeneous(toml::node_type::table)) {
    return reading.refuse(match->position, "scenes", match->node, "allowed is " + allowed_values(*match->key));
  }
  std::map<std::string, std::size_t> names;
  for (std::size_t i = 0; i < tables->size(); ++i) {
    const std::string prefix = "scenes." + std::to_string(i) + ".";
    const toml::node& node = *tables->get(i);
    const Position at = reading.document.position(node, match->position);
    reading.positions.emplace(prefix.substr(0, prefix.size() - 1), at);
    Scene scene = reading.builder.base;
    scene.name = "scene " + std::to_string(i + 1);
    for (const auto& [path, of_scene] : match_keys(reading, *node.as_table(), scene_keys(), prefix)) {
      read_into(reading, of_scene, scene);
    }
    if (!names.emplace(scene.name, i).second) {
      reading.refuse(reading.where(prefix + "name"), prefix + "name", node.as_table()->get("name"),
                     "another scene has this name; allowed is a name of its own");
    }
    scenes.push_back(scene);
  }
}

void read_expectations(StudyReading& reading) {
  for (const Item& item : items_of(reading, "expect", is_filled_table)) read_expectation(reading, item);
}

}  // namespace flankwright::studies
