#include "studies/study_file/column_table.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "studies/base/printable.hpp"
#include "studies/study/study_errors.hpp"

namespace flankwright::studies {

namespace {

std::string_view trim_cell(std::string_view text) { return trimmed(text, " \t\r\""); }

void split_cells(std::string_view line, char separator, std::vector<TableCell>& cells) {
  cells.clear();
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(separator, at), line.size());
    cells.push_back({trim_cell(line.substr(at, end - at)), static_cast<int>(at) + 1});
    at = end + 1;
  }
}

std::string in_a_list(std::span<const std::string_view> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) text.append(i == 0 ? "" : i + 1 == names.size() ? " and " : ", ").append(names[i]);
  return text;
}

bool starts_with_word(std::string_view text, std::string_view word) {
  const auto alike = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b)); };
  return text.size() >= word.size() && std::ranges::equal(text.substr(0, word.size()), word, alike);
}

/// "torque_Nm", "Torque [N·m]", "torque (Nm)", "torque".
TableColumn column_of(const std::string& file, int line, const TableKind& kind, const TableCell& cell) {
  for (const std::string_view name : kind.columns) {
    if (!starts_with_word(cell.text, name)) continue;
    std::string_view unit = trim_cell(cell.text.substr(name.size()));
    const bool apart = unit.empty() || unit.front() == '_' || unit.front() == '[' || unit.front() == '(';
    if (!apart) continue;
    const auto is_mark = [](char c) { return c == '_' || c == '[' || c == ']' || c == '(' || c == ')' || c == ' '; };
    while (!unit.empty() && is_mark(unit.front())) unit.remove_prefix(1);
    while (!unit.empty() && is_mark(unit.back())) unit.remove_suffix(1);
    return {std::string(name), std::string(unit), cell};
  }
  refuse_cell(file, line, cell.column, kind.key, cell.text, "allowed are the columns " + in_a_list(kind.columns) + ", with a unit behind a name");
}

std::vector<TableColumn> columns_of(const std::string& file, int line, const TableKind& kind, const std::vector<TableCell>& cells) {
  std::vector<TableColumn> columns;
  for (const TableCell& cell : cells) {
    columns.push_back(column_of(file, line, kind, cell));
    const auto same = std::ranges::count(columns, columns.back().name, &TableColumn::name);
    if (same > 1) refuse_cell(file, line, cell.column, kind.key, cell.text, "the column is given twice");
  }
  return columns;
}

}  // namespace

void refuse_cell(const std::string& file, int line, int column, std::string_view key, std::string_view value, const std::string& allowed) {
  constexpr std::size_t most_shown = 60;
  std::string shown(value.substr(0, most_shown));
  if (value.size() > most_shown) shown += "...";
  throw StudyErrors({{file, line, column, std::string(key), shown, allowed}});
}

void read_table(std::string_view text, const std::string& name, const TableKind& kind,
                const std::function<void(int line, const std::vector<TableColumn>&)>& header,
                const std::function<void(int line, const std::vector<TableCell>&)>& row) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  std::size_t columns = 0;
  std::vector<TableCell> cells;
  char separator = ',';
  int number = 0;
  bool has_rows = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    at = end + 1;
    ++number;
    line = line.substr(0, line.find('#'));
    if (trim_cell(line).empty()) continue;
    if (columns == 0) {
      if (line.find('\t') != std::string_view::npos) separator = '\t';
      if (line.find(';') != std::string_view::npos) separator = ';';
      split_cells(line, separator, cells);
      header(number, columns_of(name, number, kind, cells));
      columns = cells.size();
      continue;
    }
    split_cells(line, separator, cells);
    if (cells.size() != columns) {
      refuse_cell(name, number, 1, kind.key, trim_cell(line), "allowed are " + std::to_string(columns) + " cells, one for each column");
    }
    row(number, cells);
    has_rows = true;
  }
  if (!has_rows) refuse_cell(name, std::max(1, number), 1, kind.key, "", "allowed is a line of names and at least one line of numbers");
}

std::string read_table_file(const std::string& path, std::size_t largest) {
  std::ifstream file(path, std::ios::binary);
  std::error_code no_status;
  if (!file || std::filesystem::is_directory(path, no_status)) throw StudyErrors({{path, 0, 0, "", "", "the file cannot be read"}});
  std::string text;
  constexpr std::streamsize part = 1 << 20;
  while (file && text.size() <= largest) {
    const std::size_t before = text.size();
    text.resize(before + static_cast<std::size_t>(part));
    file.read(text.data() + before, part);
    text.resize(before + static_cast<std::size_t>(file.gcount()));
  }
  if (text.size() > largest) {
    throw StudyErrors({{path, 0, 0, "file", "larger", "allowed is a file of at most " + std::to_string(largest) + " bytes"}});
  }
  return text;
}

}  // namespace flankwright::studies
