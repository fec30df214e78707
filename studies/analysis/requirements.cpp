#include "studies/analysis/requirements.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flankwright::studies {

void add_unmet_by_load_cases(StudyResults& results) {
  std::vector<std::string>& unmet = results.requirements;
  for (const UnloadedResult& unloaded : results.unloaded) {
    if (unloaded.mesh.missing == 0) continue;
    unmet.push_back(fmt::format("scene \"{}\": no tooth pair touches at {} of the mesh positions", unloaded.scene, unloaded.mesh.missing));
  }
  for (const LoadedResult& loaded : results.loaded) {
    if (loaded.cycle.usable()) continue;
    const auto apart = std::ranges::count_if(loaded.cycle.positions,
                                             [](const LoadedPosition& position) { return position.load.status == LoadStatus::NoContactPoints; });
    if (apart > 0) {
      unmet.push_back(
          fmt::format("scene \"{}\": no point of the flanks can touch the mate at {} mesh positions; misalignment may have moved the faces past "
                      "each other",
                      loaded.scene, apart));
    }
    if (loaded.cycle.failures > apart) {
      unmet.push_back(
          fmt::format("scene \"{}\": the load distribution did not converge at {} mesh positions", loaded.scene, loaded.cycle.failures - apart));
    }
  }
}

}  // namespace flankwright::studies
