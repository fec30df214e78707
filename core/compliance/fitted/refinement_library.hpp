#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "core/compliance/finite_element/gear_mesh.hpp"
#include "core/compliance/fitted/influence_sample.hpp"
#include "core/compliance/fitted/kernel_form.hpp"
#include "core/compliance/fitted/least_squares.hpp"
#include "core/compliance/fitted/residual_statistics.hpp"

namespace flankwright {

/// One gear's fit of what a fine mesh adds to the compliance by a coarse one.
struct RefinementEntry {
  GearFacts gear;
  FitStatus status{FitStatus::NotRun};
  int iterations{-1};
  int pairs{0};
  double seconds{not_given};         ///< wall time of the finite elements and the fit
  ResidualStatistics fitted;         ///< of coarse values plus fit against fine ones, on the places fitted
  ResidualStatistics unseen;         ///< on places that the fit has not seen
  std::vector<double> coefficients;  ///< of KernelForm::refinement()
  Eigen::MatrixXd covariance;        ///< of the coefficients, FitResult::covariance; empty where the fit failed
};

/// A line of text for an entry and back, in full precision but for the covariance: its lower triangle, row by row, in four
/// digits. Lines that start with # are remarks.
std::string to_text(const RefinementEntry& entry);
/// @throws InvalidInput "library" with the number of the line that is no entry
std::vector<RefinementEntry> entries_in(std::string_view text);

/// What the library goes by.
GearFacts facts_of(const GearToMesh& gear);

/// Coefficients of the same fit with the ends of the face exchanged.
std::vector<double> mirrored(const KernelForm& form, const std::vector<double>& coefficients);

/// Fits over a tensor grid of gears, and between them: every coefficient is a polynomial through the entries in 1/Z, beta
/// and x. An entry of beta stands, with its ends exchanged, for -beta as well, and one of beta = 0 is made alike at both
/// ends: what both ends have in common is even in beta, what tells them apart is odd. The face width does not enter.
///
/// Whatever the coefficients, the kernels are positive semi-definite.
class RefinementLibrary {
 public:
  /// @throws InvalidInput "library" where entries are not all combinations of their teeth, helix angles (the first 0)
  ///         and profile shifts, once each, or have coefficients of another form
  explicit RefinementLibrary(std::vector<RefinementEntry> entries);

  /// The one that comes with the program, from `library/teeth.txt`.
  static const RefinementLibrary& shipped();

  const std::vector<RefinementEntry>& entries() const { return entries_; }
  const std::vector<int>& teeth() const { return teeth_; }                      ///< ascending
  const std::vector<double>& helix_angles() const { return helix_angles_; }     ///< ascending [rad]
  const std::vector<double>& profile_shifts() const { return profile_shifts_; }  ///< ascending

  /// What of a gear, or of its material, lies outside of what the library knows, as "helix_angle 38 deg, in the library 0 .. 35
  /// deg"; empty where nothing does. It knows gears of its own rack, pressure angle and tip, within the ranges of its
  /// entries, of material with nu = 0.25 .. 0.35 and faces of 2 to 30 modules.
  std::string unknown(const GearToMesh& gear, double poissons_ratio) const;

  /// The gear itself, or what within the ranges of the entries is nearest in each fact.
  GearFacts nearest(GearFacts gear) const;

  /// Coefficients for a gear within the ranges.
  std::vector<double> coefficients(const GearFacts& gear) const;

 private:
  std::vector<RefinementEntry> entries_;  ///< profile shift runs fastest, then the helix angle
  std::vector<int> teeth_;
  std::vector<double> helix_angles_, profile_shifts_;
};

}  // namespace flankwright
