#pragma once

#include <array>

#include "core/compliance/shaft/shaft_data.hpp"
#include "core/gear/gear_data.hpp"

/// The test rig's 21:54 pair and what was measured and calculated for it.
///
/// Source: C. D. Haddad, "The elastic analysis of load distribution in wide-faced helical gears", Ph.D. thesis, University of
/// Newcastle upon Tyne, 1991: chapters 5 and 6, table 5.1, appendices 2C, 6A and 6B.
namespace flankwright::reference::haddad_rig {

inline constexpr double youngs_modulus = 209000.0;  // MPa; 2C.8c has G = 80 390 MPa
inline constexpr double poissons_ratio = 0.3;
inline constexpr double torque = 526.5e3;                                        // N mm, on the pinion
inline constexpr std::array<double, 3> phases{0.5626147, 0.7752294, 0.9878441};  // of the pair 5/11, section 5.5.2

inline constexpr double measured_added_error = 48.4;  // um, section 5.6: by loading, at the pitch radius
/// By the thesis' own model at the three phases, end of section 6.5: difference of its transmission errors with and without
/// load, along the flank normal.
inline constexpr std::array<double, 3> calculated_added_error{48.328, 48.515, 48.538};  // um

inline PairData pair_data() {
  PairData data;
  data.normal_module = 5.0;
  data.helix_angle = 12 * units::deg;
  data.centre_distance = 191.689;
  data.pinion.teeth = 21;
  data.wheel.teeth = 54;
  for (GearData* gear : {&data.pinion, &data.wheel}) {
    gear->face_width = 90.0;
    gear->rack = {1.0, 1.4, 0.39};
  }
  return data;
}

/// Table 6B.1: deflections along the flank normal by a load at mid face, z from one end of the face [mm; um].
struct ShaftRow {
  double z;
  double wheel_shear, wheel_bending;  // the wheel's torsion is 0 throughout
  double pinion_torsion, pinion_shear, pinion_bending;
  double total;
};
inline constexpr std::array<ShaftRow, 14> shaft_deflections{{
    {0.00, 0.543, 0.179, 14.10, 1.233, 0.820, 16.055},
    {3.17, 0.546, 0.180, 14.30, 1.319, 0.870, 17.215},
    {11.83, 0.552, 0.185, 14.83, 1.556, 0.990, 18.113},
    {18.17, 0.557, 0.189, 15.22, 1.730, 1.070, 18.766},
    {26.83, 0.546, 0.193, 15.76, 1.967, 1.155, 19.639},
    {33.17, 0.569, 0.196, 16.15, 2.140, 1.200, 20.255},
    {41.83, 0.575, 0.199, 16.68, 2.377, 1.240, 21.071},
    {48.17, 0.570, 0.201, 16.88, 2.376, 1.247, 21.274},
    {56.83, 0.549, 0.204, 16.88, 2.138, 1.232, 21.003},
    {63.17, 0.543, 0.205, 16.88, 1.964, 1.203, 20.786},
    {71.83, 0.514, 0.207, 16.88, 1.726, 1.143, 20.470},
    {78.17, 0.498, 0.208, 16.88, 1.552, 1.085, 20.223},
    {86.83, 0.478, 0.209, 16.88, 1.313, 0.989, 19.869},
    {90.00, 0.470, 0.210, 16.88, 1.226, 0.950, 19.736},
}};

/// The drawings of the shafts are not in the text. Their dimensions follow from the table, by app. 2C: slope of the pinion's
/// torsion and of its shear over the face give the bore (two ways: 68.9 and 69.0 mm), the rest a least-squares fit of shear and
/// bending (to 0.01 um root mean square for the pinion, 0.004 um for the wheel), the twist at z = 0 the length to where the torque is held.
/// A moment that the overhung slave gears bring in at the second bearing was fitted beside them: at most 0.30 and 0.10 um
/// of the bending above, which these shafts lack.
inline ShaftData pinion_shaft() {
  ShaftData shaft;
  shaft.sections = {{292.0, 88.5, 69.0}};
  shaft.bearings = {{.position = 131.0, .axial_stiffness = std::numeric_limits<double>::infinity()}, {.position = 292.0}};
  shaft.gear_position = 211.0;
  shaft.torque_position = 0.0;
  shaft.material = {youngs_modulus, poissons_ratio};
  return shaft;
}
inline ShaftData wheel_shaft() {
  ShaftData shaft;
  shaft.sections = {{154.0, 82.5}};
  shaft.bearings = {{.position = 0.0, .axial_stiffness = std::numeric_limits<double>::infinity()}, {.position = 154.0}};
  shaft.gear_position = 77.5;
  shaft.torque_position = 122.5;
  shaft.material = {youngs_modulus, poissons_ratio};
  return shaft;
}

}  // namespace flankwright::reference::haddad_rig
