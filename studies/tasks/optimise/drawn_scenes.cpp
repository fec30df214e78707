#include "studies/tasks/optimise/drawn_scenes.hpp"

#include "optimize/sampling/sample_design.hpp"
#include "studies/study_file/sweep_value.hpp"

namespace flankwright::studies {

namespace {

/// What the scene has where values are added to it; misalignments only.
double present(const Scene& scene, const std::string& path) {
  for (const NamedMisalignmentParameter& p : misalignment_parameters) {
    if (path == "misalignment." + std::string(p.name)) return scene.misalignment.*(p.parameter);
  }
  return 0.0;
}

void put(Scene& scene, const SceneTolerance& tolerance, double value) {
  const SchemaKey& key = *study_keys().at(tolerance.path);
  if (tolerance.pitch) return set_drawn_pitch(scene.error[key.member], *tolerance.pitch, value);
  double inside = internal_value(value, key.quantity);
  if (tolerance.added) inside += present(scene, tolerance.path);
  if (const auto* parameter = std::get_if<ModificationParameter>(&key.store)) {
    scene.deviations.push_back({key.member, *parameter, inside});
    return;
  }
  std::get<StoreInScene>(key.store)(scene, key.member, Value{.number = inside, .numbers = {inside}});
}

}  // namespace

std::vector<Scene> draw_scenes(const Study& study, const DrawnScenes& drawn) {
  return draw_scenes(study, study.optimise.assessment.tolerances, drawn);
}

std::vector<Scene> draw_scenes(const Study& study, const std::vector<SceneTolerance>& tolerances, const DrawnScenes& drawn) {
  std::vector<Scene> scenes;
  if (drawn.samples == 0) return scenes;
  const SampleDesign design(Sampler::Sobol, drawn.samples, static_cast<int>(tolerances.size()), drawn.seed);
  for (int i = 0; i < drawn.samples; ++i) {
    Scene scene = study.scenes.front();
    scene.name = "drawn " + std::to_string(i + 1);
    scene.weight = 1.0;
    const std::vector<double> point = design.point(i);
    for (std::size_t k = 0; k < tolerances.size(); ++k) put(scene, tolerances[k], tolerances[k].distribution.quantile(point[k]));
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

}  // namespace flankwright::studies
