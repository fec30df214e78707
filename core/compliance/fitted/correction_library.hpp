#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/compliance/finite_element/gear_mesh.hpp"
#include "core/compliance/fitted/correction_grid.hpp"

namespace flankwright {

/// A line of text for an entry and back, in full precision but for the covariance: its lower triangle, row by row, in four
/// digits. Lines that start with # are remarks.
std::string to_text(const CorrectionEntry& entry);
/// @throws InvalidInput "library" with the number of the line that is no entry
std::vector<CorrectionEntry> entries_in(std::string_view text);

/// The parameters that select an entry of the library.
GearProportions facts_of(const GearToMesh& gear);
ReferenceProfile profile_of(const GearToMesh& gear);

/// Fits of gears of the standard reference profile, CorrectionGrid, and what other profiles change of them:
///
///     c(gear, profile) = c_0(gear) + sum over grids k of w_k(profile) (c_k(gear_k) - c_0(gear_k)),    gear_k = nearest of grid k,
///
/// the other grids being of three other racks at the standard pressure angle, the departure of a profile from the
/// standard one (addendum, dedendum, root radius) being a weighted sum of theirs, and of other pressure angles with the
/// standard rack, with the weights of Lagrange's polynomials. Interaction of rack and pressure angle is left out.
///
/// Whatever the coefficients, the kernels are positive semi-definite.
class CorrectionLibrary {
 public:
  /// @throws InvalidInput "library" as CorrectionGrid; and where there is no standard profile, where others depart in rack and pressure
  ///         angle at once, or where other racks are neither none nor three with independent departures
  explicit CorrectionLibrary(const std::vector<CorrectionEntry>& entries);

  /// The one that comes with the program, from `library/teeth.txt`.
  static const CorrectionLibrary& shipped();

  /// Of all grids; that of the standard profile comes first.
  const std::vector<CorrectionEntry>& entries() const { return entries_; }
  const CorrectionGrid& standard() const { return grids_.front(); }

  /// The parameters of a gear or its material outside the library, as "helix_angle 38 deg, in the library 0 .. 35 deg";
  /// empty where there are none. The library covers gears with the tip that their rack gives them, within the ranges of
  /// its entries, with nu = 0.25 .. 0.35 and faces of 2 to 30 modules.
  std::string unknown(const GearToMesh& gear, double poissons_ratio) const;

  /// Coefficients for a gear within the ranges; outside them, those of the nearest gear within.
  std::vector<double> coefficients(const GearProportions& gear, const ReferenceProfile& profile = {}) const;

 private:
  /// Weights of the grids other than the standard one.
  std::vector<double> weights(const ReferenceProfile& profile) const;
  ReferenceProfile nearest(ReferenceProfile profile) const;

  std::vector<CorrectionEntry> entries_;
  std::vector<CorrectionGrid> grids_;       ///< the standard one, other racks, other pressure angles
  std::vector<ReferenceProfile> profiles_;  ///< of the grids
  std::size_t racks_{0};                    ///< how many other racks, 0 or 3
};

}  // namespace flankwright
