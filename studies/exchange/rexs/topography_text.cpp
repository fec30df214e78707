#include "studies/exchange/rexs/topography_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/units.hpp"
#include "studies/exchange/rexs/study_text.hpp"

namespace flankwright::studies::rexs {

std::string topography_text(const std::vector<TopographyPoint>& points, const std::string& name, double base_helix) {
  std::string grid = "# " + name + "\nradius_mm,z_mm,deviation_um\n";
  for (const TopographyPoint& point : points) {
    const double normal = -point.removed * std::cos(base_helix);
    grid += fmt::format("{},{},{}\n", number_text(point.radius), number_text(point.z), number_text(normal / units::um));
  }
  return grid;
}

}  // namespace flankwright::studies::rexs
