#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Tables of named columns (CSV), as load spectra and signals are.
///
///     # fleet, 2000 h
///     torque_Nm, speed_rpm, hours
///     320, 1500, 12
///
/// The first line names the columns, in any order, each with its unit behind it (torque_Nm, "torque [N·m]") or without one. Comma, semicolon or tab separates cells,
/// the first of semicolon and tab that the header has. Numbers have a decimal point. # starts a comment; blank lines are skipped.
namespace flankwright::studies {

/// A cell without blanks and quotes around it.
struct TableCell {
  std::string_view text;
  int column;  ///< of its first character, from 1
};

/// A name of the header, and the unit behind it.
struct TableColumn {
  std::string name, unit;
  TableCell cell;  ///< both as written
};

/// What a table is read as.
struct TableKind {
  std::string_view key;                       ///< of the study, for messages: "load.spectrum"
  std::span<const std::string_view> columns;  ///< names that are known
};

/// Reads a table line by line.
///
/// @param name    stands for the file in messages
/// @param header  is called once with the columns and the number of their line
/// @param row     is called for each line of cells, one for each column, with the number of the line
/// @throws StudyErrors with file, line and column of the first problem: an unknown or repeated column, a line with another number of cells, or no line of cells
void read_table(std::string_view text, const std::string& name, const TableKind& kind,
                const std::function<void(int line, const std::vector<TableColumn>&)>& header,
                const std::function<void(int line, const std::vector<TableCell>&)>& row);

/// The text of a file of at most so many bytes.
/// @throws StudyErrors without a line where it cannot be read or is larger
std::string read_table_file(const std::string& path, std::size_t largest);

/// Throws StudyErrors with this problem.
[[noreturn]] void refuse_cell(const std::string& file, int line, int column, std::string_view key, std::string_view value,
                              const std::string& allowed);

}  // namespace flankwright::studies
