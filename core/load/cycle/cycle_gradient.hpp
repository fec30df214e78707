#pragma once

#include <Eigen/Core>
#include <complex>

#include "core/load/cycle/mesh_cycle.hpp"

namespace flankwright {

/// Amplitude of one order of f_t over equally spaced positions.
struct TeHarmonic {
  double amplitude{not_given};            ///< [mm]
  Eigen::RowVectorXd derivative;          ///< 1 x m; at amplitude 0, where it has a kink, 0, one of its subgradients
  std::complex<double> phasor;            ///< its modulus is the amplitude [mm]
  Eigen::RowVectorXcd phasor_derivative;  ///< 1 x m; smooth at amplitude 0 as well
};
/// @param order  below half the number of positions, >= 1
TeHarmonic te_harmonic(const LoadedCycle& cycle, int order);

/// d/dp of a line load over the mean line load.
Eigen::RowVectorXd load_factor_derivative(const MeshModel& model, const LoadedCycle& cycle, int position, Eigen::Index point);

/// Derivatives of a CycleSummary with respect to the parameters of analyse_cycle(), 1 x m each, exact while points keep
/// their contact and peaks their location. A peak's derivative is that of the point and position where it is (the first
/// of equals); a maximum over fixed positions has it on one side at least.
/// A figure that the summary does not have has no derivatives.
struct CycleGradient : CycleValues<Eigen::RowVectorXd, Eigen::MatrixXd> {
  /// Of RootStressPeak; empty where the model has no root stress.
  struct Root {
    Eigen::RowVectorXd stress, tangent_stress;
  };
  Root pinion_root_stress, wheel_root_stress;
};
/// @param cycle  usable()
CycleGradient summary_gradient(const MeshModel& model, const LoadedCycle& cycle, const CycleSummary& summary);

/// d(stiffness)/dp of one position, 1 x m.
Eigen::RowVectorXd stiffness_derivative(const LoadedCycle& cycle, const LoadedPosition& position);

}  // namespace flankwright
