#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/load/solve/cholesky.hpp"
#include "core/load/solve/load_problem.hpp"

namespace flankwright {

/// Exact derivatives of a converged load distribution while its set of loaded points stays the same.
///
/// On the loaded set the optimality conditions are  (aKa + a c')dw - a df = -a dg,  a'dw = dF: one factorisation, over the loaded
/// points alone, serves every parameter. Where a point is about to gain or lose contact the derivative is one-sided: that of the
/// present set.
class LoadSensitivity {
 public:
  /// @param distribution  usable() and with at least one loaded point
  LoadSensitivity(const LoadProblemView& problem, const LoadDistribution& distribution);
  /// The same with an existing factor, see LoadSolver.
  /// @param size    number of points n
  /// @param loaded  points that carry load, ascending
  /// @param weight  a of these
  /// @param factor  of aKa + a c' over these
  LoadSensitivity(Eigen::Index size, std::vector<Eigen::Index> loaded, Eigen::VectorXd weight, Cholesky factor);

  /// With respect to m parameters.
  struct Derivatives {
    Eigen::MatrixXd line_load;              ///< dw/dp, n x m; 0 where unloaded
    Eigen::RowVectorXd transmission_error;  ///< df_t/dp, m
  };
  /// @param gap    dg/dp, n x m
  /// @param force  dF/dp, m
  Derivatives with(const Eigen::MatrixXd& gap, const Eigen::RowVectorXd& force) const;
  /// With respect to parameters that leave the force alone.
  Derivatives with_gap(const Eigen::MatrixXd& gap) const { return with(gap, Eigen::RowVectorXd::Zero(gap.cols())); }
  /// With respect to the force [per N].
  Derivatives with_force() const { return with(Eigen::VectorXd::Zero(size_), Eigen::RowVectorXd::Ones(1)); }
  /// Tangent mesh stiffness dF/df_t, normal to the flank [N/mm].
  double tangent_stiffness() const { return stiffness_; }

 private:
  Eigen::Index size_;
  std::vector<Eigen::Index> loaded_;
  Eigen::VectorXd weight_;  ///< of the loaded points
  Cholesky factor_;
  Eigen::VectorXd response_;  ///< H^-1 a
  double stiffness_;          ///< a' H^-1 a
};

}  // namespace flankwright
