#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "tests/benchmarks/contact_truth/contact_run.hpp"
#include "core/gear/gear_pair.hpp"

/// The pairs and positions at which CalculiX is asked.
namespace flankwright::contact_truth {

/// Haddad's rack and pinion, m_n = 10 mm.
inline PairData pair_data(double helix_angle_deg, double face_width, int wheel_teeth = 54) {
  PairData data;
  data.normal_module = 10;
  data.helix_angle = helix_angle_deg * units::deg;
  data.pinion.teeth = 18;
  data.wheel.teeth = wheel_teeth;
  data.pinion.face_width = data.wheel.face_width = face_width;
  return data;
}

/// A position of such a pair; the bores leave 2.5 and 3.75 modules below the roots (of large
/// wheels more, which the program's own mesh asks for). Aligned spur pairs are halved at
/// mid face.
inline ContactTask contact_task(const PairData& data, double phase, double approach_um, double lead_crowning_um = 0, double crossing_urad = 0) {
  const GearPair pair = make_gear_pair(data);
  ContactTask task{.pair = data, .phase = phase, .approach = approach_um * units::um};
  task.condition.modification.pinion.lead_crowning = lead_crowning_um * units::um;
  task.condition.misalignment.crossing = 1e-6 * crossing_urad;
  const double module = data.normal_module;
  task.bore_radius = {pair.pinion.root_radius - 2.5 * module,
                      std::min(pair.wheel.root_radius - 3.75 * module, 0.89 * (pair.wheel.root_radius - 0.5 * module))};
  task.half_face = data.helix_angle == 0 && crossing_urad == 0;
  return task;
}

struct ContactCase {
  std::string name;
  ContactTask task;
};

/// Of spur pairs one tooth pair carries all at phases 1 .. 1.35, two share the rest; helical ones (total contact
/// ratio 1.99) have two pairs in mesh nearly always.
inline std::vector<ContactCase> contact_cases() {
  const PairData spur = pair_data(0, 40), helical = pair_data(30, 40);
  return {{"spur, after A", contact_task(spur, 0.45, 45)},
          {"spur, two pairs", contact_task(spur, 0.65, 45)},
          {"spur, before E", contact_task(spur, 0.90, 45)},
          {"spur, one pair", contact_task(spur, 1.15, 45)},
          {"spur, one pair, 20 um of lead crowning", contact_task(spur, 1.15, 60, 20)},
          {"helical, 0.50", contact_task(helical, 0.50, 45)},
          {"helical, 0.75", contact_task(helical, 0.75, 45)},
          {"helical, 1.00", contact_task(helical, 1.00, 45)},
          {"helical, 1.25", contact_task(helical, 1.25, 45)},
          {"helical, 1.00, crossed by 500 urad", contact_task(helical, 1.00, 55, 0, 500)},
          {"wide spur, one pair", contact_task(pair_data(0, 120, 72), 1.15, 45)},
          {"narrow spur, one pair", contact_task(pair_data(0, 10), 1.15, 45)}};
}

/// Meshes by name: coarse, medium (the default), fine; "ends" has thin layers at the face ends, "pressure" elements
/// narrow enough for the stress at the contact.
inline ContactMeshOptions contact_mesh_options(std::string_view name) {
  if (name == "coarse") {
    return {.flank = 10, .fillet = 2, .across = 3, .into_depth = 2.6, .end_layer = 2, .layer_growth = 1.8, .largest_layer = 8};
  }
  if (name == "ends") {
    ContactMeshOptions options = contact_mesh_options("coarse");
    options.end_layer = 1;
    options.layer_growth = 1.7;
    options.largest_layer = 10;
    return options;
  }
  if (name == "fine") {
    return {.flank = 16, .across = 5, .finest = 0.3, .into_depth = 2, .end_layer = 1, .layer_growth = 1.5, .largest_layer = 4, .body_rings = 3};
  }
  if (name == "pressure") return {.flank = 24, .across = 5, .finest = 0.15};  // for the narrow pair
  return {};
}

}  // namespace flankwright::contact_truth
