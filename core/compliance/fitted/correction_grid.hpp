#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/units.hpp"
#include "core/compliance/fitted/influence_sample.hpp"
#include "core/compliance/fitted/kernel_form.hpp"
#include "core/compliance/fitted/least_squares.hpp"
#include "core/compliance/fitted/residual_statistics.hpp"
#include "core/gear/gear_data.hpp"

namespace flankwright {

/// Reference profile of a gear in the normal section; by default the standard one.
struct ReferenceProfile {
  RackProfile rack{};
  double pressure_angle{20 * units::deg};  ///< alpha_n [rad]

  bool operator==(const ReferenceProfile&) const = default;
};

/// One gear's fit of what a fine mesh adds to the compliance by a coarse one.
struct CorrectionEntry {
  GearProportions gear;
  ReferenceProfile profile{};
  FitStatus status{FitStatus::NotRun};
  int iterations{-1};
  int pairs{0};
  double seconds{not_given};         ///< wall time of the finite elements and the fit
  ResidualStatistics fitted;         ///< of coarse values plus fit against fine ones, at the stations fitted
  ResidualStatistics unseen;         ///< at stations that the fit has not seen
  std::vector<double> coefficients;  ///< of KernelForm::correction()
  Eigen::MatrixXd covariance;        ///< of the coefficients, FitResult::covariance; empty where the fit failed
};

/// Lagrange's polynomials through the nodes, at x.
std::vector<double> cardinal_polynomials(const std::vector<double>& nodes, double x);

/// Coefficients of the same fit with the ends of the face exchanged.
std::vector<double> mirrored(const KernelForm& form, const std::vector<double>& coefficients);

/// Fits over a tensor grid of gears of one reference profile, and between them: every coefficient is a polynomial
/// through the entries in 1/Z, beta and x. An entry of beta, with its ends exchanged, represents -beta as well, and one
/// of beta = 0 is made alike at both ends: the mean of both ends is even in beta, their difference odd. The face width
/// does not enter.
class CorrectionGrid {
 public:
  /// @throws InvalidInput "library" where entries are not all combinations of their teeth, helix angles (the first 0)
  ///         and profile shifts, once each, or have coefficients of another form
  explicit CorrectionGrid(std::vector<CorrectionEntry> entries);

  const std::vector<CorrectionEntry>& entries() const { return entries_; }
  const std::vector<int>& teeth() const { return teeth_; }                       ///< ascending
  const std::vector<double>& helix_angles() const { return helix_angles_; }      ///< ascending [rad]
  const std::vector<double>& profile_shifts() const { return profile_shifts_; }  ///< ascending

  /// The gear itself, or the nearest value of each parameter within the ranges of the entries.
  GearProportions nearest(GearProportions gear) const;

  /// Coefficients for a gear within the ranges.
  std::vector<double> coefficients(const GearProportions& gear) const;

 private:
  std::vector<CorrectionEntry> entries_;  ///< profile shift runs fastest, then the helix angle
  std::vector<int> teeth_;
  std::vector<double> helix_angles_, profile_shifts_;
};

}  // namespace flankwright
