#include "studies/results/used_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "studies/analysis/governing_cases.hpp"
#include "studies/results/bodies_json.hpp"
#include "studies/results/compliance_json.hpp"
#include "studies/results/shaft_json.hpp"
#include "studies/results/unit_json.hpp"

namespace flankwright::studies {

namespace {

Json generation_json(const Generation& generation) {
  if (const auto* rack = std::get_if<ParabolicRack>(&generation)) {
    return {{"kind", "parabolic_rack"}, {"coefficient_per_mm", rack->coefficient}};
  }
  if (const auto* tool = std::get_if<RevolutionTool>(&generation)) {
    return {{"kind", "revolution"},
            {"half_apex_deg", in_deg(tool->half_apex)},
            {"distance_mm", tool->distance},
            {"arc_radius_mm", std::isfinite(tool->arc_radius) ? Json(tool->arc_radius) : Json("infinite: a cone")}};
  }
  return {{"kind", "rack"}};
}

Json pieces_json(const std::optional<int>& pieces) { return pieces ? Json(*pieces) : Json("through every point"); }

/// False where the gear has no grid.
Json grid_json(const GivenGrid& grid) {
  if (grid.file.empty()) return false;
  return {{"file", grid.file},
          {"radii", grid.rows},
          {"axial_positions", grid.columns},
          {"radius_mm", {grid.lowest_radius, grid.highest_radius}},
          {"z_mm", {grid.lowest_z, grid.highest_z}},
          {"profile_pieces", pieces_json(grid.profile_pieces)},
          {"face_pieces", pieces_json(grid.face_pieces)},
          {"residual_rms_um", in_um(grid.rms)},
          {"residual_largest_um", in_um(grid.largest)}};
}

/// What finishes the flanks; what a kind does not use is not in it.
Json process_json(const GrindingProcess& process) {
  Json json{{"kind", to_string(process.kind)}};
  const bool form = process.kind == GrindingKind::FormGrinding;
  if (form || process.kind == GrindingKind::GeneratingGrinding) json["twist_compensation"] = process.twist_compensation;
  if (form) json["grinding_wheel_diameter_mm"] = process.wheel_diameter;
  return json;
}

Json macro_json(const StudyResults& results, Member member) {
  const Gear& gear = results.pair[member];
  const Material& material = results.study.material[member];
  Json macro{{"teeth", gear.data.teeth},
             {"face_width_mm", gear.data.face_width},
             {"profile_shift", gear.data.profile_shift},
             {"tooth_thickness_allowance_um", in_um(gear.data.tooth_thickness_allowance)},
             {"tip_diameter_mm", 2.0 * gear.tip_radius},
             {"usable_face_width_mm", gear.face.width()},
             {"tip_form_diameter_mm", 2.0 * gear.tip_form_radius},
             {"tip_rounding_mm", gear.data.tip_rounding},
             {"end_rounding_mm", gear.data.end_rounding},
             {"rack", {{"addendum", gear.data.rack.addendum}, {"dedendum", gear.data.rack.dedendum}, {"root_radius", gear.data.rack.root_radius}}},
             {"generation", generation_json(gear.data.generation)},
             {"process", process_json(results.study.modification[member].process)},
             {"grid", grid_json(results.study.grid[member])},
             {"grid_of_opposite_flank", grid_json(results.study.opposite_grid[member])},
             {"youngs_modulus_MPa", material.youngs_modulus},
             {"poissons_ratio", material.poissons_ratio}};
  for (const auto& [key, chamfer] : {std::pair{"tip_chamfer", gear.data.tip_chamfer}, std::pair{"end_chamfer", gear.data.end_chamfer}}) {
    if (chamfer.amount > 0.0) macro[key] = {{"amount_mm", chamfer.amount}, {"angle_deg", chamfer.angle / units::deg}, {"radius_mm", chamfer.radius}};
  }
  return macro;
}

Json used_gear_json(const StudyResults& results, Member member) {
  Json json = macro_json(results, member);
  if (const auto& runs = results.structures.finite_elements) json["body"] = body_json((*runs)[member].body);
  json["shaft"] = shaft_json(results.study.shaft[member]);
  return json;
}

Json cycle_json(const StudyResults& results) {
  const Cycle& cycle = results.study.cycle;
  const bool are_rated = std::ranges::any_of(results.loaded, [](const LoadedResult& loaded) { return loaded.rating.has_value(); });
  return {{"positions", cycle.positions},
          {"phases", cycle.phases},
          {"peaks", locates_peaks(results.study) ? "refined"
                    : are_rated                  ? "refined in the load cases that use the strength most"
                                                 : "sampled"},
          {"automatic", cycle.automatic_positions && cycle.phases.empty()}};
}

/// Without the round-off of conversions to the units of the keys.
Json without_round_off(Json json) {
  if (json.is_number_float()) return units::without_round_off(json.get<double>());
  if (json.is_structured()) {
    for (Json& part : json) part = without_round_off(std::move(part));
  }
  return json;
}

/// The load cases that have their contact points, and whose word that is.
Json output_json(const StudyResults& results) {
  const std::vector<bool> kept = cases_with_points(results);
  return {{"points", kept_points(results) == CasesWithPoints::All ? "all" : "governing"},
          {"points_by", results.study.points ? "study" : fmt::format("default: all up to {} load cases", most_cases_with_points)},
          {"load_cases_with_points", std::ranges::count(kept, true)}};
}

}  // namespace

Json quadrature_json(const Quadrature& quadrature) {
  constexpr std::array names{"gauss2", "gauss3", "midpoint", "graded"};  // in the order of QuadratureRule
  return {{"rule", names[static_cast<std::size_t>(quadrature.rule)]}, {"intervals", quadrature.intervals}};
}

Json used_json(const StudyResults& results) {
  const Study& study = results.study;
  const PairData& data = study.pair;
  Json used{{"pair",
             {{"normal_module_mm", data.normal_module},
              {"pressure_angle_deg", in_deg(data.pressure_angle)},
              {"helix_angle_deg", in_deg(data.helix_angle)},
              {"centre_distance_mm", results.pair.centre_distance},
              {"driver", name_of(data.driver)},
              {"working_flank", name_of(data.working_flank)},
              {"pinion", used_gear_json(results, Member::Pinion)},
              {"wheel", used_gear_json(results, Member::Wheel)}}},
            {"unloaded", {{"marking_thickness_um", in_um(study.marking_thickness)}}},
            {"cycle", cycle_json(results)},
            {"fidelity",
             {{"compliance", to_string(study.fidelity.compliance)},
              {"gap", to_string(study.fidelity.gap)},
              {"quadrature", quadrature_json(study.fidelity.quadrature)},
              {"accuracy", study.fidelity.accuracy ? Json(*study.fidelity.accuracy) : Json()},
              {"effects", study.fidelity.automatic_effects ? "auto" : "listed"}}}};
  if (!results.loaded.empty()) used["output"] = output_json(results);
  if (!study.unit.empty()) used["unit"] = unit_json(study.unit);
  if (study.misalignment.pinion_lead_angle != 0.0) {
    used["misalignment"] = {
        {"pinion_lead_angle", "lead angle changed, normal pressure angle kept: pitch radius, base radius and screw parameter follow"}};
  }
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    if (const auto& correction = results.structures.corrections[member]) {
      used["fidelity"]["fits"][name_of(member)] = correction->source();
    }
  }
  if (!results.models.empty() && results.structures.pair == nullptr) {
    used["thin_slice"] = {{"calibration", results.models.front().calibration}};
  }
  return without_round_off(std::move(used));
}

}  // namespace flankwright::studies
