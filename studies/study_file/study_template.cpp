#include "studies/study_file/study_template.hpp"

#include <string_view>

#include "core/base/error.hpp"

namespace flankwright::studies {

namespace {

/// The pair and its flanks, the same in every template: between the title and the working conditions.
constexpr std::string_view pair_and_flanks = R"(
[pair]
normal_module = 4                    # mm; or, instead of it, normal_diametral_pitch in 1/in
pressure_angle = 20                  # deg, normal section
helix_angle = 15                     # deg, 0 is a spur gear
# centre_distance = 125              # mm; without it the pair has no backlash
# driver = "wheel"                   # the pinion, unless said
# working_flank = "left"             # of the pinion: left is the coast side

[pinion]
teeth = 20
face_width = 40                      # mm
# hand = "left"                      # of the helix: right, unless said; the wheel has the other
profile_shift = 0.2                  # in normal modules, + outwards
# tip_diameter = 92                  # mm; by default from rack and profile shift
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
)";

constexpr std::string_view analyse_head =
    R"(# A loaded tooth contact analysis. Bare numbers have the unit in the comment; a text may carry its own: "0.1 mm".
title = "My pair, as it runs"
task = "analyse"
)";

constexpr std::string_view analyse_tail = R"(
[misalignment]
crossing = 1                         # arcmin, out of the plane of the axes; + closes the mesh at +z
# intersecting = 1                   # arcmin, in the plane of the axes; + opens the mesh at +z
# centre_distance = 0.05             # mm, + apart
# axial_offset = 0.5                 # mm, wheel towards +z
# mesh_misalignment = 10             # um over the face width; + opens at +z

[load]
torque = [0, 150, 300]               # N·m on the pinion; each is run, 0 is the unloaded contact

[unloaded]
# marking_thickness = 6.35           # um: of the compound that shows the bearing pattern

[cycle]
# positions = 64                     # mesh positions over one base pitch; left out: as many as the figures need

[fidelity]
compliance = "fitted"                # finite elements of both gears, solved once; "fe": finer ones; "thin_slice": none, at once
# quadrature = { rule = "graded", intervals = 24 }                   # along a full contact line; left out: as fine as the figures need
# gap = "whole_surface"              # contact sought over the whole flanks, not only where undisturbed ones would touch
# effects = ["bending", "hertzian_contact"]                          # "auto" decides from the study

# What the results must say, for `flankwright test`:
# [expect]
# "loaded.summary.te_peak_to_peak_um" = { max = 3 }
)";

constexpr std::string_view optimise_head = R"(# Flank modifications that hold over a set of working conditions.
title = "My pair, as it should be"
task = "optimise"
)";

constexpr std::string_view optimise_tail = R"(
[load]
torque = 300                         # N·m on the pinion

[cycle]
# positions = 64                     # mesh positions over one base pitch; left out: as many as the figures need

[fidelity]
compliance = "fitted"                # finite elements of both gears, solved once; "thin_slice": none, at once
# quadrature = { rule = "graded", intervals = 24 }                   # along a full contact line; left out: as fine as the figures need

# Each scene overrides what it names of [misalignment], [load], [pinion.error] and [wheel.error].
[[scenes]]
name = "aligned"

[[scenes]]
name = "housing bends"
misalignment.mesh_misalignment = 12  # um over the face width; + opens at +z
weight = 2                           # its share in mean and mean+2sigma

[[scenes]]
name = "part load, other way"
misalignment.mesh_misalignment = -8
load.torque = 120

[optimise]
objective = "peak_contact_stress"    # or te_peak_to_peak, te_harmonic_1 .. te_harmonic_10, load_factor, peak_line_load, peak_root_stress, edge_load
over = "worst"                       # nominal | worst | mean | mean+2sigma of the scenes
# solver = "ipopt"                   # left out: "nlopt:slsqp"; also nlopt:mma, nlopt:cobyla ...
# max_evaluations = 500
# max_seconds = "10 min"

[optimise.variables]                 # the search starts from the values above
"pinion.modification.lead_crowning" = [0, 30]                        # um
"pinion.modification.lead_slope" = [-20, 20]
"pinion.modification.tip_relief.amount" = [0, 40]

[optimise.constraints]
"te_peak_to_peak" = { max = 10 }     # um
)";

constexpr std::string_view sweep_head = R"(# How much a pair's figures scatter when housing, torque and manufacture do, and which of them is to blame.
title = "My pair, as it comes off the line"
task = "sweep"
)";

constexpr std::string_view sweep_tail = R"(
[load]
torque = 300                         # N·m on the pinion; one for a sweep, more in [sweep.parameters]

[cycle]
# positions = 64                     # mesh positions over one base pitch; left out: as many as the figures need

[fidelity]
compliance = "fitted"                # finite elements of both gears, solved once; "thin_slice": none, at once
# quadrature = { rule = "graded", intervals = 24 }                   # along a full contact line; left out: as fine as the figures need

[sweep]
samples = 1000
sampler = "sobol"                    # or "latin_hypercube", "monte_carlo"; "grid": every combination of levels
seed = 1                             # another seed, other samples
# indices = "off"                    # all samples independent, but no Sobol indices

# What scatters, in the unit of its key. Also { truncated_normal = [mean, deviation, low, high] }, { grid = [low, high, levels] } and
# { values = [...] }. What has no value above stands at its median in the nominal sample.
[sweep.parameters]
"misalignment.mesh_misalignment" = { normal = [0, 6] }               # um: mean, standard deviation
"load.torque" = { uniform = [250, 350] }                             # N·m
"pinion.error" = { iso_1328_class = 6 }                              # helix slope, profile slope and pitch, within their tolerances
"wheel.error.helix_slope" = { iso_1328_class = 6 }
# "pinion.modification.lead_crowning" = { uniform = [4, 8] }

# A run that was interrupted goes on where it stopped when it is started again. What the results must say, for `flankwright test`:
# [expect]
# "sweep.statistics.peak_contact_stress_MPa.quantiles.99 %" = { max = 900 }
)";

constexpr std::string_view accuracy_head = R"(# What accuracy costs: the pair analysed again and again, coarsely to finely, and held against the finest.
title = "My pair, how finely it must be analysed"
task = "accuracy"
)";

constexpr std::string_view accuracy_tail = R"(
[load]
torque = 300                         # N·m on the pinion

[cycle]
# positions = 64                     # mesh positions over one base pitch; left out: as many as the figures need

[fidelity]                           # the study's own settings are a rung of the ladder, too
compliance = "fitted"                # finite elements of both gears, solved once; "thin_slice": none, at once
# quadrature = { rule = "graded", intervals = 24 }                   # along a full contact line; left out: as fine as the figures need
# accuracy = "1 %"                   # chooses compliance, gap, quadrature and positions where they are not given

[accuracy.finest]                    # the rung that the others are held against
compliance = "fitted"                # or "fe", finer finite elements: minutes; "thin_slice": at once
# gap = "plane_of_action"            # by default contact is sought over the whole flanks
# intervals = 32                     # along a full contact line: 16, unless said
# positions = 128                    # over one base pitch: 64, unless said

# Errors are the worst over these; each overrides what it names.
[[scenes]]
name = "aligned"

[[scenes]]
name = "housing bends"
misalignment.mesh_misalignment = 12  # um over the face width; + opens at +z
)";

constexpr std::string_view fit_text = R"(# Compliance of each gear by finite elements, fitted by a sum of kernels and shown beside other models. Flank
# modifications, loads and misalignment play no part in it.
title = "My gears, how far they give way"
task = "fit"

[pair]
normal_module = 4                    # mm
pressure_angle = 20                  # deg, normal section
helix_angle = 15                     # deg, 0 is a spur gear

[pinion]
teeth = 20
face_width = 40                      # mm
profile_shift = 0.2                  # in normal modules, + outwards
rack = { addendum = 1, dedendum = 1.25, root_radius = 0.39 }         # in normal modules

[wheel]
teeth = 40
face_width = 40

[pinion.body]                        # what the teeth stand on; [wheel.body] alike
# shaft_diameter = 40                # mm; by default 0.8 d, at most 25 m_n/cos(beta)
# bore_diameter = 2                  # mm; by default 0.05 of the shaft
# shaft_overhang = 20                # mm beyond each face end; by default half the shaft's diameter

[material]
youngs_modulus = 206000              # MPa
poissons_ratio = 0.3

[fit]
gear = "both"                        # or "pinion", "wheel"
form = "one_tooth_accurate"          # the loaded tooth alone; "several_teeth" couples its neighbours, less closely
# test_grid = "off"                  # leaves out the comparison on places that the fit has not seen
# max_iterations = 600               # steps of the least squares

# What the fit must reach, for `flankwright test`:
# [expect]
# "fit.residuals.kernels.unseen.0.median_percent" = { max = 1 }      # 0: the loaded tooth, 1: one pitch away ...
)";

constexpr std::string_view slurm_text = R"(#!/bin/bash
# A sweep on a Slurm cluster, one shard a task of a job array:
#
#     sbatch sweep.sbatch my-gear.toml results/my-gear
#
# and when it is done, anywhere:   flankwright merge my-gear.toml --out results/my-gear
# The merge names shards that were lost; run those again:   sbatch --array=4,17 sweep.sbatch my-gear.toml results/my-gear
# A shard that was stopped goes on where it ended. Make shards of minutes: starting a task takes Slurm half a second, and each
# analyses the nominal sample first.
#SBATCH --job-name=flankwright
#SBATCH --array=1-20                 # shards 1 .. 20; the last number is also the one below
#SBATCH --cpus-per-task=4
#SBATCH --mem-per-cpu=500M           # "fitted" and "fe" need gigabytes where no earlier run has kept the finite elements
#SBATCH --time=01:00:00
#SBATCH --requeue
#SBATCH --output=flankwright-%A-%a.log
set -eu
shards=20
study=$1
folder=$2
exec "${FLANKWRIGHT:-flankwright}" run "$study" --out "$folder" --threads "${SLURM_CPUS_PER_TASK:-1}" --shard "$SLURM_ARRAY_TASK_ID/$shards"
)";

std::string text_of(std::string_view head, std::string_view tail) {
  return std::string(head) + std::string(pair_and_flanks) + std::string(tail);
}

}  // namespace

std::string study_template(const std::string& kind) {
  if (kind == "analyse") return text_of(analyse_head, analyse_tail);
  if (kind == "optimise") return text_of(optimise_head, optimise_tail);
  if (kind == "sweep") return text_of(sweep_head, sweep_tail);
  if (kind == "accuracy") return text_of(accuracy_head, accuracy_tail);
  if (kind == "slurm") return std::string(slurm_text);
  if (kind == "fit") return std::string(fit_text);
  const std::string allowed = "\"analyse\", \"optimise\", \"sweep\", \"accuracy\", \"fit\" or \"slurm\"";
  throw InvalidInput("KIND", kind, allowed);
}

}  // namespace flankwright::studies
