#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/compliance/model/gear_structures.hpp"
#include "tests/benchmarks/contact_truth/contact_cases.hpp"

/// Wheels on webs, beside CalculiX.
namespace flankwright::gear_bodies {

using contact_truth::ContactTask;

/// Haddad's spur pair 18/54, m_n = 10 mm, b = 40 mm; both bores rigid; the wheel's rim of 3 modules on a web of a quarter of the face, between a hub of 260 mm
/// and the rim, or a solid disc.
/// @param offset  of the web [mm]; NaN: a solid disc
inline ContactTask webbed_task(double helix_angle_deg, double offset, double phase, double approach_um) {
  ContactTask task = contact_truth::contact_task(contact_truth::pair_data(helix_angle_deg, 40), phase, approach_um);
  task.bore_radius.wheel = 100;
  task.half_face = false;
  if (!std::isnan(offset)) {
    task.web.wheel = WebbedBody{.rim_thickness = 30, .web_thickness = 10, .web_offset = offset, .hub_diameter = 260, .hub_width = 40};
  }
  return task;
}

struct BodyCase {
  std::string name;
  ContactTask task;
};

/// Approaches at which about 2 kN m are carried.
inline std::vector<BodyCase> body_cases() {
  return {{"spur, solid", webbed_task(0, not_given, 1.15, 45)},
          {"spur, centred", webbed_task(0, 0, 1.15, 60)},
          {"spur, offset", webbed_task(0, 10, 1.15, 80)},
          {"helical, solid", webbed_task(30, not_given, 1.0, 45)},
          {"helical, centred", webbed_task(30, 0, 1.0, 100)},
          {"helical, offset", webbed_task(30, 10, 1.0, 100)},
          {"helical, offset the other way", webbed_task(30, -10, 1.0, 100)}};
}

/// The program's own bodies of a task: the same rims, webs and hubs, both bores held.
inline GearStructures own_structures(const ContactTask& task, ComplianceModel model) {
  ComplianceTask own{.pair = make_gear_pair(task.pair), .model = model, .material = {task.material, task.material}};
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    own.body[m] = {.bore_diameter = 2 * task.bore_radius[m], .hold = BodyHold::RigidBore, .web = task.web[m]};
  }
  return build_compliance(own);
}

/// Motion of the wheel's rim by CalculiX, as PairRimMotion has it; misalignment_at_teeth is not read.
inline RimMotion calculix_rim(const ContactTask& task, const contact_truth::ContactAnswer& answer) {
  const GearPair pair = make_gear_pair(task.pair);
  const double alpha = pair.working_transverse_pressure_angle;
  const Eigen::Vector3d t = answer.rim.wheel.head<3>(), omega = answer.rim.wheel.tail<3>();
  // The wheel lies at +x of the pinion and is pushed along the pinion's outward normal, in the transverse plane (sin(alpha), cos(alpha)).
  const double slope = omega.y() * std::sin(alpha) - omega.x() * std::cos(alpha);
  return {.radial = t.x(), .axial = t.z(), .tilt = std::hypot(omega.x(), omega.y()), .misalignment = slope * pair.face_width};
}

}  // namespace flankwright::gear_bodies
