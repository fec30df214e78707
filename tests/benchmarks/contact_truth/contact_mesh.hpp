#pragma once

#include <array>
#include <vector>

#include "core/compliance/finite_element/gear_body.hpp"
#include "core/compliance/finite_element/solid_model.hpp"
#include "core/contact/assembly/flank_assembly.hpp"
#include "core/contact/path/path_of_contact.hpp"
#include "core/gear/tooth_form.hpp"

namespace flankwright::contact_truth {

/// How finely a gear is meshed for contact. Sizes in mm.
struct ContactMeshOptions {
  int flank{12};              ///< elements from tip to start of fillet, loaded teeth
  int far_flank{2};           ///< the same, other detailed teeth
  int fillet{3};              ///< from there to the middle of the gap, >= 2
  int far_fillet{0};          ///< the same, teeth that are not loaded; 0: as many
  int across{4};              ///< centre surface to flank
  double finest{0.4};         ///< delta of the spacing along the flank: s = s_c + delta sinh(...)
  double into_depth{2.2};     ///< size ratio of neighbouring elements below the loaded flank
  double gap_depth{1};        ///< the same below the root in the middle of the gap and where nothing meshes; 1: even
  double end_layer{1.5};      ///< axial size at the ends of the common face, also beyond them on a wider gear
  double layer_growth{1.6};   ///< of neighbouring layers
  double largest_layer{6.0};  ///< axial size at mid face
  double middle_layer{0};     ///< axial size at mid face where layers grow from there towards both ends; 0: they grow from the ends
  double line_layer{0};       ///< axial size beside the ends of contact lines on the flanks; 0: layers do not depend on lines
  int body_rings{2};          ///< from below the teeth to the bore; of a gear on a web in rim and hub, four times as many in the web
  int form_teeth{1};          ///< teeth with their form on either side of those that are loaded
  double plain_element{20};   ///< widest element around the axis where nothing meshes [deg]
  double edge_finest{0};      ///< delta where contact reaches a rounded tip edge; 0: the same as elsewhere
  double edge_reach{0};       ///< distance of the contact from the edge below which it is taken to reach it
  double edge_blend{0};  ///< distance over which elements grow from edge_finest to finest, the contact in their middle; 0: at edge_reach, at once
};

/// One gear of the scene at one mesh position.
struct ContactGear {
  const GearPair* pair{nullptr};
  const Flank* flank{nullptr};  ///< the loaded one, with its modifications
  Member member{Member::Pinion};
  double line_phase{0};            ///< of tooth pair 0
  double bore_radius{0};           ///< where the gear is held [mm]
  int first{0}, last{0};           ///< tooth pairs that are meshed for contact; one more tooth on either side has its form
  bool half_face{false};           ///< z <= 0 only, mirrored at mid face (spur gears, symmetric flanks)
  const WebbedBody* web{nullptr};  ///< with its hub's diameter and width; null: a solid disc
};

/// An element's face of a loaded flank, as CalculiX counts them.
struct ElementFace {
  int brick;  ///< from 0
  int face;   ///< 1 .. 6
};

/// Corners, then sides' middles, of CalculiX' face 4 among the nodes of a brick, as face_shape() has them; the first local axis of a fillet's face runs down, the second
/// along +z.
inline constexpr std::array<int, 8> nodes_of_face_4{1, 2, 6, 5, 9, 18, 13, 17};

/// 20-node bricks of a gear with all of its body, in the frame of Flank.
struct ContactMesh {
  SolidMesh solid;
  std::vector<int> bore;                          ///< nodes
  std::vector<int> mid_face;                      ///< nodes at z = 0 where only half of the face is meshed
  std::vector<std::vector<ElementFace>> flanks;   ///< of pairs first .. last, with their roundings
  std::vector<std::vector<ElementFace>> fillets;  ///< below these flanks, to the middle of the gap: face 4, layer by layer and downwards
  std::vector<double> planes;                     ///< z of the layers' ends [mm]
  std::vector<int> rim;                           ///< bricks between root circle and underside of a rim on a web
};

/// Loaded teeth follow the true flank surface; other flanks and fillets are those of ToothForm, and where nothing
/// meshes the gear is a plain ring at root height. Elements are narrow around the contact line wherever it crosses the
/// flank: the spacing along the profile is s_c(z) + delta sinh(linear in the index), s the arc length and s_c the
/// undisturbed contact. On a web the rim is as wide as the face, web and hub have their own widths, and layers end where these do. A tip rounding is meshed on its true arc, and the spacing goes on over it onto the tip land; where contact reaches the
/// edge s_c is its end on the flank, and there is a node at s_c. The mate's s_c is where that edge meets it.
ContactMesh contact_mesh(const ContactGear& gear, const ContactMeshOptions& options);

}  // namespace flankwright::contact_truth
