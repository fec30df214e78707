#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/contact/gap/gap.hpp"
#include "core/load/solve/load_problem.hpp"

namespace flankwright {

/// Loaded contact at one position of the mesh cycle.
struct LoadedPosition {
  double phase{not_given};
  LoadDistribution load;
  Gap gap;                         ///< before load
  Eigen::VectorXd contact_stress;  ///< sigma_H per point, on edges included [MPa]
  Eigen::VectorXd peak_load;       ///< the largest line load of the part of a line that belongs to a point, see PointPeaks [N/mm]
  Eigen::VectorXd edge_stress;     ///< the largest pressure on a tip edge's rounding, 0 where contact does not reach it [MPa]; empty: not computed
  /// Part of the force that tip roundings carry, the integral of the pressure over them [-], 0 .. 1; NaN: not computed, as edge_stress.
  double tip_edge_share{not_given};
  /// Largest principal stress at every point of MeshPosition::root_stress [MPa]; empty without, or where it was left
  /// for later.
  Eigen::VectorXd root_stress;
  double stiffness{not_given};   ///< secant, transverse, per mm of face width [N/(mm um)]; see analyse_cycle()
  double shaft_deflection{0.0};  ///< part of the approach that the shafts yield, see MeshPosition::shaft_compliance [mm]
  // Derivatives with respect to the parameters, one column each; those of root_stress: see root_stress_derivative().
  Eigen::MatrixXd gap_derivative;                    ///< d(gap.total)/dp, n x m
  Eigen::MatrixXd line_load_derivative;              ///< dw/dp, n x m
  Eigen::MatrixXd contact_stress_derivative;         ///< dsigma_H/dp, n x m
  Eigen::MatrixXd peak_load_derivative;              ///< of peak_load, n x m
  Eigen::MatrixXd edge_stress_derivative;            ///< of edge_stress, n x m
  Eigen::RowVectorXd tip_edge_share_derivative;      ///< of tip_edge_share, 1 x m; empty: not computed
  Eigen::RowVectorXd transmission_error_derivative;  ///< df_t/dp, 1 x m
  Eigen::RowVectorXd approach_derivative;            ///< of f_t - min(g), one point's where several are nearest, 1 x m
  /// Of the flanks from first touch on, f_t - min(g) [mm]; of a usable load distribution.
  double approach() const { return load.transmission_error - gap.total.minCoeff(); }
  /// The same without what the shafts yield: by this teeth and bodies deform.
  double approach_of_teeth() const {
    const double teeth = approach() - shaft_deflection;
    return teeth < 0.0 ? 0.0 : teeth;
  }

  Eigen::MatrixXd
      root_influence_derivative;  ///< of RootStressInfluence::components a w at held loads, three rows a fillet point, m columns; empty where no parameter moves the mesh
};

/// Loaded contact over the positions of a MeshModel.
struct LoadedCycle {
  std::vector<LoadedPosition> positions;
  double force{not_given};               ///< normal force [N]
  Eigen::RowVectorXd force_derivative;   ///< dF/dp, 1 x m
  Eigen::RowVectorXd face_width_change;  ///< relative derivative of MeshModel::face_width, 1 x m
  int failures{0};                       ///< positions without a usable load distribution
  bool closes{true};                     ///< the next pitch is as this one; false: teeth differ, teeth_differ()

  /// f_t of every position [mm]; NaN where a position failed.
  Eigen::VectorXd transmission_error() const;
  bool usable() const { return failures == 0; }
};

}  // namespace flankwright
