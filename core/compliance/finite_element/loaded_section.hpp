#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/compliance/finite_element/section_mesh.hpp"
#include "core/gear/pair_geometry.hpp"

namespace flankwright {

/// Heights on the flank at which a LoadedSection is loaded, (r - r_Ff)/(r_a - r_Ff).
inline constexpr std::array section_heights{0.05, 0.12, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.78, 0.85, 0.9, 0.94, 0.97};

/// A point of the loaded flank in the section, lengths in modules.
struct SectionPlace {
  Eigen::Vector2d position, normal;  ///< outward
  double centre_depth;               ///< along the normal to the tooth's centre line
  double law_depth;                  ///< h of the contact law, ContactPoint::pinion_depth
};

/// Elements of a section that shows a Hertzian pressure on the flank and the stress in the fillet.
GearMeshOptions fine_section();

/// One tooth of a gear in its section across the contact line, in plane strain, m_n = 1 and E = 1, under unit line loads at section_heights of three kinds:
///
/// - Hertz's pressure on the flank, of a half width that is thin against the tooth;
/// - a line of patches as in flank_functional(), as root stress in three dimensions has its loads;
/// - centre_functional() over the tooth's centre surface, integrated across the face, as the structure has them.
///
/// The section is that of the equivalent spur gear (z_n, rounded, with the gear's own normal profile and tip height) and its face b/cos(beta_b). The blocks of its teeth end as
/// far below the root as those of the gear in three dimensions do; two modules below it the body is rigid.
struct LoadedSection {
  /// @param gear     of the pair; teeth, profile, tip and face are used
  /// @param pair     m_n, alpha_n and beta_b
  /// @param nu       Poisson's ratio, 0 .. < 0.5
  /// @param options  elements along flank and fillet and across the tooth
  /// @param body     of the gear [mm]; only the depth of what bounds its teeth counts
  LoadedSection(const Gear& gear, const GearPair& pair, double nu, GearMeshOptions options, const GearBody& body = {});

  double poissons_ratio;
  ToothForm form;
  SectionMesh mesh;
  double half_width{not_given};       ///< L of the pressure
  std::vector<SectionPlace> places;   ///< at section_heights
  Eigen::MatrixXd by_flank;           ///< displacements of the nodes, node by node (x, y), under the pressure, a column for each height
  Eigen::MatrixXd by_patch;           ///< under the patches
  Eigen::VectorXd flank_deflection;   ///< u_p: of the flank under the middle of its pressure
  Eigen::VectorXd centre_deflection;  ///< l_mid' A^-1 l_mean: of the functional of a point at mid face under the loads of all points

  const SectionTooth& loaded_tooth() const { return mesh.teeth[mesh.teeth.size() / 2]; }

 private:
  struct BelowTeeth;
  LoadedSection(const Gear& gear, const GearPair& pair, double nu, const GearMeshOptions& options, const BelowTeeth& below);
  static BelowTeeth below_teeth(const Gear& gear, const GearPair& pair, const GearBody& body);
  static GearBody section_body(const ToothForm& spur, const BelowTeeth& below);
};

}  // namespace flankwright
