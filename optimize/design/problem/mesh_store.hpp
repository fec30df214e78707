#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <mutex>

#include "core/load/cycle/mesh_model.hpp"

namespace flankwright {

/// What distinguishes one mesh of a pair from another.
struct MeshKey {
  MeshPlacement placement;
  MeshResolution resolution;
  EffectList effects;
  std::shared_ptr<const PairCompliance> structure;    ///< null: thin slices
  std::shared_ptr<const PairRootStress> root_stress;  ///< null: none
  std::shared_ptr<const PairCompliance> shafts;       ///< null: rigid
};

/// Meshes of one pair and its materials. A search, the looks at what it finds and the load cases that are shown share them. Those used last are kept.
/// May be used by several threads at a time.
class MeshStore {
 public:
  /// Influence values that all kept meshes may have [bytes].
  static constexpr std::size_t most_bytes = std::size_t{512} << 20U;

  /// @param make  makes a mesh that the store does not have
  std::shared_ptr<const MeshModel> mesh(const MeshKey& key, const std::function<MeshModel()>& make);
  /// Null where the store does not have it.
  std::shared_ptr<const MeshModel> find(const MeshKey& key);

 private:
  struct Kept {
    MeshKey key;
    std::shared_ptr<const MeshModel> mesh;
    std::size_t bytes;
  };
  std::list<Kept> kept_;  ///< those used last are first
  std::mutex mutex_;
};

}  // namespace flankwright
