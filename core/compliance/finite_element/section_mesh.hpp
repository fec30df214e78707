#pragma once

#include "core/compliance/finite_element/gear_body.hpp"
#include "core/compliance/finite_element/section.hpp"
#include "core/gear/tooth_form.hpp"

namespace flankwright {

/// The fineness of a gear's mesh. Sizes in normal modules.
struct GearMeshOptions {
  int flank_elements{8};            ///< of the loaded tooth, tip to start of fillet, >= 1
  int fillet_elements{6};           ///< of the loaded tooth, >= 2
  int half_thickness_elements{3};   ///< centre surface to flank, every tooth, >= 1
  int adjacent_flank_elements{2};   ///< of the other detailed teeth, >= 1
  int adjacent_fillet_elements{2};  ///< of the other detailed teeth, >= 2
  int teeth_each_side{2};           ///< detailed teeth on either side of the loaded one, >= 1
  double end_element{0.15};         ///< axial size next to the face ends, > 0
  double axial_growth{1.4};         ///< size ratio of neighbouring layers, > 1
  double largest_element{0.4};      ///< axial size at mid face, >= end_element
  int most_layers{80};              ///< over the face; a wider face has longer layers at mid face, >= 4
  double body_growth{2.0};          ///< size ratio of neighbouring elements into the body and around it, > 1
  int shaft_elements{3};            ///< rings from the bore to the shaft's surface, >= 1
  /// Outside the loaded tooth layers are joined by twos, fours, ... The longest joined one is at most this fraction of
  /// the element's longest side in the section, or of its depth below the root circle (but of its radius at most), >=
  /// 0; 0: every layer runs all round. Next to the face ends the joined ones are of 1, 1, 2, 4, ... layers all the
  /// same. Below the teeth elements side by side are joined likewise, by twos from one ring to the next one inwards.
  double layer_share{0.75};

  /// Throws InvalidInput with field, value and violated bound.
  void validate() const;
  bool operator==(const GearMeshOptions&) const = default;
};

/// The radii from which section_mesh() starts, with all its checks; nothing is meshed.
///
/// @throws InvalidInput  a tooth without a tip ("tip_diameter"), a body that does not fit (as body_radii()), an option out of range, or fewer
///                       teeth than are to be detailed ("options.teeth_each_side")
BodyRadii section_radii(const ToothForm& form, int teeth, double normal_module, double face_width, const GearBody& body,
                        const GearMeshOptions& options);

/// The toothed ring has one block per half tooth, spanned between the profile (flank, fillet, half the root land) and
/// the line that comes down the tooth's centre and turns, on a circle below the root, towards the gap's centre; where
/// there is no detailed tooth a plain ring ends at the root circle. Rings of elements follow, down to the bore, of fewer and fewer
/// elements (GearMeshOptions::layer_share). The section has every part of the body, at whatever z it is.
///
/// @throws InvalidInput  as section_radii()
SectionMesh section_mesh(const ToothForm& form, int teeth, double normal_module, double face_width, const GearBody& body,
                         const GearMeshOptions& options);

}  // namespace flankwright
