#include "studies/study_file/grid_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/base/units.hpp"
#include "studies/study_file/column_table.hpp"
#include "studies/study_file/grid_header.hpp"

namespace flankwright::studies {

namespace {

/// Largest magnitude of a quantity [mm], in the order of GridQuantity and of Row::values.
constexpr std::array<double, 3> largest{largest_grid_length, largest_grid_length, largest_grid_deviation};

constexpr std::size_t most_points = std::size_t{most_grid_lines} * most_grid_lines;

/// A point takes some 30 bytes of a file; with long comments, 250.
constexpr std::size_t largest_file = 250 * most_points;

/// A point of the grid [mm].
struct Row {
  std::array<double, 3> values{};
  int line{0};

  double radius() const { return values[0]; }
  double z() const { return values[1]; }
  double deviation() const { return values[2]; }
  bool is_at(const Row& other) const { return radius() == other.radius() && z() == other.z(); }
};

std::string text_of(double number) {
  std::array<char, 32> digits{};
  const auto [end, status] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return {digits.data(), end};
}

/// Cells between separators; one in double quotes may contain separators.
std::vector<TableCell> cells_of(std::string_view line, char separator) {
  constexpr std::string_view blanks = " \t";
  std::vector<TableCell> cells;
  for (std::size_t start = 0; start <= line.size();) {
    std::size_t first = start;
    while (first < line.size() && line[first] != separator && blanks.find(line[first]) != std::string_view::npos) ++first;
    std::size_t from = first;
    if (first < line.size() && line[first] == '"') from = std::min(line.find('"', first + 1), line.size());
    const std::size_t end = std::min(line.find(separator, from), line.size());
    std::string_view text = line.substr(first, end - first);
    text = text.substr(0, text.find_last_not_of(blanks) + 1);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    cells.push_back({text, static_cast<int>(first) + 1});
    start = end + 1;
  }
  return cells;
}

/// True for a text that is a number and nothing else, with a decimal point or comma; comparisons with it refuse "nan" and "inf".
bool is_number(std::string_view text, double& number) {
  constexpr std::string_view minus = "\xe2\x88\x92";  // as word processors write it
  std::string plain(text);
  if (text.starts_with(minus)) plain.replace(0, minus.size(), 1, '-');
  if (plain.starts_with('+') && !plain.starts_with("+-")) plain.erase(0, 1);
  // One comma and no point: a decimal comma. Both, or two commas, is a number in groups, which is none here.
  if (const std::size_t comma = plain.find(','); comma != std::string::npos && plain.find('.') == std::string::npos) plain[comma] = '.';
  const auto [end, status] = std::from_chars(plain.data(), plain.data() + plain.size(), number);
  return status == std::errc{} && end == plain.data() + plain.size();
}

[[noreturn]] void refuse(const std::string& file, int line, int column, const std::string& key, std::string_view value, const std::string& allowed) {
  refuse_cell(file, line, column, key, value, "allowed is " + allowed);
}

/// A grid file, line by line.
class GridText {
 public:
  GridText(std::string_view text, const std::string& file) : rest_(text), file_(file) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (rest_.starts_with("\xff\xfe") || rest_.starts_with("\xfe\xff")) refuse(file_, 1, 1, "file", "in UTF-16", "a text in UTF-8");
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
  }

  /// The points in the order of the file.
  std::vector<Row> read() {
    if (!next_line()) refuse(file_, 0, 0, "file", "without content", "a line of column names, then a line for each point");
    read_header();
    std::vector<Row> rows;
    bool more = next_line();
    if (more && read_units()) more = next_line();
    for (; more; more = next_line()) {
      rows.push_back(read_row());
      if (rows.size() > most_points) {
        refuse(file_, number_, 1, "grid", "more than " + std::to_string(most_points) + " points",
               "at most " + std::to_string(most_grid_lines) + " radii with " + std::to_string(most_grid_lines) + " axial positions");
      }
    }
    return rows;
  }

 private:
  /// Goes to the next line that has more than blanks and a comment. Lines end with LF, CR LF or CR.
  bool next_line() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
      const bool two = rest_.substr(end).starts_with("\r\n");
      line_ = rest_.substr(0, end);
      line_ = line_.substr(0, line_.find('#'));
      rest_.remove_prefix(std::min(end + (two ? 2 : 1), rest_.size()));
      ++number_;
      const std::size_t first = line_.find_first_not_of(" \t");
      if (first == std::string_view::npos || line_.substr(first).starts_with('%') || line_.substr(first).starts_with("//")) continue;
      return true;
    }
    return false;
  }

  void read_header() {
    // Spreadsheets write the separator before all else: sep=;
    const bool is_told = line_.starts_with("sep=") && line_.size() == 5;
    const char told = is_told ? line_.back() : '\0';
    if (is_told && !next_line()) refuse(file_, number_, 1, "columns", "none", names_allowed);
    for (const char separator : {told, ';', '\t', ','}) {
      separator_ = separator;
      if (separator != '\0' && line_.find(separator) != std::string_view::npos) break;
    }
    for (const TableCell& cell : cells_of(line_, separator_)) {
      const auto column = grid_column(cell.text);
      if (!column || std::ranges::find(columns_, column->quantity, &GridColumn::quantity) != columns_.end()) {
        refuse(file_, number_, cell.column, "column", cell.text, names_allowed);
      }
      columns_.push_back(*column);
    }
    if (columns_.size() < largest.size()) refuse(file_, number_, 1, "columns", line_, names_allowed);
  }

  /// True where the line behind the header holds units and no numbers; they belong to the columns that have none.
  bool read_units() {
    const std::vector<TableCell> cells = cells_of(line_, separator_);
    if (cells.size() != columns_.size() || !std::ranges::all_of(cells, [](const TableCell& cell) { return grid_unit(cell.text).has_value(); }))
      return false;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      GridColumn& column = columns_[i];
      if (column.has_unit) refuse(file_, number_, cells[i].column, "unit", cells[i].text, "one unit: the header has it already");
      column.factor *= *grid_unit(cells[i].text) / (column.quantity == GridQuantity::Deviation ? units::um : 1.0);
    }
    return true;
  }

  Row read_row() const {
    const std::vector<TableCell> cells = cells_of(line_, separator_);
    if (cells.size() != columns_.size()) {
      refuse(file_, number_, 1, "line", line_,
             std::to_string(columns_.size()) + " numbers with the separator of the first line" +
                 (separator_ == ',' ? " (a comma, so no decimal commas)" : ""));
    }
    Row row;
    row.line = number_;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto quantity = static_cast<std::size_t>(columns_[i].quantity);
      const double factor = columns_[i].factor;
      double number = 0.0;
      if (!is_number(cells[i].text, number) || !(std::abs(number * factor) <= largest[quantity])) {
        const std::string most = text_of(largest[quantity] / std::abs(factor));
        refuse(file_, number_, cells[i].column, quantity_names[quantity], cells[i].text, "a number -" + most + " .. " + most);
      }
      row.values[quantity] = number * factor + 0.0;  // -0 and 0 are one number, whichever row comes first
    }
    return row;
  }

  static constexpr const char* names_allowed = "once each, radius_mm (or diameter_mm), z_mm, deviation_um (or removal_um)";
  static constexpr std::array<const char*, 3> quantity_names{"radius", "z", "deviation"};

  std::string_view rest_, line_;
  const std::string& file_;
  int number_{0};  ///< of line_, from 1
  char separator_{','};
  std::vector<GridColumn> columns_;  ///< in the order of the file
};

/// Sorted and without repetition.
std::vector<double> distinct(const std::vector<Row>& rows, double (Row::*coordinate)() const) {
  std::vector<double> values;
  for (const Row& row : rows) values.push_back((row.*coordinate)());
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::string place_of(double radius, double z) { return "radius_mm " + text_of(radius) + ", z_mm " + text_of(z); }

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
  const auto refuse_size = [&](const std::string& allowed) {
    refuse(name, 0, 0, "grid", std::to_string(m) + " radii with " + std::to_string(n) + " axial positions", allowed);
  };
  if (m < 2 || n < 2) refuse_size("at least 2 x 2");
  if (std::max(m, n) > most_grid_lines) refuse_size("at most " + std::to_string(most_grid_lines) + " of each");
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

MeasuredGrid read_grid(const std::string& path) { return parse_grid(read_table_file(path, largest_file), path); }

}  // namespace flankwright::studies
