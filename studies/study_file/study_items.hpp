#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/study_file/study_reading.hpp"

/// Inside the reader: tables whose keys are not fixed names.
namespace flankwright::studies {

/// A key of a free table. Quoted ("a.b" = ...) and dotted (a.b = ...) keys give the same item.
struct Item {
  std::string name;
  const toml::node* node;
  Position position;
};

using IsItem = std::function<bool(const toml::node&)>;

/// A table that says something itself, or is empty.
bool is_filled_table(const toml::node& node);

/// Items of the table under `key`, which may be absent; doubles become problems.
std::vector<Item> items_of(StudyReading& reading, const std::string& key, const IsItem& is_item);

/// Reads one number with a schema row made for it; what cannot be read becomes a problem and NaN.
double number_of(StudyReading& reading, const Position& at, const std::string& path, const toml::node& node, const SchemaKey& rule);

}  // namespace flankwright::studies
