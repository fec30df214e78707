#pragma once

#include <string_view>

namespace flankwright::studies {

/// The pair and its flanks, the same in every template: between the title and the working conditions.
inline constexpr std::string_view template_pair = R"(
[pair]
normal_module = 4                    # mm; or, instead of it, normal_diametral_pitch in 1/in
pressure_angle = 20                  # deg, normal section
helix_angle = 15                     # deg, 0 is a spur gear
# centre_distance = 125              # mm; by default that of the profile shifts, where backlash comes from tooth_thickness_allowance alone
# driver = "wheel"                   # the pinion, unless said
# working_flank = "left"             # of the pinion: left is the coast side

[pinion]
teeth = 20
face_width = 40                      # mm
# hand = "left"                      # of the helix: right, unless said; the wheel has the other
profile_shift = 0.2                  # in normal modules, + outwards
# tooth_thickness_allowance = -60    # um, E_sn of the normal tooth thickness; here and on the wheel it makes the backlash
# tip_diameter = 92                  # mm; by default from rack and profile shift
# edges = { tip_rounding = 0.2, end_rounding = 0.2 }   # mm; by default 0.05 normal modules
# process = "generating_grinding"    # or "form_grinding": either twists the lead modification of helical teeth; "topological" does not
# twist_compensation = 0.5           # part of that twist that the machine takes out, 0 .. 1
# grinding_wheel_diameter = 300      # mm, of form grinding
# generation = { kind = "parabolic_rack", coefficient = 0.0005 }     # 1/mm; by default "rack", the straight one: an involute
# For a spur pair also: { kind = "revolution", half_apex = 80, distance = 4.5, arc_radius = 12700 }   (deg, mm, mm)
rack = { addendum = 1, dedendum = 1.25, root_radius = 0.39 }         # in normal modules

[wheel]
teeth = 40
face_width = 40
profile_shift = 0
rack = { addendum = 1, dedendum = 1.25, root_radius = 0.39 }

# Modifications: material removed, in um. Manufacturing errors have tables of their own, [pinion.error] and
# [wheel.error], and the other sign: metal added.
[pinion.modification]
lead_crowning = 6                    # removed at both face ends
# lead_slope = 5                     # over the face width; + removes at z = +b/2
# profile_crowning = 4               # parabola about the pitch point
# profile_slope = 3                  # + removes at the tip
tip_relief = { amount = 10, height = 1.5 }                           # height: mm, measured down from the tip
# root_relief = { amount = 5, height = 1 }                           # height: mm, up from the start of active profile
# end_relief = { amount = 10, length = 4 }                           # length: mm, from each face end
# twist = 2
# parabolic_te = 0.5                 # arcsec/deg^2: a of a transmission error -a phi1^2 that is designed in, one arc a pitch
# A measured or topological flank: grid = "flank.csv", columns radius_mm, z_mm, deviation_um (+ = metal added)

[wheel.modification]
tip_relief = { amount = 10, height = 1.5 }

[pinion.error]
# helix_slope = 5                    # over the face width; + adds at z = +b/2
# profile_slope = 3                  # + adds at the tip
# pitch = 2                          # adjacent pitch error, adds up from tooth to tooth

# Shafts, where their bending and torsion shall enter; also [wheel.shaft]. Positions count along z from one end of the shaft, in mm:
#    [pinion.shaft]
#    sections = [{ length = 40, outer_diameter = 45 }, { length = 100, outer_diameter = 55, inner_diameter = 20 }]
#    bearings = [{ position = 15, radial_stiffness = 500 }, { position = 125 }]      # N/um; rigid, unless said
#    gear_position = 80              # of its mid face
#    torque_position = 0             # where the torque enters

[material]
youngs_modulus = 206000              # MPa; "206 GPa" is understood as well, as everywhere
poissons_ratio = 0.3
# strength = { kind = "case_hardened", quality = "MQ", hardness = 700 }          # by ISO 6336-5: safeties and damage; core_hardness = 32 (HRC)
# contact_endurance_limit = 1450     # MPa, instead of the table's; likewise root_endurance_limit
)";

}  // namespace flankwright::studies
