#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "core/rating/contact_peaks.hpp"

namespace flankwright::studies {

/// Positions of one mesh by their phase, each made once. May be used by several threads at a time.
class PositionMemory {
 public:
  /// Positions that are kept; later ones are made each time. Some hundred megabytes on a wide gear.
  static constexpr std::size_t most = 4096;

  /// The mesh as `make` makes it, without what is known already made anew. This must outlive it.
  MeshAt remembering(MeshAt make) {
    return [this, make = std::move(make)](const std::vector<double>& phases) {
      std::vector<double> unknown;
      {
        const std::lock_guard lock(mutex_);
        for (const double phase : phases) {
          if (!positions_.contains(phase)) unknown.push_back(phase);
        }
      }
      std::map<double, MeshPosition> made;
      if (!unknown.empty()) {
        MeshModel mesh = make(unknown);
        for (std::size_t i = 0; i < unknown.size(); ++i) made.emplace(unknown[i], std::move(mesh.positions[i]));
        mesh.positions.clear();
        const std::lock_guard lock(mutex_);
        if (!mesh_) mesh_ = std::move(mesh);
        if (positions_.size() < most) positions_.insert(made.begin(), made.end());
      }
      const std::lock_guard lock(mutex_);
      MeshModel mesh = *mesh_;
      for (const double phase : phases) {
        const auto known = made.find(phase);
        mesh.positions.push_back(known != made.end() ? known->second : positions_.at(phase));
      }
      return mesh;
    };
  }

 private:
  std::mutex mutex_;
  std::optional<MeshModel> mesh_;  ///< without positions
  std::map<double, MeshPosition> positions_;
};

}  // namespace flankwright::studies
