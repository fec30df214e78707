#pragma once

#include <string>
#include <string_view>
#include <vector>

/// A load spectrum as a table of its bins, see column_table.hpp. The columns are torque, speed, hours, cycles, temperature and mesh_misalignment; without a unit a
/// column is in that of a bare number in a study file; an empty cell is not given.
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
