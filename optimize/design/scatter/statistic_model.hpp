#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimize/design/problem/design_problem.hpp"

namespace flankwright {

/// The outputs of one objective in the load cases of one draw, each with its leading candidates and their gradients at a design: the draw near that design.
struct LinearDraw {
  struct Peak {
    Eigen::VectorXd values;  ///< roots r_j of the candidates, see StatisticModel
    Eigen::MatrixXd slopes;  ///< a row each, by the scaled variables
  };
  struct LoadCase {
    double weight;  ///< among those of the draw
    std::vector<Peak> terms;
  };
  Eigen::VectorXd x;  ///< scaled
  std::vector<LoadCase> load_cases;
};

/// A statistic over draws as a function of the design, from analyses of each draw at designs of its own.
///
/// Near a design x_0 output k of draw s is the largest of its candidates, each continued along its exact gradient, and of several analyses the largest:
///
///     r_sk(x) = max_j r_skj + dr_skj/dx (x - x_0),      m_s(x) = sum_k w_k r_sk^g,      F(x) = statistic of the m_s
///
/// Where a draw has several load cases, its m_s is the aggregate of those of its load cases, such as the worst.
///
/// r is the root u^(1/g) of an output u that grows with the power g of a stress (Objective::growth()). A contact stress alone has g = 1/2: its square is the
/// line load, which is linear in the flanks as long as the points keep their contact. What is minimised is f = F^(1/g).
class StatisticModel {
 public:
  /// @param within  combines the load cases of a draw
  StatisticModel(const DesignProblem& problem, Objective objective, Aggregation within = Aggregate::Worst);

  const Objective& objective() const { return objective_; }
  /// Another statistic of the same outputs.
  void combine(const Aggregation& over) { objective_.over = over; }
  /// Makes a quantile the mean of the quantiles of all levels that so many draws do not tell apart: within two standard errors sqrt(p (1 - p) / draws) of its
  /// own p (95 % confidence), at most four fifths of what lies beyond it. One draw has then a small weight, and a search finds less of what is only in its
  /// sample. A tail that rises steeply just beyond p raises the mean. With exact() the statistic is the quantile itself again.
  void smooth(int draws);
  void exact() { band_ = 0.0; }
  /// Draws of the objective, see draws_of().
  int draws() const { return static_cast<int>(scenes_.size()); }
  int draws(int first) const { return std::min(first, draws()); }
  /// Load cases of a draw.
  const std::vector<int>& scenes(int draw) const { return scenes_[static_cast<std::size_t>(draw)]; }
  int first_scene(int draw) const { return scenes(draw).front(); }

  /// Of an analysis; without derivatives constant.
  LinearDraw linear(const DesignProblem& problem, const DesignAnalysis& analysis, int draw, const Eigen::VectorXd& x) const;
  /// What the draw is near a design, instead of all that was known of it.
  void set(int draw, LinearDraw linear);
  /// The same beside what was known of it.
  void add(int draw, LinearDraw linear);
  /// What is known of the draw, moved to another design where it has this measure m_s.
  LinearDraw moved(int draw, const Eigen::VectorXd& x, double measure) const;
  bool knows(int draw) const { return !known_[static_cast<std::size_t>(draw)].empty(); }

  /// m_s^(1/g) and its gradient, of an analysis and of all that is known of a draw.
  SmoothValue seen(const LinearDraw& linear, const Eigen::VectorXd& x) const;
  SmoothValue seen(int draw, const Eigen::VectorXd& x) const;
  /// m_s of the first draws [outside unit]; of one that was never analysed infinite.
  std::vector<double> measures(const Eigen::VectorXd& x, int first) const;
  /// F^(1/g), and back.
  double seen(double value) const;
  double unseen(double seen) const;
  std::vector<double> weights(std::size_t draws) const;
  /// The statistic of measures of the first draws.
  double statistic(const std::vector<double>& measures) const;
  /// Draws from the largest down that the statistic hangs on or leaves out.
  std::size_t first(std::size_t draws) const;
  std::vector<double> statistic_weights(const std::vector<double>& measures) const;
  /// Of a quantile: the draws beyond it, and beyond its levels.
  std::vector<bool> beyond(const std::vector<double>& measures) const;

  /// f over the first draws, and linear functions that touch it or one of the draws that it is the largest of. Of a quantile the draws beyond it at some
  /// design are left out, so that f is the largest of the others: a majorant, which is the quantile at that design.
  struct Tangents {
    double value{not_given};
    std::vector<SmoothValue> touching;  ///< values at x
  };
  Tangents tangents(const Eigen::VectorXd& x, const std::vector<bool>& left_out, int first, double level) const;

 private:
  /// m of one load case and its gradient.
  SmoothValue measure(const LinearDraw::LoadCase& load_case, const Eigen::VectorXd& step) const;
  bool is_band() const { return band_ > 0.0; }
  /// A smoothed quantile is the mean of the worst of those that it does not leave out.
  Aggregation of_rest() const { return {Aggregate::Cvar, 2.0, 1.0 - 2.0 * band_ / (objective_.over.level + band_)}; }

  Objective objective_;
  Aggregation within_;
  double band_{0.0};  ///< half width of a smoothed quantile's levels
  double growth_;
  std::vector<std::vector<int>> scenes_;  ///< per draw
  std::vector<double> weights_;
  std::vector<std::vector<LinearDraw>> known_;
};

}  // namespace flankwright
