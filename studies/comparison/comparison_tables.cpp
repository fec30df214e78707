#include "studies/comparison/comparison_tables.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "studies/base/csv.hpp"
#include "studies/base/json_format.hpp"
#include "studies/base/printable.hpp"
#include "studies/base/value_with_unit.hpp"

namespace flankwright::studies {

namespace {

std::string number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.5g}", value); }

std::string change(double share) { return std::isnan(share) ? "-" : share == 0.0 ? "0" : fmt::format("{:+.3g} %", percent * share); }

/// A text in a cell of fixed width: its end, which tells runs apart, where it is too long.
std::string cell(std::string text, std::size_t width) {
  if (text.size() > width) text.replace(0, text.size() - width + 2, "..");
  return text;
}

constexpr std::size_t name_width = 38, unit_width = 10, run_width = 16;

std::string line(const std::string& name, const std::string& unit, const std::vector<std::string>& cells) {
  std::string text = fmt::format("{:<{}}  {:<{}}", name, name_width, unit, unit_width);
  for (const std::string& value : cells) text += fmt::format("  {:>{}}", cell(value, run_width), run_width);
  while (text.ends_with(' ')) text.pop_back();
  return text + "\n";
}

}  // namespace

double parse_tolerance(std::string_view text) {
  try {
    if (const double value = parse_percentage(text); value >= 0.0) return value;
  } catch (const InvalidInput&) {  // it is no percentage
  }
  throw InvalidInput("--tolerance", std::string(text), "a percentage of at least 0, such as 1%");
}

std::string comparison_table(const std::vector<ComparedRun>& runs, const ComparedRuns& compared) {
  std::vector<std::string> heading;
  for (const ComparedRun& run : runs) heading.push_back(printable(run.name));
  for (std::size_t run = 1; run < runs.size(); ++run) heading.push_back(runs.size() == 2 ? "change" : fmt::format("change of {}", run + 1));
  std::string table;
  if (!compared.keys.empty()) table += "keys that differ\n";
  for (const ComparedKey& key : compared.keys) {
    std::vector<std::string> cells;
    for (const std::string& value : key.values) cells.push_back(value.empty() ? "-" : printable(value));
    table += line("  " + printable(key.key), "", cells);
  }
  if (!table.empty()) table += "\n";
  table += line("", "", heading);
  std::string section;
  for (const ComparedValue& value : compared.values) {
    if (!value.headline) continue;
    if (value.section != section) table += printable(section = value.section) + "\n";
    std::vector<std::string> cells;
    for (const double of : value.values) cells.push_back(number(of));
    for (std::size_t run = 1; run < runs.size(); ++run)
      cells.push_back(std::isnan(value.values[run]) && std::isnan(value.values.front()) ? "-"
                      : value.differs(run, 0.0)                                         ? change(value.difference(run))
                                                                                        : "0");
    table += line("  " + (value.words.empty() ? value.name : value.words), value.unit == "-" ? "" : value.unit, cells);
  }
  return table;
}

std::string comparison_csv(const std::vector<ComparedRun>& runs, const ComparedRuns& compared) {
  std::string csv = "section,quantity,unit";
  for (const ComparedRun& run : runs) csv += fmt::format(",{}", csv_field(run.name));
  for (std::size_t run = 1; run < runs.size(); ++run) {
    csv += fmt::format(",{},{}", csv_field("difference " + runs[run].name), csv_field("percent " + runs[run].name));
  }
  csv += "\n";
  for (const ComparedValue& value : compared.values) {
    csv += fmt::format("{},{},{}", csv_field(value.section), csv_field(value.name), csv_field(value.unit));
    for (const double of : value.values) csv += fmt::format(",{}", csv_field(of));
    for (std::size_t run = 1; run < runs.size(); ++run) {
      csv += fmt::format(",{},{}", csv_field(value.values[run] - value.values.front()), csv_field(percent * value.difference(run)));
    }
    csv += "\n";
  }
  return csv;
}

std::vector<std::string> differing_lines(const std::vector<ComparedRun>& runs, const ComparedRuns& compared, double tolerance) {
  std::vector<std::string> lines;
  for (const ComparedValue& value : compared.values) {
    for (std::size_t run = 1; run < runs.size(); ++run) {
      if (!value.differs(run, tolerance)) continue;
      lines.push_back(fmt::format("{}: {} = {} instead of {}{}{} ({})", printable(value.section), value.name, number(value.values[run]),
                                  number(value.values.front()), value.unit == "-" ? "" : " " + value.unit,
                                  runs.size() == 2 ? "" : " in " + printable(runs[run].name),
                                  std::isnan(value.difference(run)) ? std::string("only one has it") : change(value.difference(run))));
    }
  }
  return lines;
}

}  // namespace flankwright::studies
