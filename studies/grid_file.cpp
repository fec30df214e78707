#include "studies/grid_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <tuple>
#include <vector>

#include "core/base/units.hpp"
#include "studies/study_file.hpp"

namespace flankwright::studies {

namespace {

/// A column of the file, in the order of Row::values.
struct Column {
  std::string_view name;
  double largest;  ///< magnitude allowed, in the unit of the name
};
constexpr std::array<Column, 3> columns{{{"radius_mm", largest_grid_length},
                                         {"z_mm", largest_grid_length},
                                         {"deviation_um", largest_grid_deviation / units::um}}};

/// A point of the grid [mm, mm, um].
struct Row {
  std::array<double, 3> values{};
  int line{0};

  double radius() const { return values[0]; }
  double z() const { return values[1]; }
  double deviation() const { return values[2] * units::um; }
  bool is_at(const Row& other) const { return radius() == other.radius() && z() == other.z(); }
};

struct Cell {
  std::string_view text;  ///< without the blanks around it
  int column;             ///< of its first character in the line, from 1
};

std::string text_of(double number) {
  std::array<char, 32> digits{};
  const auto [end, status] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return {digits.data(), end};
}

std::vector<Cell> cells_of(std::string_view line, char separator) {
  constexpr std::string_view blanks = " \t\r";
  std::vector<Cell> cells;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(separator, start), line.size());
    const std::size_t first = std::min(line.find_first_not_of(blanks, start), end);
    std::string_view text = line.substr(first, end - first);
    text = text.substr(0, text.find_last_not_of(blanks) + 1);
    cells.push_back({text, static_cast<int>(first) + 1});
    start = end + 1;
  }
  return cells;
}

/// True for a text that is a number with a decimal point and nothing else; comparisons with it refuse "nan" and "inf".
bool is_number(std::string_view text, double& number) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  return status == std::errc{} && end == text.data() + text.size();
}

[[noreturn]] void refuse(const std::string& file, int line, int column, const std::string& key, std::string_view value,
                         const std::string& allowed) {
  constexpr std::size_t most_shown = 60;
  std::string shown(value.substr(0, most_shown));
  if (value.size() > most_shown) shown += "...";
  throw StudyErrors({{file, line, column, key, shown, "allowed is " + allowed}});
}

/// A grid file, line by line.
class GridText {
 public:
  GridText(std::string_view text, const std::string& file) : rest_(text), file_(file) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
  }

  /// The points in the order of the file.
  std::vector<Row> read() {
    if (!next_line())
      refuse(file_, 0, 0, "file", "without content", "a line of column names, then a line for each point");
    read_header();
    std::vector<Row> rows;
    while (next_line()) rows.push_back(read_row());
    return rows;
  }

 private:
  /// Goes to the next line that has more than blanks and a comment.
  bool next_line() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line_ = rest_.substr(0, std::min(rest_.find('#'), end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      if (line_.find_first_not_of(" \t\r") != std::string_view::npos) return true;
    }
    return false;
  }

  void read_header() {
    const std::size_t found = line_.find_first_of(";,\t");
    if (found != std::string_view::npos) separator_ = line_[found];
    for (const Cell& cell : cells_of(line_, separator_)) {
      const auto column = std::ranges::find(columns, cell.text, &Column::name);
      const auto which = static_cast<std::size_t>(column - columns.begin());
      if (column == columns.end() || std::ranges::find(order_, which) != order_.end()) {
        refuse(file_, number_, cell.column, "column", cell.text, names_allowed());
      }
      order_.push_back(which);
    }
    if (order_.size() < columns.size()) refuse(file_, number_, 1, "columns", line_, names_allowed());
  }

  Row read_row() const {
    const std::vector<Cell> cells = cells_of(line_, separator_);
    if (cells.size() != order_.size()) {
      refuse(file_, number_, 1, "line", line_,
             std::to_string(order_.size()) + " numbers with the separator of the first line");
    }
    Row row;
    row.line = number_;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Column& column = columns[order_[i]];
      double& number = row.values[order_[i]];
      if (!is_number(cells[i].text, number) || !(std::abs(number) <= column.largest)) {
        const std::string largest = text_of(column.largest);
        refuse(file_, number_, cells[i].column, std::string(column.name), cells[i].text,
               "a number -" + largest + " .. " + largest + " with a decimal point");
      }
      number += 0.0;  // -0 and 0 are one number, whichever row comes first
    }
    return row;
  }

  static std::string names_allowed() {
    std::string names = "once each";
    for (const Column& column : columns) names.append(", ").append(column.name);
    return names;
  }

  std::string_view rest_, line_;
  const std::string& file_;
  int number_{0};  ///< of line_, from 1
  char separator_{','};
  std::vector<std::size_t> order_;  ///< which of `columns` a cell belongs to
};

/// Sorted and without repetition.
std::vector<double> distinct(const std::vector<Row>& rows, double (Row::*coordinate)() const) {
  std::vector<double> values;
  for (const Row& row : rows) values.push_back((row.*coordinate)());
  std::ranges::sort(values);
  const auto repeated = std::ranges::unique(values);
  values.erase(repeated.begin(), repeated.end());
  return values;
}

std::string place_of(double radius, double z) {
  return "radius_mm " + text_of(radius) + ", z_mm " + text_of(z);
}

}  // namespace

MeasuredGrid parse_grid(std::string_view text, const std::string& name) {
  std::vector<Row> rows = GridText(text, name).read();
  std::ranges::sort(rows, {}, [](const Row& row) { return std::tuple(row.radius(), row.z(), row.line); });
  const auto twice = std::ranges::adjacent_find(rows, &Row::is_at);
  if (twice != rows.end()) {
    refuse(name, (twice + 1)->line, 1, "point", place_of(twice->radius(), twice->z()),
           "each point once; line " + std::to_string(twice->line) + " has this one");
  }

  MeasuredGrid grid{distinct(rows, &Row::radius), distinct(rows, &Row::z), {}};
  const std::size_t m = grid.radii.size(), n = grid.z.size();
  if (m < 2 || n < 2) {
    refuse(name, 0, 0, "grid", std::to_string(m) + " radii with " + std::to_string(n) + " axial positions",
           "at least 2 x 2");
  }
  // With no point twice, a point is missing where the sorted rows first differ from the full grid.
  for (std::size_t k = 0; k < m * n; ++k) {
    const double radius = grid.radii[k / n], z = grid.z[k % n];
    if (k < rows.size() && rows[k].radius() == radius && rows[k].z() == z) continue;
    const auto same_radius = std::ranges::find(rows, radius, &Row::radius);
    refuse(name, same_radius->line, 1, "point", "none at " + place_of(radius, z),
           "every radius with every z, the same numbers in each line that shares them");
  }
  grid.deviation.resize(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(n));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    grid.deviation(static_cast<Eigen::Index>(k / n), static_cast<Eigen::Index>(k % n)) = rows[k].deviation();
  }
  return grid;
}

MeasuredGrid read_grid(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  std::error_code no_status;
  if (!file || std::filesystem::is_directory(path, no_status)) {
    throw StudyErrors({{path, 0, 0, "", "", "the file cannot be read"}});
  }
  return parse_grid(text.str(), path);
}

}  // namespace flankwright::studies
