#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <vector>

#include "optimize/design_task.hpp"
#include "optimize/scene_outputs.hpp"

namespace flankwright {

/// All scenes of a task analysed for one design.
struct DesignAnalysis {
  Modification pinion_modification, wheel_modification;
  std::vector<LoadedCycle> cycles;  ///< one per scene
};

/// A design task ready to be analysed: mesh models built once, scenes analysed in parallel.
///
/// Designs are given scaled: x_i = (value - lower) / (upper - lower), 0 .. 1.
class DesignProblem {
 public:
  /// @throws InvalidInput where the task has no scene, variable or objective, a bound pair is empty, the
  /// mesh positions do not resolve a harmonic asked for, root stress is asked for without a model of it, or the models
  /// cannot be built
  explicit DesignProblem(DesignTask task);

  const DesignTask& task() const { return task_; }
  int variables() const { return static_cast<int>(task_.variables.size()); }
  int scenes() const { return static_cast<int>(task_.scenes.size()); }
  const MeshModel& model(int scene) const { return *models_[static_cast<std::size_t>(scene)]; }

  /// The scaled design that the task's own modifications stand for, moved into the bounds where it lies outside.
  Eigen::VectorXd start() const;
  /// Value of variable i [mm; parabolic_te 1/rad].
  double unscaled(const Eigen::VectorXd& x, int i) const;
  /// Modifications of a scaled design.
  void apply(const Eigen::VectorXd& x, Modification& pinion, Modification& wheel) const;

  /// Analyses every scene; derivatives are with respect to the unscaled variables. The last analysis is kept and returned
  /// again for the same x (upgraded by a new run where derivatives are missing).
  const DesignAnalysis& analyse(const Eigen::VectorXd& x, bool with_derivatives);
  /// Analyses the task's own modifications as given, whatever the bounds.
  DesignAnalysis analyse_given() const;
  /// Analyses any modifications; neither remembered nor counted.
  DesignAnalysis analyse_design(const Modification& pinion, const Modification& wheel) const { return run(pinion, wheel, false); }
  /// One scene of that, with derivatives by any parameters.
  LoadedCycle analyse_scene(int scene, const Modification& pinion, const Modification& wheel,
                            const std::vector<MeshParameter>& parameters = {}) const;

  /// Runs of analyse() that were computed, not remembered.
  int analyses() const { return analyses_; }

  /// Weighted sum of the objective's outputs in one scene, outside units.
  double scene_measure(const DesignAnalysis& analysis, int scene) const;
  double scene_measure(const LoadedCycle& cycle, int scene) const;
  /// The scenes' measures combined as the task says.
  double objective(const DesignAnalysis& analysis) const;
  /// Largest value of a bounded output over the scenes, inside unit.
  double constraint_value(const DesignAnalysis& analysis, const OutputConstraint& constraint) const;
  /// Gradient of a candidate of one scene with respect to the scaled variables.
  Eigen::VectorXd scaled(const Eigen::VectorXd& gradient) const;

 private:
  DesignAnalysis run(const Modification& pinion, const Modification& wheel, bool with_derivatives) const;

  DesignTask task_;
  std::map<MeshPlacement, std::unique_ptr<MeshModel>> models_by_placement_;
  std::vector<const MeshModel*> models_;  ///< per scene
  std::vector<MeshParameter> parameters_;
  Eigen::VectorXd last_x_;
  bool last_has_derivatives_{false};
  DesignAnalysis last_;
  int analyses_{0};
};

/// Combines scene measures: the first, the largest, or the weighted mean (plus twice the weighted standard deviation).
double aggregate(Aggregate over, const std::vector<double>& measures, const std::vector<double>& weights);

/// d(aggregate)/d(measure); at a tie of the largest, the first carries it all; at sigma = 0 the spread counts nothing.
std::vector<double> aggregate_weights(Aggregate over, const std::vector<double>& measures, const std::vector<double>& weights);

}  // namespace flankwright
