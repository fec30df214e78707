#include "studies/study_file/signal_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/base/error.hpp"
#include "studies/base/value_with_unit.hpp"
#include "studies/study_file/column_table.hpp"

namespace flankwright::studies {

namespace {

constexpr std::string_view signal_key = "load.spectrum.signal";

struct SignalQuantity {
  std::string_view name;
  Quantity quantity;
  double largest;  ///< magnitude, in the unit of a bare number
  std::vector<double> LoadSignal::*values;
};

constexpr std::array<SignalQuantity, 3> signal_quantities{{{"time", Quantity::Time, 1e10, &LoadSignal::time},
                                                           {"torque", Quantity::Torque, 1e9, &LoadSignal::torque},
                                                           {"speed", Quantity::RotationalSpeed, 1e6, &LoadSignal::speed}}};
constexpr std::array<std::string_view, 3> signal_columns{signal_quantities[0].name, signal_quantities[1].name, signal_quantities[2].name};

/// A column that is read into a signal.
struct SignalColumn {
  const SignalQuantity* of;
  double factor;  ///< internal value of a 1 in the file
};

class SignalReading {
 public:
  explicit SignalReading(const std::string& file) : file_(file) {}

  void read_header(int line, const std::vector<TableColumn>& header) {
    for (const TableColumn& column : header) {
      const auto* of = std::ranges::find(signal_quantities, column.name, &SignalQuantity::name);
      columns_.push_back({of, factor_of(line, column, of->quantity)});
    }
    for (const std::string_view required : {signal_columns[0], signal_columns[1]}) {
      if (std::ranges::find(header, required, &TableColumn::name) == header.end()) {
        refuse_cell(file_, line, 1, signal_key, "(no column " + std::string(required) + ")", "required are the columns time and torque");
      }
    }
  }

  void read_row(int line, const std::vector<TableCell>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const SignalColumn& column = columns_[i];
      std::vector<double>& values = signal_.*(column.of->values);
      values.push_back(column.factor * number_of(line, cells[i], *column.of));
      const bool goes_on = column.of->quantity != Quantity::Time || values.size() < 2 || values.back() > values[values.size() - 2];
      if (!goes_on) refuse_cell(file_, line, cells[i].column, signal_key, cells[i].text, "allowed is a time above that of the line before");
    }
    if (signal_.time.size() > most_samples) {
      refuse_cell(file_, line, 1, signal_key, "more", "allowed are at most " + std::to_string(most_samples) + " samples");
    }
    last_line_ = line;
  }

  LoadSignal take() {
    if (signal_.time.size() < 2) refuse_cell(file_, last_line_, 1, signal_key, "one sample", "allowed are at least two samples");
    return std::move(signal_);
  }

 private:
  double factor_of(int line, const TableColumn& column, Quantity quantity) const {
    if (column.unit.empty()) return internal_value(1.0, quantity);
    try {
      return parse_value_with_unit("1 " + column.unit, quantity);
    } catch (const InvalidInput& problem) {
      refuse_cell(file_, line, column.cell.column, signal_key, column.cell.text, "allowed behind the name is the unit of " + problem.allowed());
    }
  }

  double number_of(int line, const TableCell& cell, const SignalQuantity& of) const {
    double number = 0.0;
    const char* const end = cell.text.data() + cell.text.size();
    const std::from_chars_result found = std::from_chars(cell.text.data(), end, number);
    const bool is_number = found.ec == std::errc{} && found.ptr == end && std::isfinite(number) && std::abs(number) <= of.largest;
    if (!is_number) {
      refuse_cell(file_, line, cell.column, signal_key, cell.text,
                  "allowed is a number with a decimal point, of a magnitude of at most " + in_words(of.largest));
    }
    return number;
  }

  const std::string& file_;
  std::vector<SignalColumn> columns_;
  LoadSignal signal_;
  int last_line_{0};
};

}  // namespace

LoadSignal parse_signal(std::string_view text, const std::string& name) {
  SignalReading reading(name);
  read_table(
      text, name, {signal_key, signal_columns}, [&](int line, const std::vector<TableColumn>& header) { reading.read_header(line, header); },
      [&](int line, const std::vector<TableCell>& cells) { reading.read_row(line, cells); });
  return reading.take();
}

LoadSignal read_signal_file(const std::string& path) { return parse_signal(read_table_file(path, 100 * most_samples), path); }

}  // namespace flankwright::studies
