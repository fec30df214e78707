#include "studies/exchange/rexs/flank_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"
#include "core/flank/measured_grid.hpp"
#include "studies/exchange/rexs/study_text.hpp"

namespace flankwright::studies::rexs {

namespace {

constexpr int lines_of_change = 81;  ///< of a direction along which something changes: a relief over a tenth of the flank has eight of them
constexpr int lines_without = 3;     ///< of one along which nothing does
constexpr int looks = 4;             ///< points between two lines at which the departure is sought

double sum_of(const std::vector<FlankPart>& parts, double r, double z) {
  double sum = 0.0;
  for (const FlankPart& part : parts) sum += part.removed(r, z);
  return sum;
}

}  // namespace

GriddedParts grid_of(const std::vector<FlankPart>& parts, const FlankFrame& frame, double base_helix_angle) {
  const auto lines = [&](bool FlankPart::*changes) { return std::ranges::any_of(parts, changes) ? lines_of_change : lines_without; };
  GriddedParts result{.text = "radius_mm,z_mm,deviation_um\n", .radii = lines(&FlankPart::along_profile), .positions = lines(&FlankPart::along_face)};
  const auto roll = [&](double r) { return std::sqrt(std::max(0.0, (r - frame.base_radius) * (r + frame.base_radius))); };
  // Points must lie off the base circle, where the start of active profile may lie.
  const double first = std::max(roll(frame.active_root_radius), 0.01 * roll(frame.tip_radius)), last = roll(frame.tip_radius);
  const auto radius = [&](double share) { return std::hypot(frame.base_radius, std::lerp(first, last, share)); };
  const auto position = [&](double share) { return (share - 0.5) * frame.face_width; };
  const double cosine = std::cos(base_helix_angle);

  MeasuredGrid grid;
  for (int i = 0; i < result.radii; ++i) grid.radii.push_back(radius(static_cast<double>(i) / (result.radii - 1)));
  for (int j = 0; j < result.positions; ++j) grid.z.push_back(position(static_cast<double>(j) / (result.positions - 1)));
  grid.deviation.resize(result.radii, result.positions);
  for (int i = 0; i < result.radii; ++i) {
    for (int j = 0; j < result.positions; ++j) {
      const double r = grid.radii[static_cast<std::size_t>(i)], z = grid.z[static_cast<std::size_t>(j)];
      grid.deviation(i, j) = -sum_of(parts, r, z) * cosine;
      result.text += fmt::format("{},{},{}\n", number_text(r), number_text(z), number_text(grid.deviation(i, j) / units::um));
    }
  }

  const GridFit fit = make_grid_field(grid, frame.base_radius, base_helix_angle);
  const int rows = looks * (result.radii - 1), columns = looks * (result.positions - 1);
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j) {
      const double r = radius(static_cast<double>(i) / rows), z = position(static_cast<double>(j) / columns);
      result.departure = std::max(result.departure, std::abs(fit.field->at(roll(r), z).value - sum_of(parts, r, z)));
    }
  }
  return result;
}

}  // namespace flankwright::studies::rexs
