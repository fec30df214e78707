#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "optimize/solvers/nonlinear_program.hpp"
#include "optimize/design/problem/design_task.hpp"
#include "optimize/design/outputs/scene_outputs.hpp"

namespace flankwright {

/// A number and its derivative.
struct Slope {
  double value, by;
};

/// One objective as a smooth function of upper bounds u_sk on its outputs k in the scenes s, in units of their peaks.
/// With m_s = sum_k w_k u_sk and the weights p_s of the scenes, of sum 1, the objective is
///
///     nominal          F = m_0
///     worst            F = t                               subject to  m_s <= t
///     mean             F = sum p_s m_s
///     mean + k sigma   F = mean + k sqrt(sum p_s (m_s - mean)^2 + epsilon^2),    epsilon = 1e-5
///     cvar             F = t + sum p_s v_s / (1 - level)   subject to  m_s - t <= v_s,  v_s >= 0
///     quantile         F = t                               subject to  m_s <= t  of all scenes but those left out
///
/// Outputs that grow with a power g of the stress, Objective::growth(), span many decades, and a linear model of them holds for a fraction of a per
/// cent of the stress alone. The variables of the programme are therefore the roots u^(1/g) and t^(1/g), and value() is F^(1/g); g = 1 changes nothing.
///
/// A quantile leaves out the scenes beyond it at some design, see leave_out(). The largest of the others is the quantile there and never below
/// it elsewhere: a majorant. Worst and quantile of a single output need one u for all scenes. epsilon, in units of the start's value, smooths the spread
/// where the scenes agree: the value is at most k epsilon too large.
class ObjectiveBlock {
 public:
  /// @param weights  of the scenes, > 0
  /// @param peaks    per term, what u is counted in [inside unit, > 0]
  /// @param first    index of the block's first variable in the programme's
  /// @param scenes   numbers of these scenes in the task; empty: 0, 1, ...
  ObjectiveBlock(Objective objective, const std::vector<double>& weights, std::vector<double> peaks, int first, std::vector<int> scenes = {});

  const Objective& objective() const { return objective_; }
  int variables() const;
  int rows() const;
  /// Scenes that count: one for nominal.
  int scenes() const { return static_cast<int>(shares_.size()); }
  /// The task's number of the block's scene.
  int scene(int s) const { return numbers_.empty() ? s : numbers_[static_cast<std::size_t>(s)]; }
  /// The block's scene of the task's number.
  int scene_of(int number) const;
  /// Index of u_sk^(1/g).
  int bound(int scene, int term) const;
  double peak(int term) const { return peaks_[static_cast<std::size_t>(term)]; }
  /// What a variable must be at least for an output of this inside value, and its derivative by the output.
  Slope bound_for(double output, int term) const;

  /// F^(1/g) with its gradient over all of y.
  SmoothValue value(const Eigen::VectorXd& y) const;
  /// F^(1/g) of the objective in outside units, and back.
  double seen(double objective) const { return std::pow(objective / scale_, 1.0 / growth_); }
  Slope objective_of(double seen) const;
  /// Whether the value falls where the measure of a scene rises, as mean + k sigma does in scenes well below the mean.
  bool falls_with(const Eigen::VectorXd& y, int scene) const;
  /// Of a quantile: leaves out the scenes beyond it by these measures. Nothing else to do.
  void leave_out(const std::vector<double>& measures);
  bool leaves_out(int scene) const { return !left_out_.empty() && left_out_[static_cast<std::size_t>(scene)]; }
  bool leaves_out_any() const { return std::ranges::find(left_out_, true) != left_out_.end(); }
  /// Sets t and v to the least values that the u of y allow.
  void complete(Eigen::VectorXd& y) const;
  /// Writes the rows above from `row` on.
  void write_rows(const Eigen::VectorXd& y, int row, ProgramValues& values) const;

 private:
  bool is_largest() const { return objective_.over == Aggregate::Worst || objective_.over == Aggregate::Quantile; }
  bool shares_one_bound() const { return is_largest() && objective_.terms.size() == 1; }
  bool has_rows() const { return objective_.over == Aggregate::Cvar || (is_largest() && !shares_one_bound()); }
  int level() const { return first_ + scenes() * static_cast<int>(objective_.terms.size()); }  ///< index of t
  double measure(const Eigen::VectorXd& y, int scene) const;
  /// dm_s by the variable of one of its outputs.
  double measure_slope(const Eigen::VectorXd& y, int scene, std::size_t term) const;
  Eigen::VectorXd measures(const Eigen::VectorXd& y) const;

  Objective objective_;
  Eigen::VectorXd shares_;  ///< p_s
  std::vector<double> peaks_;
  std::vector<double> term_weights_;  ///< w_k, sum 1
  std::vector<bool> left_out_;        ///< per scene, of a quantile; empty: none
  double scale_{0.0};                 ///< of F, outside unit
  double growth_;                     ///< g
  int first_;
  std::vector<int> numbers_;
};

}  // namespace flankwright
