#pragma once

#include "core/load/mesh_model.hpp"

namespace flankwright {

/// The same gears with other effects or another placement: what gears and materials alone settle is taken from the model, the rest is made
/// anew as make_mesh_model() makes it.
/// @throws InvalidInput  as make_mesh_model()
MeshModel mesh_with_effects(MeshModel model, const MeshResolution& resolution, const MeshEffects& effects, const MeshPlacement& placement,
                            const PairCompliance& structure, const PairRootStress* root_stress, const PairCompliance* shafts);

}  // namespace flankwright
