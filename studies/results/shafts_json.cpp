#include "studies/results/shafts_json.hpp"

#include <cmath>

#include "studies/results/unit_json.hpp"

namespace flankwright::studies {

namespace {

constexpr double newton_per_micrometre = 1000.0;  // N/mm

Json stiffness_json(double stiffness, double unit) { return std::isinf(stiffness) ? Json("rigid") : Json(stiffness / unit); }

}  // namespace

Json bearing_json(const ShaftBearing& bearing) {
  Json json{{"position_mm", bearing.position},
            {"radial_stiffness_N_per_um", stiffness_json(bearing.radial_stiffness, newton_per_micrometre)},
            {"axial_stiffness_N_per_um", stiffness_json(bearing.axial_stiffness, newton_per_micrometre)},
            {"tilting_stiffness_Nm_per_rad", bearing.tilting_stiffness / units::newton_metre}};
  if (!bearing.name.empty()) json["name"] = bearing.name;
  if (bearing.radial_clearance > 0.0) json["radial_clearance_um"] = in_um(bearing.radial_clearance);
  return json;
}

Json shaft_json(const std::optional<ShaftData>& shaft) {
  if (!shaft) return false;
  return {
      {"sections",
       list(shaft->sections,
            [](const ShaftSection& section) -> Json {
              return {{"length_mm", section.length}, {"outer_diameter_mm", section.outer_diameter}, {"inner_diameter_mm", section.inner_diameter}};
            })},
      {"bearings", list(shaft->bearings, bearing_json)},
      {"gear_position_mm", shaft->gear_position},
      {"torque_position_mm", shaft->torque_position},
      {"gear_stiffens", shaft->gear_stiffens},
      {"youngs_modulus_MPa", shaft->material.youngs_modulus},
      {"poissons_ratio", shaft->material.poissons_ratio}};
}

void add_shaft_motion(const LoadedResult& loaded, const StudyResults& results, Json& json) {
  const MeshModel& model = results.models[loaded.model];
  const ShaftPair shafts = results.shafts->at_torque(loaded.torque);
  if (shafts.has_unit() || results.shafts->depends_on_load()) json["unit"] = unit_state_json(shafts.state(loaded.torque, model.axial_offset));
  double sum = 0.0;  // of the positions' misalignment; NaN where one has no load distribution
  json["shafts"] = Json::array();
  for (std::size_t i = 0; i < loaded.cycle.positions.size(); ++i) {
    const MeshPosition& at = model.positions[i];
    const LoadDistribution& load = loaded.cycle.positions[i].load;
    if (!load.usable()) {
      json["shafts"].push_back(nullptr);
      sum = not_given;
      continue;
    }
    const Eigen::VectorXd forces = at.weight.cwiseProduct(load.line_load);
    Json entry{{"phase", at.phase}};
    double together = 0.0;
    for (const auto& [member, name] : {std::pair{Member::Pinion, "pinion"}, std::pair{Member::Wheel, "wheel"}}) {
      entry[name] = nullptr;
      if (!shafts.has_shaft(member)) continue;
      const ShaftMotion motion = shafts.motion(member, at.points, forces, model.axial_offset);
      entry[name] = {{"displacement_um", in_um(motion.displacement)}, {"misalignment_um", in_um(motion.misalignment)}};
      together += motion.misalignment;
    }
    entry["mesh_misalignment_um"] = in_um(together);
    json["shafts"].push_back(std::move(entry));
    sum += together;
  }
  json["summary"]["shaft_misalignment_um"] = in_um(sum / static_cast<double>(loaded.cycle.positions.size()));
}

}  // namespace flankwright::studies
