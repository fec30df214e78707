#pragma once

#include <string>
#include <string_view>

#include "core/flank/measured_grid.hpp"

/// A measured or topological flank as a table of its points (CSV):
///
///     # 17/44, pinion
///     radius_mm, z_mm, deviation_um
///     52.8, -42, -3.5
///
/// Axial positions count from mid face; deviations are normal to the flank, + = metal added. Columns have any
/// order, named by the first line as grid_header.hpp says, with their units there or in a line of their own below; semicolon, tab or
/// comma, the first of these that the header has, separates cells throughout, or what a line sep=; before it says. Numbers have a
/// decimal point, or a decimal comma where the comma does not separate or the cell is in double quotes. # starts a comment, % and // a
/// line of it; blank lines are skipped; lines end with LF, CR LF or CR; a byte order mark of UTF-8 is skipped. The points have any
/// order and fill a rectangular grid: every radius with every z, the same numbers in each line that shares them.
namespace flankwright::studies {

/// Reads a grid file. Nothing is checked here that needs the gear: see validate() and check_coverage() in
/// measured_grid.hpp.
///
/// @param path  as the system finds it
/// @throws StudyErrors with the first problem: file, line, column of the character, name of the column and what is
/// written there; a file that cannot be read is a problem without a line
MeasuredGrid read_grid(const std::string& path);

/// The same for a text.
///
/// @param name  stands for the file in messages
MeasuredGrid parse_grid(std::string_view text, const std::string& name);

}  // namespace flankwright::studies
