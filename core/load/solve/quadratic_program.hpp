#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/load/solve/cholesky.hpp"

namespace flankwright {

/// minimise 1/2 d'Hd + g'd  subject to  a'(x + d) = F,  x + d >= 0
///
/// over the step d from given loads x, n of each: H symmetric positive definite, a > 0, F > 0. Counting from loads near
/// the minimiser keeps round-off as small as the step. All must outlive the solver.
struct QuadraticProblem {
  const Eigen::MatrixXd& H;  ///< n x n
  const Eigen::VectorXd& g;
  const Eigen::VectorXd& a;
  double F;
  const Eigen::VectorXd& x;  ///< >= 0
  /// Largest magnitude of the terms that g/a was summed from: they set g's round-off.
  double terms{0.0};
};

/// Minimiser of a strictly convex quadratic over loads with a force balance, in memory that is kept from one to the next.
///
/// Block principal pivoting (Portugal, Judice, Vicente 1994): all bounds that are violated on either side change at
/// once as long as their number falls, a few factorisations in all. Where it stalls, which takes a nearly singular H, a
/// primal active-set method goes on from its loads: every step lowers the objective, so that it ends. Signs are judged
/// up to the round-off of their terms.
class QuadraticProgram {
 public:
  using Flags = Eigen::Array<bool, Eigen::Dynamic, 1>;

  /// @param guess  points expected to be loaded, size n; all false is taken as all true
  /// @returns      whether it was solved; false leaves the best loads found
  bool minimise(const QuadraticProblem& problem, const Flags& guess);

  const Eigen::VectorXd& loads() const { return loads_; }        ///< x + d >= 0
  double multiplier() const { return multiplier_; }              ///< of the balance: H d + g = multiplier a where loaded
  const Cholesky& factor() const { return factor_; }             ///< of H over set()
  const std::vector<Eigen::Index>& set() const { return set_; }  ///< points that were loaded last, ascending
  int factorisations() const { return factorisations_; }         ///< of the last minimise()

 private:
  bool descend(const QuadraticProblem& problem);
  void balance_on(const QuadraticProblem& problem, const Flags& loaded);
  void refine(const QuadraticProblem& problem, double unbalanced);
  void find_slacks(const QuadraticProblem& problem);
  Eigen::Index most_penetrating(const QuadraticProblem& problem, const Flags& loaded);

  Eigen::VectorXd loads_, step_, slack_, right_;
  double multiplier_{0.0};
  Cholesky factor_;
  std::vector<Eigen::Index> set_;
  int factorisations_{0};
};

}  // namespace flankwright
