#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/rating/contact_peaks.hpp"

namespace flankwright::studies {

/// Positions of one mesh by their phase, each made once.
class PositionMemory {
 public:
  /// The mesh as `make` makes it, without what is known already made anew. This must outlive it.
  MeshAt remembering(MeshAt make) {
    return [this, make = std::move(make)](const std::vector<double>& phases) {
      std::vector<double> unknown;
      for (const double phase : phases) {
        if (!positions_.contains(phase)) unknown.push_back(phase);
      }
      if (!unknown.empty()) {
        MeshModel made = make(unknown);
        for (std::size_t i = 0; i < unknown.size(); ++i) positions_.emplace(unknown[i], std::move(made.positions[i]));
        made.positions.clear();
        mesh_ = std::move(made);
      }
      MeshModel mesh = *mesh_;
      for (const double phase : phases) mesh.positions.push_back(positions_.at(phase));
      return mesh;
    };
  }

 private:
  std::optional<MeshModel> mesh_;  ///< without positions
  std::map<double, MeshPosition> positions_;
};

}  // namespace flankwright::studies
