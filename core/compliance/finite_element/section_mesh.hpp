#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

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

/// A face end of a helical tooth by the angle between loaded flank and face there: less than a right angle, or more.
/// The acute end of a spur gear is the one at z = -b/2 of GearToMesh.
enum class FaceEnd { Acute, Obtuse };

/// Bore over shaft diameter where no bore is given: as near to a solid shaft as elements go.
inline constexpr double default_bore_share = 0.05;

/// The gear body: a solid disc as wide as the face, on a hollow shaft that runs through it.
struct GearBody {
  double shaft_diameter{not_given};  ///< d_s [mm]; not given: default_shaft_diameter()
  double bore_diameter{not_given};   ///< [mm], > 0; not given: default_bore_share d_s
  double shaft_overhang{not_given};  ///< length of the shaft beyond each face end [mm], > 0; not given: 0.5 d_s
  /// The end at which torque and axial force leave the gear. The gear is twisted between this end and the load.
  /// Haddad's sample outputs show the default: pinion loads that fall towards the other, acute end.
  FaceEnd torque_end{FaceEnd::Obtuse};
  /// Everything inside rim_radius() is rigid. Only the teeth and the material below them yield, as Vedmar modelled them
  /// [Haddad 1991, 1.4.3.2].
  bool rigid{false};

  bool operator==(const GearBody&) const = default;
};

/// Steward's rule for helical gears [Haddad 1991, eq. 2.4]: d_s = 0.8 d, at most 25 m_n / cos(beta). Departure: at
/// most the root diameter less 1.2 m_n (which matters below 18 teeth), so that a rim is left.
double default_shaft_diameter(const ToothForm& form, double normal_module);

/// Where the teeth's own material ends and the gear's body begins [mm]: 1.25 m_n below the root circle, or the shaft's surface where that is
/// less than 1.8 m_n below it. Elastic half-planes under a tooth are taken to reach "a few modules" below the pitch point [Haddad 1991,
/// 1.3.2]; this is 2.5 of them with a standard rack.
double rim_radius(const ToothForm& form, double shaft_diameter, double normal_module);

/// An edge of a quad: corner, mid-side, corner.
using SectionEdge = std::array<int, 3>;

/// Lines of one detailed tooth in the section.
struct SectionTooth {
  std::vector<SectionEdge> centre_line;  ///< tip to bore
  std::vector<SectionEdge> flank;        ///< right-hand involute, tip to start of fillet
  std::vector<SectionEdge> fillet;       ///< right-hand fillet, down to its lowest point
};

/// A mid-side node where two elements of a ring meet one that is as long as both: it follows that one's edge.
struct SectionTie {
  int node{-1};
  SectionEdge edge{};  ///< of the long element; its mid-side is the corner that the two share
  double along{0};     ///< -1 at the edge's first corner, 1 at its last
};

/// The part of the gear that an element of the section belongs to. Where no tooth is detailed the plain ring counts as
/// body, as adjacent teeth do.
enum class SectionPart { LoadedTooth, Body, Shaft };

/// Transverse section of a gear at z = 0 in quadratic 8-node quads, origin in the axis, tooth 0 along +y. Corners run
/// counter-clockwise, mid-sides 1-2, 2-3, 3-4, 4-1. All nodes of flanks and fillets lie exactly on them.
struct SectionMesh {
  double root_radius{not_given};  ///< [mm]
  Eigen::Matrix2Xd nodes;         ///< [mm]
  Eigen::Matrix<int, 8, Eigen::Dynamic> quads;
  std::vector<SectionPart> parts;   ///< of every quad
  std::vector<SectionTooth> teeth;  ///< -n .. n, counter-clockwise
  std::vector<SectionTie> ties;     ///< ring by ring, inwards
};

/// Radii of shaft and bore, given or by their rules [mm].
struct SectionRadii {
  double shaft{not_given}, bore{not_given};
};

/// The radii from which section_mesh() starts, with all its checks; nothing is meshed.
///
/// @throws InvalidInput  a tooth without a tip ("tip_diameter"), a shaft that does not fit into the root
///                       ("body.shaft_diameter"), a bore that does not fit into the shaft ("body.bore_diameter"), an
///                       option out of range, or fewer teeth than are to be detailed ("options.teeth_each_side")
SectionRadii section_radii(const ToothForm& form, int teeth, double normal_module, const GearBody& body, const GearMeshOptions& options);

/// The toothed ring has one block per half tooth, spanned between the profile (flank, fillet, half the root land) and
/// the line that comes down the tooth's centre and turns, on a circle below the root, towards the gap's centre; where
/// there is no detailed tooth a plain ring ends at the root circle. Rings of elements follow, down to the bore, of fewer and fewer
/// elements (GearMeshOptions::layer_share).
///
/// @throws InvalidInput  as section_radii()
SectionMesh section_mesh(const ToothForm& form, int teeth, double normal_module, const GearBody& body, const GearMeshOptions& options);

}  // namespace flankwright
