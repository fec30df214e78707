#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "optimize/design/problem/design_task.hpp"
#include "optimize/design/outputs/scene_outputs.hpp"

namespace flankwright {

/// All scenes of a task analysed for one design.
struct DesignAnalysis {
  PerGear<Modification> modification;
  std::vector<LoadedCycle> cycles;  ///< one per scene

  /// Whether every scene was solved.
  bool usable() const;
};

/// A design task ready to be analysed: mesh models built once, scenes analysed in parallel. A copy shares the models and
/// counts its own analyses, so that copies may be used in different threads.
///
/// Designs are given scaled: x_i = DesignVariable::scaled(), 0 .. 1.
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
  /// A load case of an analysis with all that outputs may need.
  LoadedScene scene(const DesignAnalysis& analysis, int scene) const;
  /// The same of a cycle by itself, without its spectrum.
  LoadedScene scene_of(const LoadedCycle& cycle, int scene) const;
  /// Scenes in which an output has a value of its own: the first of each load spectrum where it is a sum over it, else all.
  std::vector<int> judged_scenes(const ObjectiveTerm& term) const;

  /// The same scenes and variables judged by other objectives, models shared; nothing analysed yet.
  DesignProblem judged_by(const Objective& objective, std::vector<ObjectiveBound> bounds, std::vector<ScalarisedObjective> scalarisation = {}) const;

  /// The same task over some of its scenes only, models shared; no analysis counted yet, the last one kept for these scenes.
  /// @param scenes  different indices, at least one
  DesignProblem over_scenes(const std::vector<int>& scenes) const;

  /// Whether a bound can be exceeded by more or less: an upper bound on an output or an objective.
  bool has_upper_bounds() const { return !task_.objective_bounds.empty() || !std::ranges::all_of(task_.constraints, &OutputConstraint::is_least); }
  /// Whether judged_by_excess() has anything to minimise.
  bool has_smooth_excess() const {
    return !task_.objective_bounds.empty() || std::ranges::any_of(task_.constraints, &OutputConstraint::has_smooth_excess);
  }
  /// The same scenes and variables judged by how far a design is beyond its bounds: the largest excess of an output or an objective, relative
  /// to its bound, is minimised [-], below 0 where all are kept. Bounds on outputs without a smooth excess (OutputConstraint::has_smooth_excess()) and bounds on
  /// modifications remain constraints. Only where has_smooth_excess().
  DesignProblem judged_by_excess() const;
  /// The same task with every bound on an output or an objective moved out by a share of itself [-], >= 0.
  DesignProblem with_wider_bounds(double share) const;

  /// Start of a search: set_start(), or the scaled design of the task's own modifications, moved into set_box() where it lies outside.
  Eigen::VectorXd start() const;
  void set_start(const Eigen::VectorXd& x) { start_ = x; }
  /// The part of 0 .. 1 that searches and rounding keep to, all of it by default; a variable with lower = upper is held.
  void set_box(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
    lower_ = lower;
    upper_ = upper;
  }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }
  /// The scaled design of a value for each variable [mm; parabolic_te 1/rad], such as DesignReport::variables; outside 0 .. 1 where a value is out
  /// of bounds.
  Eigen::VectorXd scaled_design(const std::vector<double>& values) const;
  /// The same moved into 0 .. 1.
  Eigen::VectorXd nearest_design(const std::vector<double>& values) const { return scaled_design(values).cwiseMax(0.0).cwiseMin(1.0); }
  /// Value of variable i [mm; parabolic_te 1/rad].
  double unscaled(const Eigen::VectorXd& x, int i) const;
  /// Modifications of a scaled design.
  PerGear<Modification> modification(const Eigen::VectorXd& x) const;

  /// Analyses every scene; derivatives are with respect to the unscaled variables and the modifications linked to them.
  /// The last analysis is kept and returned again for the same x (upgraded by a new run where derivatives are missing).
  /// Loads start from those of the last analysis, which halves the time and changes only digits beyond the tolerance of
  /// LoadOptions.
  const DesignAnalysis& analyse(const Eigen::VectorXd& x, bool with_derivatives);
  /// Analyses the task's own modifications as given, whatever the bounds.
  DesignAnalysis analyse_given() const;
  /// Analyses any modifications; neither remembered nor counted.
  DesignAnalysis analyse_design(const PerGear<Modification>& modification) const { return run(modification, false); }
  /// Some scenes of a scaled design, those of others have no cycle. Neither remembered nor counted, and started from no other loads: the same design gives
  /// the same bits whatever was analysed before.
  DesignAnalysis analyse_some(const Eigen::VectorXd& x, const std::vector<int>& scenes, bool with_derivatives) const;
  /// One scene of that, with derivatives by any parameters; those that move the mesh (moves_mesh()) need two perturbed
  /// meshes each, which are not kept.
  /// @param earlier  the scene's cycle for a design that differs by little, see analyse_cycle(); null: none
  LoadedCycle analyse_scene(int scene, const PerGear<Modification>& modification, const std::vector<MeshParameter>& parameters = {},
                            const LoadedCycle* earlier = nullptr) const;
  /// Some mesh positions of one scene, rising; the others have no loads. What holds at these holds for the scene.
  LoadedCycle analyse_positions(int scene, std::span<const std::size_t> positions, const PerGear<Modification>& modification,
                                const LoadedCycle* earlier = nullptr) const;
  /// Root stress is analysed where the task minimises or bounds it; this adds it where not, to be shown.
  void add_root_stress(DesignAnalysis& analysis) const;

  /// Runs of analyse() that were computed, not remembered.
  int analyses() const { return analyses_; }
  /// Whole cycles of one scene each that this problem and all its copies have analysed.
  std::int64_t cycles() const { return *cycles_; }

  /// Weighted sum of the objective's outputs in one scene, outside units.
  double scene_measure(const DesignAnalysis& analysis, int scene) const;
  double scene_measure(const Objective& objective, const DesignAnalysis& analysis, int scene) const;
  /// Of a cycle by itself; not for sums over a load spectrum.
  double scene_measure(const Objective& objective, const LoadedCycle& cycle, int scene) const;
  /// Of all scenes; a sum over a load spectrum is computed once and stands in each of its scenes.
  std::vector<double> scene_measures(const Objective& objective, const DesignAnalysis& analysis) const;
  /// An objective's measures of all scenes, aggregated, outside unit.
  double value(const Objective& objective, const DesignAnalysis& analysis) const;
  /// What is minimised: the objective aggregated over the scenes, or the scalarisation.
  double objective(const DesignAnalysis& analysis) const;
  /// Value of a bounded output in the scene that is nearest to the bound or farthest beyond it, inside unit.
  double constraint_value(const DesignAnalysis& analysis, const OutputConstraint& constraint) const;
  /// Largest excess over all bounds, relative to each (modification constraints: to modification_scale()); 0 where all are kept [-].
  double violation(const DesignAnalysis& analysis) const;
  /// Its part by the constraints on modifications, which needs no analysis.
  double violation(const PerGear<Modification>& modification) const;
  /// Scale of an excess of a modification constraint: the range that the variables give its sum [mm].
  double modification_scale(const ModificationConstraint& constraint) const;
  /// d(constraint's sum)/dx, scaled variables.
  Eigen::VectorXd modification_slope(const ModificationConstraint& constraint) const;
  /// Gradient of a candidate of one scene with respect to the scaled variables, by the chain rule through the linking
  /// constraints.
  Eigen::VectorXd scaled(const Eigen::VectorXd& gradient) const;
  /// The same, 0 by what the gears of the scene have none of, see ModificationDeviation::is_cut().
  Eigen::VectorXd scaled(Eigen::VectorXd gradient, const DesignAnalysis& analysis, int scene) const;

  std::vector<double> scene_weights() const;

 private:
  MeshModel made_mesh(const MeshPlacement& placement, const std::vector<double>& phases) const;
  std::shared_ptr<const MeshModel> shared_mesh(const MeshPlacement& placement) const;
  FlankCondition condition(int scene, const PerGear<Modification>& modification) const;
  void find_fillets();
  /// @param earlier  one that loads start from; without cycles: none
  DesignAnalysis run(const PerGear<Modification>& modification, bool with_derivatives, DesignAnalysis earlier = {}) const;

  DesignTask task_;
  RootStresses root_stresses_;                                         ///< with every analysis where the task asks for them
  std::vector<std::shared_ptr<const MeshModel>> models_;               ///< per scene; copies of the problem share them
  std::vector<std::shared_ptr<const PerGear<FilletPoints>>> fillets_;  ///< per scene likewise; empty where no root damage is asked for
  std::vector<MeshParameter> parameters_;                              ///< variables, then linked modifications
  Eigen::VectorXd start_;                                              ///< empty: the task's own
  Eigen::VectorXd lower_, upper_;                                      ///< set_box()
  Eigen::VectorXd last_x_;
  bool last_has_derivatives_{false};
  DesignAnalysis last_;
  int analyses_{0};
  std::shared_ptr<std::atomic<std::int64_t>> cycles_{std::make_shared<std::atomic<std::int64_t>>(0)};
};

}  // namespace flankwright
