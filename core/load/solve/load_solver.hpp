#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/load/solve/load_problem.hpp"
#include "core/load/solve/quadratic_program.hpp"
#include "core/load/solve/sensitivity.hpp"

namespace flankwright {

/// Solves load problems one after the other in memory that it keeps; an answer does not depend on the problems before.
///
/// Newton's method in the loads: each step minimises the quadratic model over the feasible set exactly (see QuadraticProgram), then the
/// convex objective along the step by its monotone slope. Both parts converge from any start; the minimiser is unique, so the answer
/// depends on neither start nor point order.
///
/// Points that the start leaves far from contact are left out of the steps. The answer is checked against all of them, and where it
/// makes one penetrate it goes on with that one too, so that nothing depends on the choice but the time.
class LoadSolver {
 public:
  /// As solve_load_distribution().
  LoadDistribution solve(const LoadProblemView& problem, const LoadOptions& options = {}, const Eigen::VectorXd& start = {});

  /// Derivatives of the distribution that was solved last, by the factor of its last step where that is still the one of its loads.
  /// Only after one that is usable() and has a loaded point.
  LoadSensitivity sensitivity() const;

 private:
  using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;

  /// Loads of the working set's points and everything that follows from them, each contact law evaluated once.
  ///
  /// Gaps and approach count from first touch, min(g): a gap common to all points, easily a million times the deflection
  /// under a light load, would leave its round-off in every sum.
  struct Iterate {
    Eigen::VectorXd loads, structural, local, local_slope;
    Eigen::VectorXd approach;  ///< gradient of the objective divided by the weights: the deflection plus gap at each point [mm]
    double multiplier{0.0};    ///< f_t from first touch for these loads: the mean approach, weighted by the force that points carry
  };

  // The whole problem.
  void find_deflection(const LoadProblemView& problem, const Eigen::VectorXd& loads);
  Flags points_near_contact(const LoadProblemView& problem, const Eigen::VectorXd& loads) const;
  bool add_penetrating(const LoadProblemView& problem, const LoadOptions& options, LoadDistribution& result);
  void fill(LoadDistribution& result) const;
  // The working set.
  void work_on(const LoadProblemView& problem, const Eigen::VectorXd& loads, const Flags& working);
  bool newton(const LoadOptions& options, LoadDistribution& result);
  void evaluate(Iterate& at);
  void step();
  double deflection_scale() const;
  double residual(double reached) const;
  double slope_along(double t) const;
  bool settled();
  double condition() const;

  double force_{0.0};
  double first_touch_{0.0};           ///< min(g) [mm]
  double load_floor_{0.0};            ///< line load whose slope is used for that of no load [N/mm]
  Eigen::VectorXd structural_, gap_;  ///< of all n points; gap_ from first touch

  std::vector<Eigen::Index> points_;     ///< of the working set, ascending
  std::vector<const ContactLaw*> laws_;  ///< of these, and so is all that follows
  Eigen::MatrixXd influence_, hessian_;  ///< K; aKa + a c'
  Eigen::VectorXd weight_, near_gap_;    ///< a; g from first touch
  Eigen::VectorXd stiff_diagonal_;       ///< of aKa
  Eigen::VectorXd floor_slope_;          ///< c' at load_floor_; NaN until computed
  bool has_negative_influence_{false};
  double largest_influence_{0.0};  ///< largest |K_ij| [mm/N]
  Iterate at_, next_;
  Eigen::VectorXd gradient_, forces_;
  QuadraticProgram model_;
  bool has_factor_{false};  ///< of the loaded points of at_, one step ago
  double load_step_{0.0};   ///< largest change of a load in the last step over the largest load; infinite before the first
};

/// Solves one problem with a new solver.
/// @param start  line loads to start from (scaled to the force), size n, or empty
/// @throws InvalidInput where sizes differ, a weight is not positive, the force is negative or anything is not finite
LoadDistribution solve_load_distribution(const LoadProblemView& problem, const LoadOptions& options = {}, const Eigen::VectorXd& start = {});

}  // namespace flankwright
