#pragma once

#include <string>
#include <string_view>
#include <vector>

/// A load spectrum as a table (CSV):
///
///     # fleet, 2000 h
///     torque_Nm, speed_rpm, hours
///     320, 1500, 12
///
/// The first line names the columns: torque, speed, hours, cycles, temperature and mesh_misalignment in any order, each with its unit behind it (torque_Nm,
/// "torque [N·m]") or without one in that of a bare number in a study file. Comma, semicolon or tab separates cells, the first of tab and semicolon that the header has.
/// Numbers have a decimal point. # starts a comment; blank lines are skipped; an empty cell is not given.
namespace flankwright::studies {

/// A cell as text that a study file's value may be: a number, or a number and its unit.
struct SpectrumCell {
  std::string key;   ///< of load.spectrum[]: "torque"
  std::string text;  ///< "320" or "320 Nm"
  int line{0}, column{0};
};
using SpectrumRow = std::vector<SpectrumCell>;

/// @param name  stands for the file in messages
/// @throws StudyErrors with file, line and column of the first problem
std::vector<SpectrumRow> parse_spectrum(std::string_view text, const std::string& name);

/// @throws StudyErrors likewise, or where the file cannot be read
std::vector<SpectrumRow> read_spectrum_file(const std::string& path);

}  // namespace flankwright::studies
