#pragma once

#include <set>
#include <string>
#include <vector>

#include "optimize/design/problem/design_task.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// The scenes of an optimisation as results list them.
class ListedScenes {
 public:
  /// @param task  must outlive this
  explicit ListedScenes(const DesignTask& task) : task_(task), spectra_(task.combined_objective().over_spectrum()) {
    std::set<double> torques;
    for (const DesignScene& scene : task.scenes) torques.insert(scene.torque);
    names_torque_ = !spectra_ && torques.size() > 1;
  }

  /// Indices of the task's scenes: every load case, or the first of each load spectrum where the objective is a sum over it.
  std::vector<std::size_t> indices() const {
    std::vector<std::size_t> listed;
    std::set<int> known;
    for (std::size_t s = 0; s < task_.scenes.size(); ++s) {
      if (!spectra_ || known.insert(task_.scenes[s].spectrum).second) listed.push_back(s);
    }
    return listed;
  }
  /// Whether a scene has a torque by which it differs from another of its name.
  bool names_torque() const { return names_torque_; }
  /// Of a scene [N·m]; NaN where a load spectrum has many, which results.json writes as null.
  double torque(const DesignScene& scene) const { return spectra_ ? not_given : in_Nm(scene.torque); }
  /// Of a load case, or of a whole load spectrum.
  double weight(const DesignScene& scene) const {
    if (!spectra_) return scene.weight;
    double sum = 0.0;
    for (const DesignScene& of : task_.scenes) sum += of.spectrum == scene.spectrum ? of.weight : 0.0;
    return sum;
  }

 private:
  const DesignTask& task_;
  bool spectra_, names_torque_{false};
};

}  // namespace flankwright::studies
