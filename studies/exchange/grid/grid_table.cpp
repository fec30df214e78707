#include "studies/exchange/grid/grid_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "core/flank/flank.hpp"
#include "core/flank/measured_grid.hpp"
#include "studies/base/printable.hpp"
#include "studies/exchange/rexs/rexs_model.hpp"

namespace flankwright::studies {

void GridLayout::validate() const {
  for (const int points : {profile_points, face_points}) {
    if (points < 2 || points > most_grid_lines) {
      throw InvalidInput("grid points", std::to_string(points), fmt::format("2 .. {} along the profile and along the face", most_grid_lines));
    }
  }
  if (!(margin >= 0.0 && margin <= 0.4)) throw InvalidInput("grid margin", fmt::format("{}", margin), "a share 0 .. 0.4");
}

GridLayout grid_layout(const std::string& points, double margin) {
  const std::size_t cross = std::min(points.find('x'), points.size());
  const auto profile = rexs::whole_number(points.substr(0, cross));
  const auto face = cross < points.size() ? rexs::whole_number(points.substr(cross + 1)) : std::nullopt;
  if (!profile || !face) throw InvalidInput("--grid-points", points, "points along the profile x along the face, as 9x15");
  GridLayout layout{*profile, *face, margin};
  layout.validate();
  return layout;
}

GridTable grid_table(const GearPair& pair, Member member, const Modification& modification, const GridLayout& layout, const std::string& title) {
  layout.validate();
  const Gear& gear = pair[member];
  const Flank flank = make_flank(pair, member, modification, {});
  const auto radius_at = [&](double share) {
    return std::lerp(gear.active_root_radius, gear.tip_form_radius, std::lerp(layout.margin, 1.0 - layout.margin, share));
  };
  const auto z_at = [&](double share) { return (std::lerp(layout.margin, 1.0 - layout.margin, share) - 0.5) * gear.data.face_width; };
  const double to_normal = -std::cos(pair.base_helix_angle);
  GridTable table{.text = fmt::format("# {}: {}, {} flank, {} teeth, {} x {} points (profile x face)\n"
                                      "# Start of active profile at diameter {:.6f} mm, tip at {:.6f} mm, face width {:.6f} mm; z from mid face.\n"
                                      "# Design against the involute, normal to the flank, + = metal added; manufacturing errors are not in it.\n"
                                      "radius_mm,z_mm,deviation_um\n",
                                      without_control_characters(title), name_of(member), name_of(pair.data.working_flank), gear.data.teeth,
                                      layout.profile_points, layout.face_points, 2.0 * gear.active_root_radius, 2.0 * gear.tip_form_radius,
                                      gear.data.face_width)};
  MeasuredGrid points;
  const int rows = layout.profile_points - 1, columns = layout.face_points - 1;
  for (int i = 0; i <= rows; ++i) points.radii.push_back(radius_at(static_cast<double>(i) / rows));
  for (int j = 0; j <= columns; ++j) points.z.push_back(z_at(static_cast<double>(j) / columns));
  points.deviation.resize(layout.profile_points, layout.face_points);
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j) {
      const double radius = points.radii[static_cast<std::size_t>(i)], z = points.z[static_cast<std::size_t>(j)];
      points.deviation(i, j) = flank.deviation(flank.roll_at(radius), z, 0) * to_normal;
      table.text += fmt::format("{:.6f},{:.6f},{:.4f}\n", radius, z, points.deviation(i, j) / units::um + 0.0);
    }
  }
  GridFit through;
  try {
    through = make_grid_field(points, gear.base_radius, pair.base_helix_angle);
  } catch (const InvalidInput& error) {
    table.departure = not_given;
    table.unreadable = error.what();
    return table;
  }
  constexpr int looks = 4;  // between two lines
  for (int i = 0; i <= looks * rows; ++i) {
    for (int j = 0; j <= looks * columns; ++j) {
      const double roll = flank.roll_at(radius_at(static_cast<double>(i) / (looks * rows))), z = z_at(static_cast<double>(j) / (looks * columns));
      table.departure = std::max(table.departure, std::abs((through.field->at(roll, z).value - flank.deviation(roll, z, 0)) * to_normal));
    }
  }
  return table;
}

}  // namespace flankwright::studies
