#pragma once

#include "core/base/units.hpp"
#include "core/compliance/finite_element/gear_mesh.hpp"

namespace flankwright::test {

/// Of Young's modulus one: influence values are then in the thesis' unit E m_n K.
inline const Material kUnit{1, 0.3};

/// A gear with Haddad's rack, alpha_n = 20 deg; sizes in modules.
inline GearToMesh gear_of(int teeth, double helix_deg, double width = 6, double shift = 0, double module = 1) {
  GearToMesh gear;
  gear.gear.teeth = teeth;
  gear.gear.face_width = width * module;
  gear.gear.profile_shift = shift;
  gear.normal_module = module;
  gear.pressure_angle = 20 * units::deg;
  gear.helix_angle = helix_deg * units::deg;
  return gear;
}

/// A mesh just fine enough to have all that the default has.
inline GearMeshOptions coarse() {
  GearMeshOptions options;
  options.flank_elements = 3;
  options.fillet_elements = 3;
  options.half_thickness_elements = 1;
  options.adjacent_flank_elements = 2;
  options.adjacent_fillet_elements = 2;
  options.teeth_each_side = 1;
  options.end_element = 0.6;
  options.largest_element = 1.2;
  options.body_growth = 2.5;
  options.shaft_elements = 1;
  return options;
}

}  // namespace flankwright::test
