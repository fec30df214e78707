#include "studies/tasks/optimise/optimise_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "optimize/design/outputs/design_output.hpp"
#include "studies/study_file/study_items.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

/// Reads what [optimise] says: objectives, variables, ties and constraints.
namespace flankwright::studies {

namespace {

std::string unknown_output(const std::string& name) {
  const std::string near = nearest_word(name, term_names());
  return "unknown output" + (near.empty() ? "" : ", did you mean " + near + "?");
}

/// The same where the line does not list them anyway.
std::string unknown_output_of(const std::string& name) {
  const std::string said = unknown_output(name);
  if (said.ends_with('?')) return said;
  std::string all;
  for (const std::string& output : term_names()) all += (all.empty() ? "; allowed is " : ", ") + output;
  return said + all;
}

constexpr double largest_weight = 1e9;

/// One output, or a table of outputs and weights; what cannot be read becomes a problem.
std::vector<ObjectiveTerm> read_terms(StudyReading& reading, const SchemaKey& key, const toml::node& node, const Position& at) {
  if (const auto* name = node.as_string()) {
    if (const auto output = find_term(name->get())) return {*output};
    reading.refuse(at, key.path, &node, unknown_output(name->get()) + "; allowed is " + allowed_values(key));
    return {};
  }
  const toml::table* table = node.as_table();
  if (table == nullptr || table->empty()) {
    reading.refuse(at, key.path, &node, "allowed is " + allowed_values(key));
    return {};
  }
  std::vector<ObjectiveTerm> terms;
  const SchemaKey weight{.range = {.low = 0.0, .high = largest_weight, .low_open = true}};
  for (const auto& [name, value] : *table) {
    const std::string path = key.path + "." + std::string(name.str());
    const Position position = reading.document.position(name);
    auto output = find_term(name.str());
    if (!output) {
      reading.refuse(position, path, &value, unknown_output_of(std::string(name.str())));
      continue;
    }
    output->weight = number_of(reading, position, path, value, weight);
    terms.push_back(*output);
  }
  return terms;
}

std::vector<Objective> read_objectives(StudyReading& reading, const SchemaKey& key, const toml::array& list, const Position& at) {
  std::vector<Objective> objectives;
  for (const toml::node& node : list) objectives.push_back({read_terms(reading, key, node, at), reading.builder.study.table<OptimiseTable>().over});
  return objectives;
}

void read_objective(StudyReading& reading, const SchemaKey& key, const toml::node& node, const Position& at) {
  OptimiseTable& optimise = reading.builder.study.table<OptimiseTable>();
  const toml::array* list = node.as_array();
  if (list == nullptr) {
    optimise.objective = read_terms(reading, key, node, at);
    return;
  }
  if (list->empty()) return reading.refuse(at, key.path, &node, "allowed is " + allowed_values(key));
  std::vector<Objective> objectives = read_objectives(reading, key, *list, at);
  optimise.objective = objectives.front().terms;
  optimise.later_objectives.assign(objectives.begin() + 1, objectives.end());
}

/// Why there is no natural twist that a gear's compensation could take out; empty where there is one.
std::string no_twist_in_words(const Study& study, Member member) {
  const GrindingProcess& process = study.modification[member].process;
  if (!process.has_natural_twist()) {
    return fmt::format("{}.process is \"{}\", which has no natural twist: allowed is \"generating_grinding\" or \"form_grinding\"", name_of(member),
                       to_string(process.kind));
  }
  if (study.pair.helix_angle == 0.0) return "a spur gear has no natural twist: allowed is a pair.helix_angle above 0";
  const Fidelity& fidelity = study.fidelity;
  const bool is_off = !fidelity.automatic_effects && std::ranges::find(fidelity.effects, "natural_twist") == fidelity.effects.end();
  return is_off ? "fidelity.effects leaves the natural twist out: allowed is \"auto\" or a list with \"natural_twist\"" : "";
}

/// A key that may be a variable: a number below pinion.modification or wheel.modification, or a twist_compensation; null where a name is none, which
/// becomes a problem.
const SchemaKey* modification_key(StudyReading& reading, const std::string& name, const Position& at, const std::string& shown,
                                  const toml::node* node) {
  const auto known = study_keys().find(name);
  const auto* parameter = known == study_keys().end() ? nullptr : std::get_if<ModificationParameter>(&known->second->store);
  if (parameter != nullptr) {
    const std::string reason = of_process(*parameter) == nullptr ? "" : no_twist_in_words(reading.builder.study, known->second->member);
    if (reason.empty()) return known->second;
    reading.refuse(at, shown, node, reason);
    return nullptr;
  }
  const std::string hint = known == study_keys().end() ? nearest_key_hint(study_keys(), name) : "";
  reading.refuse(
      at, shown, node,
      "allowed are the amounts, heights and lengths below pinion.modification and wheel.modification, and twist_compensation of either gear" + hint);
  return nullptr;
}

DesignVariable variable_of(const SchemaKey& key) {
  return {.path = key.path, .member = key.member, .parameter = std::get<ModificationParameter>(key.store)};
}

/// Known keys of an item's table; others become problems.
bool has_only(StudyReading& reading, const Item& item, const std::string& shown, const std::vector<std::string_view>& keys,
              const std::string& allowed) {
  for (const auto& [name, value] : *item.node->as_table()) {
    if (std::ranges::find(keys, name.str()) != keys.end()) continue;
    reading.refuse(item.position, shown + "." + std::string(name.str()), &value, "unknown key; " + allowed);
    return false;
  }
  return true;
}

void read_variable(StudyReading& reading, const Item& item) {
  const std::string shown = "optimise.variables." + item.name;
  const SchemaKey* key = modification_key(reading, item.name, item.position, shown, item.node);
  if (key == nullptr) return;
  const toml::table* table = item.node->as_table();
  const std::string allowed =
      "allowed are two numbers [low, high], or { range = [low, high], step = ... }" + range_in_words(key->range, key->quantity);
  if (table != nullptr && !has_only(reading, item, shown, {"range", "step"}, allowed)) return;
  const toml::node* range = table == nullptr ? item.node : table->get("range");
  const toml::array* bounds = range == nullptr ? nullptr : range->as_array();
  if (bounds == nullptr || bounds->size() != 2) return reading.refuse(item.position, shown, item.node, allowed);
  DesignVariable variable = variable_of(*key);
  variable.lower = number_of(reading, item.position, shown, *bounds->get(0), *key);
  variable.upper = number_of(reading, item.position, shown, *bounds->get(1), *key);
  if (variable.lower >= variable.upper) {
    return reading.refuse(item.position, shown, item.node, "allowed is [low, high] with low below high");
  }
  if (key->quantity == Quantity::Deviation) variable.step = reading.builder.study.table<OptimiseTable>().step;
  if (const toml::node* step = table == nullptr ? nullptr : table->get("step")) {
    const SchemaKey rule{.quantity = key->quantity, .range = {.low = 0.0, .low_open = true}};
    const auto* word = step->as_string();
    variable.step = word != nullptr && word->get() == "none" ? 0.0 : number_of(reading, item.position, shown + ".step", *step, rule);
  }
  if (variable.step > variable.upper - variable.lower) {
    return reading.refuse(item.position, shown, item.node, "the step leaves nothing to choose: allowed is one within the range");
  }
  reading.builder.study.table<OptimiseTable>().variables.push_back(variable);
}

/// Value of a tie at one end of its variable; beyond its key's range it becomes a problem.
void check_linked_value(StudyReading& reading, const Item& item, const std::string& shown, const SchemaKey& key, double value) {
  const double low = internal_value(key.range.low, key.quantity), high = internal_value(key.range.high, key.quantity);
  if (value >= low && value <= high) return;
  reading.refuse(item.position, shown, item.node,
                 "leaves its range at an end of the variable: allowed is a number" + range_in_words(key.range, key.quantity));
}

void read_link(StudyReading& reading, const Item& item) {
  const std::string shown = "optimise.ties." + item.name;
  const std::string allowed = "allowed is { as = \"pinion.modification.lead_crowning\", factor = 1, offset = 0 }";
  OptimiseTable& optimise = reading.builder.study.table<OptimiseTable>();
  const SchemaKey* key = modification_key(reading, item.name, item.position, shown, item.node);
  if (key == nullptr) return;
  const toml::table* table = item.node->as_table();
  const toml::node* as = table == nullptr ? nullptr : table->get("as");
  if (as == nullptr || !as->is_string()) return reading.refuse(item.position, shown, item.node, allowed);
  if (!has_only(reading, item, shown, {"as", "factor", "offset"}, allowed)) return;
  const auto at = [&](const std::string& path) { return std::ranges::find(optimise.variables, path, &DesignVariable::path); };
  const auto variable = at(as->as_string()->get());
  if (variable == optimise.variables.end()) {
    return reading.refuse(item.position, shown + ".as", as, "allowed is one of optimise.variables");
  }
  if (at(item.name) != optimise.variables.end()) {
    return reading.refuse(item.position, shown, item.node, "is a variable as well: allowed is one of the two");
  }
  if (key->quantity != study_keys().at(variable->path)->quantity) {
    return reading.refuse(item.position, shown + ".as", as,
                          "is of another unit: allowed is a variable in " + std::string(default_unit(key->quantity)));
  }
  LinkingConstraint link{.linked = variable_of(*key), .as = static_cast<std::size_t>(variable - optimise.variables.begin())};
  const SchemaKey factor{.range = {.low = -1000.0, .high = 1000.0}}, offset{.quantity = key->quantity};
  if (const toml::node* node = table->get("factor")) link.factor = number_of(reading, item.position, shown + ".factor", *node, factor);
  if (const toml::node* node = table->get("offset")) link.offset = number_of(reading, item.position, shown + ".offset", *node, offset);
  const double one = link.factor * variable->lower + link.offset, other = link.factor * variable->upper + link.offset;
  link.linked.lower = std::min(one, other);
  link.linked.upper = std::max(one, other);
  for (const double end : {one, other}) check_linked_value(reading, item, shown, *key, end);
  optimise.links.push_back(link);
}

/// A bound of an item's table in a unit; nothing where it is absent.
std::optional<double> read_bound(StudyReading& reading, const Item& item, const std::string& shown, const char* name, const SchemaKey& rule) {
  const toml::node* node = item.node->as_table()->get(name);
  if (node == nullptr) return std::nullopt;
  return number_of(reading, item.position, shown + "." + name, *node, rule);
}

/// "2 * a - b + c" -> factors and names; empty where it reads otherwise.
std::vector<std::pair<double, std::string>> split_sum(const std::string& text) {
  std::vector<std::pair<double, std::string>> terms;
  double sign = 1.0, factor = 1.0;
  bool wants_name = true;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    at = text.find_first_not_of(' ', end);
    if (word == "+" || word == "-") {
      sign = word == "+" ? 1.0 : -1.0;
      if (wants_name && !terms.empty()) return {};
      wants_name = true;
    } else if (!wants_name) {
      return {};
    } else if (at < text.size() && text[at] == '*') {
      std::size_t read = 0;
      try {
        factor = std::stod(word, &read);
      } catch (const std::exception&) {
        return {};
      }
      if (read != word.size()) return {};
      at = text.find_first_not_of(' ', at + 1);
    } else {
      terms.emplace_back(sign * factor, word);
      sign = factor = 1.0;
      wants_name = false;
    }
  }
  return wants_name ? std::vector<std::pair<double, std::string>>{} : terms;
}

void read_modification_constraint(StudyReading& reading, const Item& item, const std::string& shown) {
  ModificationConstraint constraint;
  constraint.name = item.name;
  const SchemaKey* first = nullptr;
  for (const auto& [factor, name] : split_sum(item.name)) {
    const SchemaKey* key = modification_key(reading, name, item.position, shown, item.node);
    if (key == nullptr) return;
    if (first != nullptr && key->quantity != first->quantity) {
      return reading.refuse(item.position, shown, item.node, "adds up different units: allowed is one unit");
    }
    first = key;
    constraint.terms.push_back({key->member, std::get<ModificationParameter>(key->store), factor});
  }
  if (first == nullptr) {
    return reading.refuse(item.position, shown, item.node,
                          "allowed is an output, or a sum such as \"2 * pinion.modification.lead_crowning - "
                          "wheel.modification.lead_crowning\" with spaces around the signs");
  }
  const auto& variables = reading.builder.study.table<OptimiseTable>().variables;
  const auto& links = reading.builder.study.table<OptimiseTable>().links;
  const bool varies = std::ranges::any_of(constraint.terms, [&](const ModificationConstraint::Term& term) {
    const auto is = [&](const DesignVariable& v) { return v.member == term.member && v.parameter == term.parameter; };
    return std::ranges::any_of(variables, is) || std::ranges::any_of(links, is, &LinkingConstraint::linked);
  });
  if (!varies) return reading.refuse(item.position, shown, item.node, "holds no variable: allowed is a sum that a variable changes");
  const SchemaKey rule{.quantity = first->quantity};
  if (const auto bound = read_bound(reading, item, shown, "max", rule)) constraint.maximum = *bound;
  if (const auto bound = read_bound(reading, item, shown, "min", rule)) constraint.minimum = *bound;
  if (constraint.minimum > constraint.maximum) return reading.refuse(item.position, shown, item.node, "allowed is min at most max");
  reading.builder.study.table<OptimiseTable>().modification_constraints.push_back(constraint);
}

/// What a limit or a value in that unit is.
Quantity quantity_of_unit(std::string_view unit) {
  if (unit == "um") return Quantity::Deviation;
  if (unit == "MPa") return Quantity::Stress;
  if (unit == "degC") return Quantity::Temperature;
  return unit == "N/mm" ? Quantity::LineLoad : Quantity::Number;
}

void read_constraint(StudyReading& reading, const Item& item) {
  const std::string shown = "optimise.constraints." + item.name;
  const std::string allowed = "allowed is { max = ... }, { min = ... } or both, and nothing else";
  const bool is_sum = item.name.find("modification.") != std::string::npos;
  const auto output = find_term(item.name);
  if (!output && !is_sum) return reading.refuse(item.position, shown, item.node, unknown_output_of(item.name));
  const toml::table* table = item.node->as_table();
  if (table == nullptr || table->empty()) return reading.refuse(item.position, shown, item.node, allowed);
  if (!has_only(reading, item, shown, {"max", "min"}, allowed)) return;
  if (is_sum) return read_modification_constraint(reading, item, shown);
  const SchemaKey limit{.quantity = quantity_of_unit(output->unit()), .range = {.low = 0.0, .low_open = true}};
  std::vector<OutputConstraint>& constraints = reading.builder.study.table<OptimiseTable>().constraints;
  const auto maximum = read_bound(reading, item, shown, "max", limit), minimum = read_bound(reading, item, shown, "min", limit);
  if (maximum && minimum && *minimum > *maximum) return reading.refuse(item.position, shown, item.node, "allowed is min at most max");
  if (maximum) constraints.push_back({.output = *output, .maximum = *maximum});
  if (minimum) constraints.push_back({.output = *output, .minimum = *minimum});
}

/// What edge_load counts as the edge, wherever it is asked for.
void spread_edge_margin(OptimiseTable& optimise) {
  const auto spread = [&](std::vector<ObjectiveTerm>& terms) {
    for (ObjectiveTerm& term : terms) term.edge_margin = optimise.edge_margin;
  };
  spread(optimise.objective);
  for (Objective& objective : optimise.later_objectives) spread(objective.terms);
  for (Objective& objective : optimise.pareto_objectives) spread(objective.terms);
  for (OutputConstraint& constraint : optimise.constraints) constraint.output.edge_margin = optimise.edge_margin;
}

/// A variable is a list or a table with a range, not a table of further names.
bool is_variable(const toml::node& node) { return !node.is_table() || node.as_table()->empty() || node.as_table()->contains("range"); }

}  // namespace

void read_optimise(StudyReading& reading) {
  OptimiseTable& optimise = reading.builder.study.table<OptimiseTable>();
  const SchemaKey& objective = *study_keys().at("optimise.objective");
  if (const Match* match = reading.find(objective.path)) {
    read_objective(reading, objective, *match->node, match->position);
  } else {
    const toml::table fallback = toml::parse("value = " + objective.fallback);
    read_objective(reading, objective, *fallback.get("value"), {});
  }
  if (const Match* match = reading.find("optimise.pareto.objectives")) {
    const toml::array* list = match->node->as_array();
    if (list == nullptr || list->size() < 2 || list->size() > 3) {
      reading.refuse(match->position, match->path, match->node, "allowed is " + allowed_values(*match->key));
    } else {
      optimise.pareto_objectives = read_objectives(reading, *match->key, *list, match->position);
    }
  }
  for (const Item& item : items_of(reading, "optimise.variables", is_variable)) read_variable(reading, item);
  for (const Item& item : items_of(reading, "optimise.ties", is_filled_table)) read_link(reading, item);
  for (const Item& item : items_of(reading, "optimise.constraints", is_filled_table)) read_constraint(reading, item);
  spread_edge_margin(optimise);
}

}  // namespace flankwright::studies
