#pragma once

#include <cmath>

#include "core/base/error.hpp"
#include "tests/core/contact/contact_cases.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright::contact_cases {

/// Gears, misalignments and modifications far beyond what a designer would allow: 12 to 150 teeth, helix angles to 40 deg, face
/// widths of 2 to 60 modules, errors to 20 arcmin, amounts to 80 um of either sign on both gears, pitch errors.
struct WildCase {
  GearPair pair;
  FlankAssembly scene;
  double phi1;
};

inline Modification wild_modification(Random& random, const GearPair& pair, const Gear& gear) {
  const auto amount = [&] { return random.coin() ? random(-80 * units::um, 80 * units::um) : 0.0; };
  Modification m;
  m.lead_crowning = amount();
  m.lead_slope = amount();
  m.addendum_crowning = amount();
  m.dedendum_crowning = amount();
  m.profile_slope = amount();
  m.twist = amount();
  const double height = gear.tip_radius - gear.active_root_radius;
  for (ProfileRelief* relief : {&m.tip_relief, &m.root_relief}) {
    if (!random.coin()) continue;
    relief->amount = random(0.0, 80 * units::um);
    relief->height = random(0.1, 0.5) * height;
    relief->shape = random.coin() ? ReliefShape::Linear : ReliefShape::Parabolic;
  }
  if (random.coin()) {
    m.end_relief.amount = random(0.0, 80 * units::um);
    m.end_relief.length = random(0.05, 0.4) * gear.data.face_width;
  }
  if (random.coin()) {
    // The amount at the ends of the run through the mesh.
    const double end = units::pi / pair.data.pinion.teeth * (1.0 + pair.total_contact_ratio());
    m.parabolic_te = random(-80 * units::um, 80 * units::um) / (pair.wheel.base_radius * end * end);
  }
  return m;
}

inline PairData wild_pair_data(Random& random) {
  PairData data;
  data.normal_module = random(1.0, 8.0);
  data.pinion.teeth = random.integer(12, 150);
  data.wheel.teeth = random.integer(12, 150);
  data.helix_angle = random.coin() ? random(0.0, 40 * units::deg) : 0.0;
  data.pinion.profile_shift = random(-0.3, 0.6);
  data.wheel.profile_shift = random(-0.3, 0.6);
  data.pinion.face_width = random(2.0, 60.0) * data.normal_module;
  data.wheel.face_width = random.coin() ? data.pinion.face_width : random(0.7, 1.3) * data.pinion.face_width;
  data.pinion_hand = random.coin() ? Hand::Right : Hand::Left;
  data.working_flank = random.coin() ? WorkingFlank::Right : WorkingFlank::Left;
  return data;
}

inline Misalignment wild_misalignment(Random& random, double module) {
  Misalignment m;
  for (double Misalignment::*angle :
       {&Misalignment::crossing, &Misalignment::intersecting, &Misalignment::pinion_lead_angle, &Misalignment::pinion_pressure_angle}) {
    if (random.coin()) m.*angle = random(-20.0, 20.0) * units::arcmin;
  }
  if (random.coin()) m.centre_distance = random(-0.02, 0.1) * module;
  if (random.coin()) m.axial_offset = random(-0.5, 0.5) * module;
  if (random.coin()) m.mesh_misalignment = random(-80 * units::um, 80 * units::um);
  return m;
}

/// Draws until a pair can be built.
inline WildCase wild_case(Random& random) {
  while (true) {
    const PairData data = wild_pair_data(random);
    if (!find_problems(data).empty()) continue;
    const GearPair pair = make_gear_pair(data);
    const Misalignment misalignment = wild_misalignment(random, data.normal_module);
    const Modification pinion = wild_modification(random, pair, pair.pinion), wheel = wild_modification(random, pair, pair.wheel);
    PerGear<ManufacturingError> error;
    if (random.coin()) {
      error.pinion.pitch_step = random(-20 * units::um, 20 * units::um);
      const double first = random(-20 * units::um, 20 * units::um), last = random(-20 * units::um, 20 * units::um);
      error.wheel.cumulative_pitch = {first, 0.0, last};
    }
    const double phi1 = random(-0.5, 0.5) * (pair.total_contact_ratio() + 0.5) * 2 * units::pi / data.pinion.teeth;
    try {
      return {pair, assemble_flanks(pair, {.modification = {pinion, wheel}, .error = error, .misalignment = misalignment}), phi1};
    } catch (const InvalidInput&) {
      // an error of the helix or pressure angle that takes the base circle beyond the tip
    }
  }
}

}  // namespace flankwright::contact_cases
