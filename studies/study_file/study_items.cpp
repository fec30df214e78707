#include "studies/study_file/study_items.hpp"

#include <limits>

namespace flankwright::studies {

bool is_filled_table(const toml::node& node) {
  const toml::table* table = node.as_table();
  if (table == nullptr || table->empty()) return true;
  for (const auto& [key, value] : *table) {
    if (!value.is_table()) return true;
  }
  return false;
}

std::vector<Item> items_of(StudyReading& reading, const std::string& key, const IsItem& is_item) {
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

double number_of(StudyReading& reading, const Position& at, const std::string& path, const toml::node& node, const SchemaKey& rule) {
  try {
    return read_number(rule, node);
  } catch (const InvalidInput& problem) {
    reading.refuse(at, path, &node, "allowed is " + problem.allowed());
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace flankwright::studies
