#include "studies/study_tables.hpp"

#include <cmath>
#include <limits>

namespace flankwright::studies {

namespace {

bool is_not_table(const toml::node& node) {
  return !node.is_table();
}

}  // namespace

bool is_filled_table(const toml::node& node) {
  const toml::table* table = node.as_table();
  if (table == nullptr || table->empty()) return true;
  for (const auto& [key, value] : *table) {
    if (!value.is_table()) return true;
  }
  return false;
}

std::vector<Item> items_of(StudyReading& reading, const std::string& key, const std::function<bool(const toml::node&)>& is_item) {
  const Match* match = reading.find(key);
  if (match == nullptr) return {};
  const toml::table* table = match->node->as_table();
  if (table == nullptr) {
    reading.refuse(match->position, key, match->node, "allowed is " + allowed_values(*match->key));
    return {};
  }
  std::map<std::string, Item> items;
  const auto visit = [&](const auto& self, const toml::table& level, const std::string& above) -> void {
    for (const auto& [name, node] : level) {
      const std::string path = above + std::string(name.str());
      const Position position = reading.document.position(name);
      reading.positions.emplace(key + "." + path, position);
      if (!is_item(node)) {
        self(self, *node.as_table(), path + ".");
      } else if (!items.emplace(path, Item{path, &node, position}).second) {
        reading.refuse(position, key + "." + path, &node, "the key is given twice");
      }
    }
  };
  visit(visit, *table, "");
  std::vector<Item> found;
  for (auto& [name, item] : items) found.push_back(std::move(item));
  return found;
}

namespace {

std::string unknown_output(const std::string& name) {
  const std::string near = nearest_word(name, output_names());
  return "unknown output" + (near.empty() ? "" : ", did you mean " + near + "?");
}

/// Reads one number with a schema row made for it; what cannot be read becomes a problem and NaN.
double number_of(StudyReading& reading, const Position& at, const std::string& path, const toml::node& node,
                 const SchemaKey& rule) {
  try {
    return read_number(rule, node);
  } catch (const InvalidInput& problem) {
    reading.refuse(at, path, &node, "allowed is " + problem.allowed());
    return std::numeric_limits<double>::quiet_NaN();
  }
}

constexpr double largest_weight = 1e9;

void read_objective(StudyReading& reading, const SchemaKey& key, const toml::node& node, const Position& at) {
  std::vector<ObjectiveTerm>& objective = reading.draft.study.optimise.objective;
  if (const auto* name = node.as_string()) {
    if (const auto output = find_output(name->get())) {
      objective = {output->term};
    } else {
      reading.refuse(at, key.path, &node, unknown_output(name->get()) + "; allowed is " + allowed_values(key));
    }
    return;
  }
  const toml::table* table = node.as_table();
  if (table == nullptr || table->empty())
    return reading.refuse(at, key.path, &node, "allowed is " + allowed_values(key));
  const SchemaKey weight{.range = {.low = 0.0, .high = largest_weight, .low_open = true}};
  for (const auto& [name, value] : *table) {
    const std::string path = key.path + "." + std::string(name.str());
    const Position position = reading.document.position(name);
    auto output = find_output(std::string(name.str()));
    if (!output) {
      reading.refuse(position, path, &value, unknown_output(std::string(name.str())));
      continue;
    }
    output->term.weight = number_of(reading, position, path, value, weight);
    objective.push_back(output->term);
  }
}

void read_variable(StudyReading& reading, const Item& item) {
  const std::string shown = "optimise.variables." + item.name;
  const auto known = study_keys().find(item.name);
  if (known == study_keys().end() || !std::holds_alternative<ModificationParameter>(known->second->store)) {
    const std::string hint = known == study_keys().end() ? nearest_key_hint(study_keys(), item.name) : "";
    return reading.refuse(
        item.position, shown, item.node,
        "allowed are the amounts, heights and lengths below pinion.modification and wheel.modification" + hint);
  }
  const SchemaKey& key = *known->second;
  const toml::array* bounds = item.node->as_array();
  if (bounds == nullptr || bounds->size() != 2) {
    return reading.refuse(item.position, shown, item.node,
                          "allowed are two numbers [low, high]" + range_in_words(key.range, key.quantity));
  }
  DesignVariable variable{
      .path = item.name, .member = key.member, .parameter = std::get<ModificationParameter>(key.store)};
  variable.lower = number_of(reading, item.position, shown, *bounds->get(0), key);
  variable.upper = number_of(reading, item.position, shown, *bounds->get(1), key);
  if (variable.lower >= variable.upper) {
    return reading.refuse(item.position, shown, item.node, "allowed is [low, high] with low below high");
  }
  reading.draft.study.optimise.variables.push_back(variable);
}

/// What a key is to a loaded mesh; nothing where there is no derivative with respect to it.
std::optional<MeshParameter> mesh_parameter(const SchemaKey& key) {
  if (const auto* modification = std::get_if<ModificationParameter>(&key.store)) return GearParameter{key.member, *modification};
  for (const NamedMisalignmentParameter& p : misalignment_parameters) {
    if (key.path == "misalignment." + std::string(p.name)) return p.parameter;
  }
  if (key.path == "load.torque") return PinionTorque{};
  return std::nullopt;
}

void read_constraint(StudyReading& reading, const Item& item) {
  const std::string shown = "optimise.constraints." + item.name;
  const auto output = find_output(item.name);
  if (!output) return reading.refuse(item.position, shown, item.node, unknown_output(item.name));
  const toml::table* table = item.node->as_table();
  const toml::node* maximum = table == nullptr ? nullptr : table->get("max");
  if (maximum == nullptr || table->size() != 1) {
    return reading.refuse(item.position, shown, item.node, "allowed is { max = ... } and nothing else");
  }
  const SchemaKey limit{.quantity = output->quantity, .range = {.low = 0.0, .low_open = true}};
  const double bound = number_of(reading, item.position, shown + ".max", *maximum, limit);
  reading.draft.study.optimise.constraints.push_back({output->term, bound});
}

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
  reading.draft.study.expect.push_back(expectation);
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
  const std::string allowed =
      "allowed is { value = ..., within = ... }, { min = ... }, { max = ... }, { min = ..., max = ... } or { is = ... }";
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
  reading.draft.study.expect.push_back(expectation);
}

}  // namespace

void read_scenes(StudyReading& reading) {
  std::vector<Scene>& scenes = reading.draft.study.scenes;
  const Match* match = reading.find("scenes");
  if (match == nullptr) {
    scenes = {reading.draft.base};
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
    Scene scene = reading.draft.base;
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

void read_gradients(StudyReading& reading) {
  const Match* match = reading.find("analyse.gradients");
  if (match == nullptr) return;
  const toml::array* keys = match->node->as_array();
  if (keys == nullptr) return reading.refuse(match->position, match->path, match->node, "allowed is " + allowed_values(*match->key));
  for (const toml::node& node : *keys) {
    const auto known = study_keys().find(node.value_or(std::string()));
    const auto parameter = known == study_keys().end() ? std::nullopt : mesh_parameter(*known->second);
    if (!parameter) {
      const std::string hint = known == study_keys().end() ? nearest_key_hint(study_keys(), node.value_or(std::string())) : "";
      reading.refuse(match->position, match->path, &node, "allowed is " + allowed_values(*match->key) + hint);
      continue;
    }
    const Quantity quantity = known->second->quantity;
    reading.draft.study.gradients.push_back(
        {known->first, *parameter, std::string(default_unit(quantity)), internal_value(1.0, quantity)});
  }
}

void read_optimise(StudyReading& reading) {
  const SchemaKey& objective = *study_keys().at("optimise.objective");
  if (const Match* match = reading.find(objective.path)) {
    read_objective(reading, objective, *match->node, match->position);
  } else {
    const toml::table fallback = toml::parse("value = " + objective.fallback);
    read_objective(reading, objective, *fallback.get("value"), {});
  }
  for (const Item& item : items_of(reading, "optimise.variables", is_not_table)) read_variable(reading, item);
  for (const Item& item : items_of(reading, "optimise.constraints", is_filled_table)) read_constraint(reading, item);
}

void read_expectations(StudyReading& reading) {
  for (const Item& item : items_of(reading, "expect", is_filled_table)) read_expectation(reading, item);
}

}  // namespace flankwright::studies
