#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/compliance/fitted/fitted_compliance.hpp"
#include "core/compliance/fitted/influence_sample.hpp"
#include "core/compliance/fitted/least_squares.hpp"

namespace flankwright {

/// Options of the fit of a KernelForm. The cost is
///
///     1/2 [ mean over pairs of ((K_fit - K)/scale)^2  +  sum over coefficients of (ridge (c - start))^2 ],
///     scale = max(|K_pq|, scale_floor sqrt(K_pp K_qq)).
///
/// A kernel sum is over-complete: very different coefficients give nearly the same compliance. The ridge decides among
/// them. For comparable coefficients of neighbouring gears, between which one can interpolate, start at one gear's fit
/// and draw the other's towards it: its coefficients as the start, and a stronger tooth_ridge.
struct FitOptions {
  std::vector<double> start;   ///< empty: flat kernels of the sample's mean size, flat_start()
  double tooth_ridge{2.4e-4};  ///< of warp and kernels [-], >= 0
  double body_ridge{2.4e-4};   ///< of the body parts [-], >= 0
  /// Pairs with hardly any coupling count relative to their diagonal values instead [-], > 0. Where several teeth of a
  /// small gear are fitted, 0.01 keeps pairs whose compliance passes through zero from deciding the fit.
  double scale_floor{0.003};
  LeastSquaresOptions solver{.max_iterations = 300, .cost_tolerance = 1e-7};

  /// Throws InvalidInput with field, value and violated bound.
  void validate(const KernelForm& form) const;
};

struct FitResult {
  FitStatus status{FitStatus::NotRun};
  std::string message{"fit_compliance() was not called"};
  std::optional<FittedCompliance> fit;  ///< empty unless Converged or IterationLimit
  /// Of the coefficients, as far as pairs may be taken as independent: s^2 (J'J + N ridge^2)^-1, s^2 = sum of squares
  /// over (N - n); n x n.
  Eigen::MatrixXd covariance;
  double initial_cost{std::numeric_limits<double>::quiet_NaN()};
  double cost{std::numeric_limits<double>::quiet_NaN()};
  int pairs{0};  ///< N
  int iterations{-1};
};

/// Coefficients to start from without a neighbour's: kernels of different constant lengths that share the sample's mean
/// compliance, no warp, a body that moves as one.
std::vector<double> flat_start(const KernelForm& form, std::span<const InfluenceSample> samples);

/// Fits a form to influence values of one gear.
/// @param samples  all of the same gear; where the form couples no teeth, pairs on different teeth are left out
/// @throws InvalidInput where a sample, the form or an option is out of range, or the samples are of different gears
FitResult fit_compliance(std::span<const InfluenceSample> samples, const KernelForm& form, const FitOptions& options = {});

}  // namespace flankwright
