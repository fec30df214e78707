#pragma once

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/benchmarks/contact_truth/contact_run.hpp"
#include "tests/core/gear/pair_cases.hpp"
#include "core/base/error.hpp"
#include "core/compliance/local/hertz_line.hpp"
#include "core/gear/gear_pair.hpp"

/// The pairs and positions at which CalculiX is asked.
namespace flankwright::contact_truth {

/// Haddad's rack and pinion, m_n = 10 mm.
inline PairData pair_data(double helix_angle_deg, double face_width, int wheel_teeth = 54) {
  return pair_cases::pair_data(18, wheel_teeth, helix_angle_deg, 10, face_width);
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

/// A spur pair 27/43, m_n = 2 mm, with rounded tips, b = 1 mm in plane strain, where contact reaches the rounded edge of one gear: the wheel's around the
/// start A of the path, the pinion's around its end E.
/// @param rounding  of both gears' tips [m_n]
/// @param outside   how far the pair is before A, or beyond E [base pitches]; < 0 inside
inline ContactTask edge_task(double rounding, Member edge, double outside, double approach_um) {
  PairData data = pair_cases::pair_data(27, 43, 0, 2, 1);
  data.pinion.tip_rounding = data.wheel.tip_rounding = rounding * data.normal_module;
  const PathOfContact path(make_gear_pair(data));
  ContactTask task = contact_task(data, edge == Member::Wheel ? path.before - outside : path.path_end() + outside, approach_um);
  task.plane_strain = true;
  return task;
}

/// A helical pair of the same teeth, b = 5 mm, whose line of contact leaves the flank over the pinion's tip edge at mid face.
inline ContactTask helical_edge_task(double rounding, double approach_um) {
  PairData data = pair_cases::pair_data(27, 43, 20, 2, 5);
  data.pinion.tip_rounding = data.wheel.tip_rounding = rounding * data.normal_module;
  const PathOfContact path(make_gear_pair(data));
  return contact_task(data, path.path_end() - path.phase_at(0.0, 0.0), approach_um);
}

/// The spur pair with a face of one module, aligned, and a wheel that is wider.
inline ContactTask uneven_task(double wheel_face_width) {
  PairData data = pair_data(0, 10);
  data.wheel.face_width = wheel_face_width;
  return contact_task(data, 1.15, 45);
}

struct ContactCase {
  std::string name;
  ContactTask task;
};

/// Edges of 0.05, 0.1 and 0.2 m_n that have entered, or not yet left, and at the flank's end, at two approaches.
inline std::vector<ContactCase> edge_cases() {
  std::vector<ContactCase> cases;
  for (const double approach : {3.0, 5.0}) {
    for (const double rounding : {0.1, 0.05, 0.2}) {
      for (const Member edge : {Member::Wheel, Member::Pinion}) {
        for (const double outside : {0.035, -0.005}) {
          std::ostringstream name;
          name << "edge of the " << name_of(edge) << ", " << rounding << " m_n, " << outside << " outside, " << approach << " um";
          cases.push_back({name.str(), edge_task(rounding, edge, outside, approach)});
        }
      }
    }
  }
  return cases;
}

/// Of spur pairs one tooth pair carries all at phases 1 .. 1.35, two share the rest; helical ones (total contact
/// ratio 1.99) have two pairs in mesh nearly always.
inline std::vector<ContactCase> contact_cases() {
  const PairData spur = pair_data(0, 40), helical = pair_data(30, 40);
  std::vector<ContactCase> cases{{"spur, after A", contact_task(spur, 0.45, 45)},
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
                                 {"narrow spur, one pair", contact_task(pair_data(0, 10), 1.15, 45)},
                                 {"faces of 10 and 10.5 mm", uneven_task(10.5)}};
  for (ContactCase& c : edge_cases()) cases.push_back(std::move(c));
  cases.push_back({"helical edge, 0.1 m_n", helical_edge_task(0.1, 4)});
  return cases;
}

/// Where root stress is compared.
inline std::vector<ContactCase> root_cases() {
  const PairData spur = pair_data(0, 40);
  return {{"root, spur, one pair", contact_task(spur, 1.15, 45)},
          {"root, spur, two pairs", contact_task(spur, 0.65, 45)},
          {"root, spur, one pair, 20 um of lead crowning", contact_task(spur, 1.15, 60, 20)},
          {"root, helical, 1.00", contact_task(pair_data(30, 40), 1.00, 45)}};
}

/// A pair over a mesh cycle at one torque.
struct CycleCase {
  std::string name;
  PairData pair;
  double torque{not_given};  ///< on the pinion [N mm]
  int positions{0};          ///< evenly spaced over a base pitch
};

/// As the positions of contact_cases(); the spur pair's torque is that of 45 um with one tooth pair.
inline std::vector<CycleCase> cycle_cases() {
  return {{"cycle, spur", pair_data(0, 40), 2357e3, 12}, {"cycle, helical", pair_data(30, 40), 3177e3, 8}};
}

/// A mesh for edge_task() and helical_edge_task(). Elements around the edge are a third as wide as half the contact strip of 20 N/mm on the rounding, and
/// grow from there.
/// @param flank, across  elements, ContactMeshOptions
/// @param middle_layer, growth  of the layers of a helical pair [mm, -], ContactMeshOptions
inline ContactSettings edge_settings(const ContactTask& task, int flank, int across, double middle_layer, double growth = 1.5) {
  const Material& m = task.material;
  ContactSettings settings;
  settings.mesh = {.flank = flank, .across = across, .finest = 0.04, .into_depth = 2.2, .end_layer = 10, .largest_layer = 10};
  settings.mesh.edge_finest = 0.3 * hertz_line(20, task.pair.pinion.tip_rounding, contact_modulus(m, m)).half_width;
  settings.mesh.edge_reach = settings.mesh.finest;
  settings.penalty = 1e9;    // 1500 MPa sink in by 2 nm, where a rounding is flattened by 50 to 200
  if (!task.plane_strain) {  // thin layers where the line of contact meets the edge
    settings.mesh.middle_layer = middle_layer;
    settings.mesh.edge_reach = 0;
    settings.mesh.edge_blend = 0.3;
    settings.mesh.layer_growth = growth;
    settings.mesh.largest_layer = 2;
  }
  return settings;
}

/// Helical pairs have far more layers, and therefore fewer elements in each: enough for the loads, too few for the pressure on the edge.
inline ContactSettings edge_settings(const ContactTask& task) {
  return task.plane_strain ? edge_settings(task, 24, 8, 0) : edge_settings(task, 14, 5, 0.25);
}
inline ContactSettings fine_edge_settings(const ContactTask& task) {
  return task.plane_strain ? edge_settings(task, 36, 10, 0) : edge_settings(task, 14, 5, 0.05, 2.2);
}

/// Meshes by name: coarse, medium (the default), fine; "ends" has thin layers at the face ends, "pressure" elements
/// narrow enough for the stress at the contact, "layers" and "fine layers" thinner ones still at the ends, for unequal faces; "lines" resolves the ends of lines on helical
/// teeth; "roots" and "fine roots" resolve the fillets.
/// @throws InvalidInput  for another name
inline const ContactMeshOptions& contact_mesh_options(std::string_view name) {
  static const std::map<std::string_view, ContactMeshOptions> meshes{
      {"coarse", {.flank = 10, .fillet = 2, .across = 3, .into_depth = 2.6, .end_layer = 2, .layer_growth = 1.8, .largest_layer = 8}},
      {"medium", {}},
      {"fine", {.flank = 16, .across = 5, .finest = 0.3, .into_depth = 2, .end_layer = 1, .layer_growth = 1.5, .largest_layer = 4, .body_rings = 3}},
      {"ends", {.flank = 10, .fillet = 2, .across = 3, .into_depth = 2.6, .end_layer = 1, .layer_growth = 1.7, .largest_layer = 10}},
      {"layers", {.flank = 10, .across = 3, .finest = 0.4, .end_layer = 0.2, .layer_growth = 1.8, .largest_layer = 3}},
      {"fine layers", {.flank = 14, .across = 4, .finest = 0.25, .end_layer = 0.1, .layer_growth = 1.6, .largest_layer = 3}},
      {"lines", {.flank = 16, .fillet = 2, .across = 4, .finest = 0.3, .into_depth = 2, .end_layer = 0.8, .layer_growth = 1.7, .largest_layer = 10}},
      {"line ends",
       {.flank = 12,
        .fillet = 2,
        .across = 3,
        .finest = 0.4,
        .into_depth = 2.4,
        .end_layer = 0.8,
        .layer_growth = 1.7,
        .largest_layer = 8,
        .line_layer = 0.5}},
      {"roots", {.flank = 10, .fillet = 6, .far_fillet = 2, .across = 4, .gap_depth = 1.8, .end_layer = 2, .layer_growth = 1.8, .largest_layer = 8}},
      {"fine roots", {.flank = 10, .fillet = 10, .far_fillet = 2, .across = 5, .into_depth = 2, .gap_depth = 1.8}},
      {"pressure", {.flank = 24, .across = 5, .finest = 0.15}},  // for the narrow pair
  };
  const auto found = meshes.find(name);
  if (found == meshes.end())
    throw InvalidInput("mesh", std::string(name), "coarse, medium, fine, ends, layers, fine layers, lines, line ends, roots, fine roots or pressure");
  return found->second;
}

}  // namespace flankwright::contact_truth
