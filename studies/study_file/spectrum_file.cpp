#include "studies/study_file/spectrum_file.hpp"

#include <array>

#include "studies/study_file/column_table.hpp"

namespace flankwright::studies {

namespace {

constexpr std::string_view spectrum_key = "load.spectrum";
constexpr std::array<std::string_view, 7> spectrum_columns{"torque",           "speed", "hours", "cycles", "temperature", "dynamic_factor",
                                                           "mesh_misalignment"};

}  // namespace

std::vector<SpectrumRow> parse_spectrum(std::string_view text, const std::string& name) {
  std::vector<TableColumn> columns;
  std::vector<SpectrumRow> rows;
  const auto add_row = [&](int line, const std::vector<TableCell>& cells) {
    SpectrumRow& row = rows.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i].text.empty()) continue;
      std::string value(cells[i].text);
      if (!columns[i].unit.empty()) value.append(" ").append(columns[i].unit);
      row.push_back({columns[i].name, std::move(value), line, cells[i].column});
    }
    if (row.empty()) refuse_cell(name, line, 1, spectrum_key, "(empty)", "allowed are rows with a torque");
  };
  read_table(
      text, name, {spectrum_key, spectrum_columns}, [&](int, const std::vector<TableColumn>& header) { columns = header; }, add_row);
  return rows;
}

std::vector<SpectrumRow> read_spectrum_file(const std::string& path) {
  constexpr std::size_t largest_file = 10'000'000;  // bytes: far more loads than can be analysed
  return parse_spectrum(read_table_file(path, largest_file), path);
}

}  // namespace flankwright::studies
