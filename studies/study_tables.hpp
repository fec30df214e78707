#pragma once

#include <functional>

#include "studies/study_reading.hpp"

/// Inside the reader: the tables of a study whose keys are not fixed names.
namespace flankwright::studies {

/// A key of a free table. Quoted ("a.b" = ...) and dotted (a.b = ...) keys give the same item.
struct Item {
  std::string name;
  const toml::node* node;
  Position position;
};

/// A table that says something itself, or is empty.
bool is_filled_table(const toml::node& node);

/// Items of the table under `key`, which may be absent, by name; doubles become problems. What is_item() refuses is a table of items.
std::vector<Item> items_of(StudyReading& reading, const std::string& key, const std::function<bool(const toml::node&)>& is_item);

/// [[scenes]], or the one nominal scene; each is the base with its overrides. Needs draft.base.
void read_scenes(StudyReading& reading);

/// analyse.gradients.
void read_gradients(StudyReading& reading);

/// The objective, the variables and the constraints of [optimise].
void read_optimise(StudyReading& reading);

/// [expect].
void read_expectations(StudyReading& reading);

}  // namespace flankwright::studies
