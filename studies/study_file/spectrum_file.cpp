#include "studies/study_file/spectrum_file.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "studies/study/study_errors.hpp"

namespace flankwright::studies {

namespace {

constexpr std::array spectrum_columns{"torque", "speed", "hours", "cycles", "temperature", "mesh_misalignment"};
constexpr const char* allowed_columns =
    "allowed are the columns torque, speed, hours, cycles, temperature and mesh_misalignment, with a unit behind a name";

std::string_view trim_cell(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

[[noreturn]] void refuse_cell(const std::string& file, int line, int column, const std::string& key, std::string_view value,
                              const std::string& allowed) {
  throw StudyErrors({{file, line, column, key, std::string(value), allowed}});
}

/// A cell and the column of its first character, from 1.
struct CsvCell {
  std::string_view text;
  int column;
};

std::vector<CsvCell> split_cells(std::string_view line, char separator) {
  std::vector<CsvCell> cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = std::min(line.find(separator, at), line.size());
    cells.push_back({trim_cell(line.substr(at, end - at)), static_cast<int>(at) + 1});
    at = end + 1;
  }
  return cells;
}

struct CsvColumn {
  std::string key, unit;
};

/// "torque_Nm", "torque [N·m]", "torque (Nm)", "torque".
CsvColumn column_of(const std::string& file, int line, const CsvCell& cell) {
  for (const std::string_view name : spectrum_columns) {
    if (!cell.text.starts_with(name)) continue;
    std::string_view unit = trim_cell(cell.text.substr(name.size()));
    const bool apart = unit.empty() || unit.front() == '_' || unit.front() == '[' || unit.front() == '(';
    if (!apart) continue;
    const auto is_mark = [](char c) { return c == '_' || c == '[' || c == ']' || c == '(' || c == ')' || c == ' '; };
    while (!unit.empty() && is_mark(unit.front())) unit.remove_prefix(1);
    while (!unit.empty() && is_mark(unit.back())) unit.remove_suffix(1);
    return {std::string(name), std::string(unit)};
  }
  refuse_cell(file, line, cell.column, "load.spectrum", cell.text, allowed_columns);
}

}  // namespace

std::vector<SpectrumRow> parse_spectrum(std::string_view text, const std::string& name) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  std::vector<CsvColumn> header;
  std::vector<SpectrumRow> rows;
  char separator = ',';
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    at = end + 1;
    ++number;
    line = line.substr(0, line.find('#'));
    if (trim_cell(line).empty()) continue;
    if (header.empty()) {
      if (line.find('\t') != std::string_view::npos) separator = '\t';
      if (line.find(';') != std::string_view::npos) separator = ';';
      for (const CsvCell& cell : split_cells(line, separator)) {
        header.push_back(column_of(name, number, cell));
        const auto same = std::ranges::count(header, header.back().key, &CsvColumn::key);
        if (same > 1) refuse_cell(name, number, cell.column, "load.spectrum", cell.text, "the column is given twice");
      }
      continue;
    }
    const std::vector<CsvCell> cells = split_cells(line, separator);
    if (cells.size() != header.size()) {
      refuse_cell(name, number, 1, "load.spectrum", trim_cell(line), "allowed are " + std::to_string(header.size()) + " cells, one for each column");
    }
    SpectrumRow& row = rows.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i].text.empty()) continue;
      std::string text_of_cell(cells[i].text);
      if (!header[i].unit.empty()) text_of_cell.append(" ").append(header[i].unit);
      row.push_back({header[i].key, std::move(text_of_cell), number, cells[i].column});
    }
  }
  if (rows.empty()) refuse_cell(name, std::max(1, number), 1, "load.spectrum", "", "allowed is a line of names and at least one line of numbers");
  return rows;
}

std::vector<SpectrumRow> read_spectrum_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  std::error_code no_status;
  if (!file || std::filesystem::is_directory(path, no_status)) throw StudyErrors({{path, 0, 0, "", "", "the file cannot be read"}});
  return parse_spectrum(text.str(), path);
}

}  // namespace flankwright::studies
