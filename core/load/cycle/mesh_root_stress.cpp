#include "core/load/cycle/mesh_root_stress.hpp"

#include "core/base/error.hpp"

namespace flankwright {

void add_root_stress_influence(MeshModel& mesh, const PairRootStress& root_stress, const ForEachIndex& for_each) {
  const bool other_flanks = mesh.placement.other_flanks;
  const std::shared_ptr<const PairRootStress> of_others = other_flanks ? root_stress.on_other_flanks() : nullptr;
  if (other_flanks && !of_others) throw InvalidInput("working_flank", "the other flanks", "the pair's own with this model of root stress");
  const MeshParts parts{
      .pair = mesh.pair, .material = mesh.material, .placement = mesh.placement, .root_stress = other_flanks ? of_others.get() : &root_stress};
  run_for_each(for_each, mesh.positions.size(), [&](std::size_t i) {
    MeshPosition& position = mesh.positions[i];
    MeshBuilder builder(parts, position.phase);
    builder.set_points(position.points);
    mesh.effects.act(EffectStage::Roots, builder);
    position.root_stress = std::move(builder.root_stress);
  });
}

}  // namespace flankwright
