#include "studies/analysis/requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/units.hpp"
#include "core/gear/both_gears.hpp"
#include "core/rating/shaft_misalignment.hpp"

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

std::optional<FlankMotion> largest_flank_motion(const StudyResults& results, const LoadedResult& loaded) {
  if (!results.shafts || !loaded.cycle.usable()) return std::nullopt;
  const MeshModel& model = results.models[loaded.model];
  const GearPair& pair = model.pair;
  std::vector<FlankMotion> motions;
  const double working_depth = pair.pinion.tip_radius + pair.wheel.tip_radius - pair.centre_distance;
  for (const PerGear<ShaftMotion>& of : loaded.shaft_motions) {
    double apart = 0.0;
    for (const Member m : both_gears) apart += results.shafts->has_shaft(m) ? of[m].displacement : 0.0;
    motions.push_back({"the pair", false, std::abs(apart), working_depth});
    motions.push_back({"the pair", true, std::abs(opened_by(*results.shafts, of)), pair.data.normal_module});
  }
  if (results.shafts->has_unit()) {
    const ShaftPair shafts = shafts_under(*results.shafts, model, loaded.torque);
    const std::vector<UnitMesh>& meshes = results.study.unit.meshes;
    const UnitState unit = shafts.state(loaded.torque, model.axial_offset);  // the pair first, then the meshes as the study has them
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const MeshState& state = unit.meshes[m + 1];
      if (!std::isnan(state.misalignment)) motions.push_back({state.name, true, std::abs(state.misalignment), meshes[m].normal_module});
    }
  }
  return *std::ranges::max_element(motions, {}, &FlankMotion::excess);
}

void add_unmet_by_shafts(StudyResults& results) {
  const LoadedResult* worst = nullptr;
  std::optional<FlankMotion> largest;
  for (const LoadedResult& loaded : results.loaded) {
    const std::optional<FlankMotion> of = largest_flank_motion(results, loaded);
    if (!of || !(of->excess() > (largest ? largest->excess() : 1.0))) continue;
    largest = of;
    worst = &loaded;
  }
  if (!largest) return;
  results.requirements.push_back(fmt::format(
      "scene \"{}\" at {:.6g} N·m: shafts and bearings move the flanks of {} by {:.3g} mm in the plane of action{}, more than the {} of {:.3g} mm: the teeth cannot mesh, and no "
      "result of this load case holds",
      worst->scene, worst->torque / units::newton_metre, largest->mesh, largest->motion,
      largest->is_misalignment ? " from one end of the face to the other" : "", largest->is_misalignment ? "normal module" : "working depth",
      largest->limit));
}

}  // namespace flankwright::studies
