#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace flankwright::studies {

/// Quantity of a column of a grid file.
enum class GridQuantity { Radius, Z, Deviation };

/// A column as its header cell says it: value inside [mm, deviation + = metal added] = number in the file * factor.
struct GridColumn {
  GridQuantity quantity{GridQuantity::Radius};
  double factor{1.0};
  bool has_unit{false};  ///< without one, a line of units may follow; mm and, for deviations, um is meant otherwise
};

/// Reads a header cell: a name (radius, r, diameter, d; z, width, face; deviation, removal ...; German ones too), and a unit behind it
/// (radius_mm, "radius [mm]", "z (mm)", "deviation/µm"). Upper and lower case, quotes and blanks do not count.
/// @return  nullopt where it is none of these
std::optional<GridColumn> grid_column(std::string_view cell);

/// Size in mm of "mm", "um", "µm", "mum", "in", "mil", with or without brackets; nullopt for anything else.
std::optional<double> grid_unit(std::string_view cell);

}  // namespace flankwright::studies
