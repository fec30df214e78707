#pragma once

#include <map>
#include <vector>

#include "tests/benchmarks/contact_truth/contact_cases.hpp"

/// What CalculiX 2.20 (Debian 12) found: C3D20R, penalty 2e7 MPa/mm; spur pairs without crowning by the medium mesh
/// (48,681 and 66,903 unknowns), the others by the coarse one (28,527 and 69,861). contact_truth.md has the rest.
namespace flankwright::contact_truth {

/// Force per mm of face width on a tooth pair, mean over a layer.
struct FaceLoad {
  int tooth;
  double begin, end;      ///< z [mm]
  double per_face_width;  ///< [N/mm]
};

struct ContactFigure {
  ContactTask task;
  double torque;                 ///< on the pinion [N mm]
  std::map<int, double> shares;  ///< of tooth pairs [-]
  std::vector<FaceLoad> loads;   ///< of layers that no contact line ends in, of helical pairs nor the face
};

inline std::vector<ContactFigure> spur_figures() {
  const PairData spur = pair_data(0, 40);
  const double inner = -6.0790, middle = -12.1581, outer = -16.0486, last = -18.4802;
  return {{contact_task(spur, 1.15, 45),
           2356561.784,
           {{0, 1.0}},
           {{0, -20, last, 658.7}, {0, last, outer, 711.5}, {0, outer, middle, 712.54}, {0, middle, inner, 690.51}, {0, inner, 0, 695.73}}},
          {contact_task(spur, 0.65, 45),
           3791179.135,
           {{0, 0.47518}, {1, 0.52482}},
           {{0, outer, middle, 546.62},
            {0, middle, inner, 523.16},
            {0, inner, 0, 527.73},
            {1, outer, middle, 603.03},
            {1, middle, inner, 581.12},
            {1, inner, 0, 585.20}}},
          {contact_task(spur, 1.15, 60, 20),
           2826249.497,
           {{0, 1.0}},
           {{0, -18.0080, -14.4223, 584.00}, {0, -14.4223, -7.9681, 855.22}, {0, -7.9681, 0, 1059.74}}}};
}

inline std::vector<ContactFigure> helical_figures() {
  const PairData helical = pair_data(30, 40);
  return {{contact_task(helical, 1.0, 45),
           3177385.463,
           {{0, 0.58492}, {1, 0.41508}},
           {{0, -14.4223, -7.9681, 491.77},
            {0, -7.9681, 0, 580.55},
            {0, 0, 7.9681, 636.57},
            {0, 7.9681, 14.4223, 673.95},
            {1, -14.4223, -7.9681, 628.98},
            {1, -7.9681, 0, 642.05}}}};
}

/// Loads of the helical position's layers at the end faces, where flank and face are not at right angles.
inline std::vector<FaceLoad> helical_end_loads() {
  return {{0, -20, -18.0080, 207}, {0, -18.0080, -14.4223, 366}, {0, 14.4223, 18.0080, 625}, {0, 18.0080, 20, 399}, {1, -20, -18.0080, 392}};
}

/// Stress next to the flank where elements are narrow enough to show it: outermost integration points lie 0.04 mm under a contact 0.82 mm wide
/// ("pressure" mesh, 36,267 unknowns): a layer of the spur pair with a face of one module.
struct StressFigure {
  ContactTask task;
  LayerLoad layer;
};
inline StressFigure stress_figure() { return {contact_task(pair_data(0, 10), 1.15, 45), {0, -3.0769, 0, 690.5817 * 3.0769, 1071.85}}; }

/// Largest principal stress below the loaded flank of a tooth, over the whole face.
struct RootStressFigure {
  Member member;
  int tooth;
  double tangent;  ///< at the 30 deg tangent [MPa]
  double largest;  ///< anywhere along the fillet [MPa]
};
struct RootFigure {
  ContactTask task;
  double torque;  ///< on the pinion [N mm]
  std::vector<RootStressFigure> stresses;
};
/// Mesh "fine roots", 65,226 and 97,578 unknowns. "roots", 40,284 and 57,408, has 0.04 to 0.5 % less at the tangents (1.0 % at the wheel's low contact), and 1.0 % more to 0.2 % less at the largest.
inline std::vector<RootFigure> spur_root_figures() {
  const auto cases = root_cases();
  return {{cases[0].task, 2352812.1, {{Member::Pinion, 0, 181.31, 186.06}, {Member::Wheel, 0, 155.49, 164.92}}},
          {cases[1].task,
           3787944.4,
           {{Member::Pinion, 0, 140.09, 140.51},
            {Member::Pinion, 1, 200.25, 202.25},
            {Member::Wheel, 0, 170.04, 176.21},
            {Member::Wheel, 1, 107.83, 112.92}}},
          {cases[2].task, 2821720.1, {{Member::Pinion, 0, 226.45, 232.87}, {Member::Wheel, 0, 193.99, 205.78}}}};
}
/// Mesh "roots", 105,852 unknowns.
inline RootFigure helical_root_figure() {
  return {root_cases()[3].task,
          3173609.3,
          {{Member::Pinion, 0, 154.85, 158.29},
           {Member::Pinion, 1, 162.88, 162.94},
           {Member::Wheel, 0, 168.88, 177.03},
           {Member::Wheel, 1, 132.24, 139.22}}};
}

/// A position where contact reaches a rounded tip edge, in plane strain.
struct EdgeFigure {
  ContactTask task;
  double torque;  ///< on the pinion [N mm]
  int edge_pair;  ///< the tooth pair that touches with the edge
  double share;   ///< of that pair [-]
  double stress;  ///< largest compression next to the flank or the rounding, in that pair [MPa]
};

/// Meshes as edge_settings() makes them; the second and the last of 28 x 9 and 36 x 10 elements.
inline std::vector<EdgeFigure> edge_figures() {
  return {{edge_task(0.1, Member::Wheel, 0.035, 3), 1575.356, 0, 0.23435, 1640.6},
          {edge_task(0.1, Member::Wheel, -0.005, 3), 1972.312, 0, 0.41110, 1092.7},
          {edge_task(0.1, Member::Pinion, 0.035, 3), 1618.2547, 0, 0.26885, 1691.7},
          {edge_task(0.1, Member::Wheel, 0.04, 4.5), 2472.700, 0, 0.25625, 2174.9}};
}

/// A layer of the tooth pair on the edge, and its mean force per mm of face.
struct LayerFigure {
  double begin, end;  ///< z [mm]
  double force;       ///< [N/mm]
};

/// helical_edge_task(0.1, 4) on the mesh `fine`: 14 x 5 elements, layers of 0.06 mm where the line of contact meets the edge at z = 0.
struct HelicalEdgeFigure {
  double torque{10110.6};  ///< on the pinion [N mm]
  double share{0.3942};    ///< of tooth pair 0, which is on the edge for z > 0 [-]
  std::vector<LayerFigure> layers{{-2.500, -1.109, 46.50}, {-1.109, -0.477, 56.95}, {-0.477, -0.190, 61.47},
                                  {-0.190, -0.059, 64.62}, {-0.059, 0.000, 67.20},  {0.000, 0.059, 63.60},
                                  {0.059, 0.190, 54.26},   {0.190, 0.477, 37.83},   {0.477, 1.109, 7.35}};
};

}  // namespace flankwright::contact_truth
