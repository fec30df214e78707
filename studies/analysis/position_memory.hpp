#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "core/rating/contact_peaks.hpp"

namespace flankwright::studies {

/// Positions of one mesh by their phase, each made once. May be used by several threads at a time.
class PositionMemory {
 public:
  /// Influence values that all kept positions may have [bytes]; positions beyond that are made each time.
  static constexpr std::size_t most_bytes = std::size_t{256} << 20U;

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
        for (const auto& [phase, position] : made) keep(phase, position);
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
  void keep(double phase, const MeshPosition& position) {
    const std::size_t bytes = sizeof(double) * static_cast<std::size_t>(position.influence.size());
    if (bytes_ + bytes > most_bytes || !positions_.emplace(phase, position).second) return;
    bytes_ += bytes;
  }

  std::mutex mutex_;
  std::optional<MeshModel> mesh_;  ///< without positions
  std::map<double, MeshPosition> positions_;
  std::size_t bytes_{0};
};

}  // namespace flankwright::studies
