#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

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

/// Meshes of one pair and its materials. A search, the looks at what it finds and the load cases that are shown share them. May be used by several threads at a
/// time, which ask for meshes that differ in their placements alone.
///
/// Meshes that differ in their placements alone are kept and forgotten together, so that what is kept does not hang on the order in which threads make them. A mesh
/// that is forgotten is still known for as long as someone else has it.
class MeshStore {
 public:
  /// Influence values that the kept meshes may have [bytes]; those of the placements asked for last are kept whatever they have.
  static constexpr std::size_t most_bytes = std::size_t{512} << 20U;

  /// @param make  makes a mesh of the key at some of its phases, none of which the store has
  std::shared_ptr<const MeshModel> mesh(const MeshKey& key, const std::function<MeshModel(const std::vector<double>& phases)>& make);
  /// Null where the store does not have it.
  std::shared_ptr<const MeshModel> find(const MeshKey& key);

 private:
  struct Known {
    std::weak_ptr<const MeshModel> mesh;
    std::shared_ptr<const MeshModel> kept;  ///< null: forgotten
  };
  /// Meshes that differ in their placements alone.
  struct Group {
    MeshKey key;  ///< of one of them
    std::map<MeshPlacement, Known> meshes;
  };

  Group* group(const MeshKey& key);
  /// A mesh that differs from the one asked for in its phases alone; null where there is none.
  std::shared_ptr<const MeshModel> at_other_phases(const MeshKey& key);
  void forget_oldest();

  std::list<Group> groups_;  ///< those used last are first
  std::mutex mutex_;
};

}  // namespace flankwright
