#pragma once

#include <map>
#include <vector>

#include "tests/benchmarks/contact_truth/contact_cases.hpp"

/// What CalculiX 2.20 (Debian 12) found; C3D20R, penalty 2e7 MPa/mm, meshes as named. contact_truth.md has the rest.
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
  std::vector<FaceLoad> loads;   ///< of layers that neither the face nor a contact line ends in
};

inline std::vector<ContactFigure> spur_figures() {
  const PairData spur = pair_data(0, 40);
  return {{contact_task(spur, 1.15, 45),
           2358038.771,
           {{0, 1.0}},
           {{0, -14.4223, -7.9681, 703.69}, {0, -7.9681, 0, 687.86}}},
          {contact_task(spur, 0.65, 45),
           3796785.359,
           {{0, 0.47446}, {1, 0.52554}},
           {{0, -14.4223, -7.9681, 530.67},
            {0, -7.9681, 0, 522.63},
            {1, -14.4223, -7.9681, 594.27},
            {1, -7.9681, 0, 580.15}}}};
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

}  // namespace flankwright::contact_truth
