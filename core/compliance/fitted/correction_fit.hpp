#pragma once

#include <vector>

#include "core/compliance/finite_element/influence.hpp"
#include "core/compliance/fitted/fit_compliance.hpp"
#include "core/compliance/fitted/correction_library.hpp"

namespace flankwright {

/// The mesh that `fitted` solves for every gear: fine enough for the gear body, the neighbouring teeth and whatever is
/// a module or more away from the load. The body has the elements of the default mesh, so that both are equally stiff
/// there; a difference would otherwise end up in the kernels of the tooth. So has the fillet, for root stress. Its
/// layers are at most about as long as the stations of station_grid() are apart. With layers twice as long, values along
/// the tip vary with the position in the layer, and the table's splines overshoot between them by up to a third of the
/// value where the tip is pointed. No sum of kernels, which are positive, can correct that. The folder's README
/// compares both meshes.
GearMeshOptions coarse_mesh();

/// The gear that a library's entry is made from: m_n = 1, the body of GearBody's defaults.
GearToMesh standard_gear(const GearProportions& gear, const ReferenceProfile& profile = {});

/// A tensor grid of stations on a tooth.
std::vector<FlankStation> places_on(const std::vector<double>& us, const std::vector<double>& zetas);

/// The samples of a fine-mesh correction: a gear's influence values by the fine mesh, with those by the coarse one as
/// the part that is `given`.
struct CorrectionSamples {
  InfluenceSample fitted;  ///< 6 radii x about 9 + 0.9 B axial positions, symmetric about mid face
  InfluenceSample unseen;  ///< 5 radii x the positions midway between those, for the residuals alone
};

/// @param fine, coarse  of that gear, E m_n K; the target of the fit, and what it is added to
CorrectionSamples correction_samples(const GearProportions& gear, const FlankCompliance& fine, const FlankCompliance& coarse);

/// Largest face width over m_n in the runs for a gear's own fit [-]: kernels are local and hardly depend on the face
/// (the library's, of 8 modules, serve 2 to 30), while the fine mesh of a wide face takes minutes and gigabytes. The
/// folder's README gives their residuals on wider faces.
inline constexpr double widest_own_fit = 12.0;

/// Pairs count relative to max(|K|, kScaleFloor sqrt(K_pp K_qq)), in the fit and in its residuals.
inline constexpr double kScaleFloor = 0.01;

/// Fits KernelForm::correction(). For a spur gear the fit is nearly alike at both ends, as the samples are; they differ
/// because the torque leaves at one end.
/// @param start  coefficients of a neighbouring entry, which the fit is drawn towards; empty: flat_start()
CorrectionEntry fit_correction(const CorrectionSamples& samples, const std::vector<double>& start);

}  // namespace flankwright
