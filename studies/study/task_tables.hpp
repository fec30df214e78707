#pragma once

#include <any>
#include <map>
#include <typeindex>

namespace flankwright::studies {

/// Tables of a study by their type, each declared by the task that reads it.
class TaskTables {
 public:
  /// As a table begins where nothing was written to it.
  template <class Table>
  const Table& get() const {
    static const Table untouched{};
    const auto known = tables_.find(typeid(Table));
    return known == tables_.end() ? untouched : *std::any_cast<Table>(&known->second);
  }

  template <class Table>
  Table& get() {
    std::any& table = tables_[typeid(Table)];
    if (!table.has_value()) table.emplace<Table>();
    return *std::any_cast<Table>(&table);
  }

 private:
  std::map<std::type_index, std::any> tables_;
};

}  // namespace flankwright::studies
