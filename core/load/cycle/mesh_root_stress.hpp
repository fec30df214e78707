#pragma once

#include "core/base/for_each_index.hpp"
#include "core/load/cycle/mesh_model.hpp"

namespace flankwright {

/// Gives a mesh that was made without root stress what make_mesh_model() would have given it, if its effects call for root stress.
/// @throws InvalidInput  where the mesh is of the other flanks and the model of root stress does not know these
void add_root_stress_influence(MeshModel& mesh, const PairRootStress& root_stress, const ForEachIndex& for_each = {});

}  // namespace flankwright
