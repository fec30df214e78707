#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "core/load/load_problem.hpp"

namespace flankwright {

/// Exact derivatives of a converged load distribution while its set of loaded points stays the same.
///
/// On the loaded set the optimality conditions are  (aKa + a c')dw - a df = -a dg,  a'dw = dF: one factorisation serves every
/// parameter. Where a point is about to gain or lose contact the derivative is one-sided: that of the present set.
class LoadSensitivity {
 public:
  /// @param distribution  usable() and with at least one loaded point
  LoadSensitivity(const LoadProblem& problem, const LoadDistribution& distribution);

  struct Derivative {
    Eigen::VectorXd line_load;       ///< dw/dp, n; 0 where unloaded
    double transmission_error{0.0};  ///< df_t/dp
  };
  /// With respect to a parameter p that changes the gap by dg/dp.
  Derivative with_gap(const Eigen::VectorXd& gap_derivative) const;
  /// With respect to the force [per N].
  Derivative with_force() const;
  /// Tangent mesh stiffness dF/df_t, normal to the flank [N/mm].
  double tangent_stiffness() const { return stiffness_; }

 private:
  Derivative spread(const Eigen::VectorXd& loads, double f) const;

  Eigen::Index size_;
  std::vector<Eigen::Index> loaded_;
  Eigen::VectorXd weight_;                 ///< of the loaded points
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd response_;               ///< H^-1 a
  double stiffness_;                       ///< a' H^-1 a
};

}  // namespace flankwright
