#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/contact/gap/gap.hpp"
#include "core/contact/assembly/flank_assembly.hpp"
#include "core/contact/unloaded/search_density.hpp"
#include "core/contact/unloaded/section_maximum.hpp"
#include "core/flank/conjugate_field.hpp"

namespace flankwright {

/// The gap of a working condition, sought over the whole flanks: no assumption about where contact lies.
///
///     g = r_b2 cos(beta_b) ((N1/N2) phi1 - phi2(z)),     phi2(z) = max over rho1 of the wheel angle that puts the wheel's flank
///                                                       through the pinion's point (rho1, z), inside both flanks
///
/// In every transverse section z of every tooth pair the flanks of unloaded contact analysis (generated, modified,
/// measured, displaced by any misalignment, bounded by tips and face ends) are turned until they touch there. g is the
/// lag of the wheel behind uniform motion at this touch, measured like f_t. The smallest gap is the unloaded
/// transmission error, so that f_t tends to it as the load vanishes. For aligned, unmodified pairs g is that of the
/// plane of action to round-off: 0 between A and E, the clearance of app. 2A beyond E; before A app. 2A turns the
/// pinion to meet the wheel's tip, while here the wheel is turned: g is app. 2A's value for the pinion angle less the
/// clearance itself.
///
/// Departure: the wheel's lag is taken for the approach along the flank normal, as in the plane of action. Where the wheel's tip
/// edge meets the pinion's flank off that plane, the lever of the pinion's normal about the wheel's axis differs from r_b2
/// cos(beta_b) by the factor (N1/N2)/(dphi2/dphi1), 1 at A.
class SurfaceGap {
 public:
  /// @throws InvalidInput where the misalignment or a modification leaves no usable flank
  SurfaceGap(const GearPair& pair, const FlankCondition& condition);

  /// Gap at the sections of these points. Their positions along the profile matter only where a section misses the mate
  /// altogether (its edges pass each other): there it is the gap at the point itself.
  /// @param line_phase  of tooth pair 0, as the points were made for
  Gap at(const std::vector<ContactPoint>& points, double line_phase) const;

  /// dg/dp at each point for one modification parameter of one gear [mm/mm; parabolic_te mm rad], exact: the derivative
  /// at the fixed point at which the flanks are nearest, as that point is a maximum; on the wheel's tip or form circle
  /// with the contribution of that bound, on a kink the mean of both sides that holds the maximum. Of two equally near
  /// points it is that of the one found.
  /// @param gap  as at() gave it for these points
  Eigen::VectorXd derivative(const std::vector<ContactPoint>& points, const Gap& gap, Member member, ModificationParameter parameter) const;

  /// The points, each moved along its section to where the flanks are nearest, radii, curvature, depths and tip
  /// distances with it; without those whose section misses the mate. Clearances outside A .. E become those of the
  /// aligned pair, found likewise. Tip edges, and their clearances, move with the wheel along the profile as in FlankTouchSearch: a nearest point that is
  /// held by an edge does not say how far beyond it contact would be.
  std::vector<ContactPoint> place(const std::vector<ContactPoint>& points, double line_phase) const;

 private:
  NearestPoint nearest_point(const SectionMaximum& found, int tooth) const;
  std::vector<SectionMaximum> maxima(const std::vector<ContactPoint>& points, double line_phase) const;

  GearPair pair_;
  FlankCondition condition_;
  FlankAssembly assembly_;
  SearchDensity density_;
  std::array<std::shared_ptr<const PredesignedField>, 2> parabola_;  ///< by member; null where the coefficient is 0
};

}  // namespace flankwright
