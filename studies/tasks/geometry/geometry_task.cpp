#include "studies/study/task.hpp"

#include <fmt/format.h>

#include "core/base/units.hpp"
#include "studies/analysis/study_run.hpp"
#include "studies/study_file/template_text.hpp"

namespace flankwright::studies {

namespace {

/// A size of one gear, in the words of ISO 21771.
struct GearSize {
  const char *name, *symbol, *unit;
  double (*of)(const Gear&);
};

constexpr GearSize gear_sizes[] = {
    {"number of teeth", "z", "", [](const Gear& g) { return static_cast<double>(g.data.teeth); }},
    {"profile shift coefficient", "x", "", [](const Gear& g) { return g.data.profile_shift; }},
    {"tooth thickness allowance", "E_sn", "um", [](const Gear& g) { return g.data.tooth_thickness_allowance / units::um; }},
    {"generating profile shift", "x_E", "", [](const Gear& g) { return g.generating_profile_shift; }},
    {"reference diameter", "d", "mm", [](const Gear& g) { return 2.0 * g.reference_radius; }},
    {"base diameter", "d_b", "mm", [](const Gear& g) { return 2.0 * g.base_radius; }},
    {"tip diameter", "d_a", "mm", [](const Gear& g) { return 2.0 * g.tip_radius; }},
    {"tip form diameter", "d_Fa", "mm", [](const Gear& g) { return 2.0 * g.tip_form_radius; }},
    {"root diameter", "d_f", "mm", [](const Gear& g) { return 2.0 * g.root_radius; }},
    {"root form diameter", "d_Ff", "mm", [](const Gear& g) { return 2.0 * g.form_radius; }},
    {"start of active profile", "d_Nf", "mm", [](const Gear& g) { return 2.0 * g.active_root_radius; }},
    {"working pitch diameter", "d_w", "mm", [](const Gear& g) { return 2.0 * g.working_pitch_radius; }},
    {"face width", "b", "mm", [](const Gear& g) { return g.data.face_width; }},
    {"usable face width", "b_F", "mm", [](const Gear& g) { return g.face.width(); }},
    {"transverse tooth thickness", "s_t", "mm", [](const Gear& g) { return g.tooth_thickness; }},
    {"tooth thickness at the tip", "s_at", "mm", [](const Gear& g) { return g.tip_thickness; }},
};

/// A size of the mesh.
struct MeshSize {
  const char *name, *symbol, *unit;
  double (*of)(const GearPair&);
};

constexpr MeshSize mesh_sizes[] = {
    {"centre distance", "a_w", "mm", [](const GearPair& p) { return p.centre_distance; }},
    {"circumferential backlash", "j_wt", "um", [](const GearPair& p) { return p.backlash / units::um; }},
    {"normal backlash", "j_bn", "um", [](const GearPair& p) { return p.normal_backlash() / units::um; }},
    {"radial backlash", "j_r", "um", [](const GearPair& p) { return p.radial_backlash() / units::um; }},
    {"working pressure angle", "alpha_wt", "deg", [](const GearPair& p) { return p.working_transverse_pressure_angle / units::deg; }},
    {"base helix angle", "beta_b", "deg", [](const GearPair& p) { return p.base_helix_angle / units::deg; }},
    {"transverse base pitch", "p_et", "mm", [](const GearPair& p) { return p.transverse_base_pitch; }},
    {"transverse contact ratio", "eps_alpha", "", [](const GearPair& p) { return p.transverse_contact_ratio; }},
    {"overlap ratio", "eps_beta", "", [](const GearPair& p) { return p.overlap_ratio; }},
    {"total contact ratio", "eps_gamma", "", [](const GearPair& p) { return p.total_contact_ratio(); }},
};

std::string sizes_table(const StudyResults& results) {
  const GearPair& pair = results.pair;
  std::string out = fmt::format("{:<28}  {:<9}  {:>12}  {:>12}  {}\n", "", "", "pinion", "wheel", "");
  for (const GearSize& size : gear_sizes) {
    out += fmt::format("{:<28}  {:<9}  {:>12.6g}  {:>12.6g}  {}\n", size.name, size.symbol, size.of(pair.pinion), size.of(pair.wheel), size.unit);
  }
  out += "\n";
  for (const MeshSize& size : mesh_sizes) out += fmt::format("{:<28}  {:<9}  {:>12.6g}  {}\n", size.name, size.symbol, size.of(pair), size.unit);
  return out;
}

constexpr std::string_view geometry_head = R"(# Sizes of both gears and of their mesh. Nothing is loaded.
title = "My pair, its sizes"
task = "geometry"
)";

}  // namespace

/// Sizes of both gears and of their mesh; no contact is analysed.
extern const Task geometry_task{.name = "geometry",
                                .meaning = "The task `geometry` has no keys of its own.",
                                .loads_nothing = true,
                                .run = [](StudyRun&) {},  // the pair of the results is all it needs
                                .summary = sizes_table,
                                .study_template = [] { return std::string(geometry_head) + std::string(template_pair); }};

}  // namespace flankwright::studies
