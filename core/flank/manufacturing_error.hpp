#pragma once

#include <memory>
#include <vector>

#include "core/gear/deviation_field.hpp"

namespace flankwright {

/// Manufacturing error of one gear [Haddad 1991, eq. 6.1]: metal *added* is positive, in the transverse plane
/// along the base tangent, mm. Never to be mixed with Modification.
struct ManufacturingError {
  double helix_slope{0.0};    ///< f_Hbeta over the face width, linear, zero at mid face; + adds at z = +b/2
  double profile_slope{0.0};  ///< f_Halpha over the active profile height, zero at the reference circle; + adds at the tip
  double twist{0.0};          ///< f_yz: added twist * (y / h_active) * (z / b)
  /// Additional errors of single teeth, the same quantities: tooth k has entry k mod size; empty: all teeth are alike.
  /// k counts teeth as for the pitch.
  std::vector<double> helix_slopes{}, profile_slopes{}, twists{};
  /// Cumulative pitch deviation of tooth k is pitch_step * k, or cumulative_pitch[k mod size] where the list is
  /// not empty; k counts teeth in the order in which they come into mesh before the reference tooth.
  double pitch_step{0.0};
  std::vector<double> cumulative_pitch{};
  /// Measured deviation of single teeth [mm, + into the tooth as every DeviationField]: entry k mod size, none where null; empty: none.
  std::vector<std::shared_ptr<const DeviationField>> topographies{};

  bool operator==(const ManufacturingError&) const = default;
};

/// The slopes and the twist of one tooth's flank [mm], see ManufacturingError.
struct ToothError {
  double helix_slope{0.0}, profile_slope{0.0}, twist{0.0};
};
ToothError tooth_error(const ManufacturingError& error, int tooth);

/// The measured deviation of one tooth's flank; null where there is none.
const DeviationField* tooth_topography(const ManufacturingError& error, int tooth);

/// Whether the gear's teeth differ in place or shape. A mesh cycle then does not end where it began.
bool teeth_differ(const ManufacturingError& error);

/// Cumulative pitch deviation of tooth k [mm], see ManufacturingError.
double pitch_deviation(const ManufacturingError& error, int tooth);

}  // namespace flankwright
