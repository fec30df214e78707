#include "core/rating/load_sharing.hpp"

namespace flankwright {

std::vector<ToothShare> load_sharing(const MeshPosition& at, const LoadedPosition& loaded) {
  std::vector<ToothShare> shares;
  if (!loaded.load.usable()) return shares;
  const double force = at.weight.dot(loaded.load.line_load);
  if (!(force > 0.0)) return shares;
  for (std::size_t i = 0; i < at.points.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (shares.empty() || shares.back().tooth != at.points[i].tooth) shares.push_back({at.points[i].tooth, 0.0});
    shares.back().share += at.weight[row] * loaded.load.line_load[row] / force;
  }
  return shares;
}

}  // namespace flankwright
