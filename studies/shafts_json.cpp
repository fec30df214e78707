#include "studies/shafts_json.hpp"

#include <cmath>

namespace flankwright::studies {

namespace {

constexpr double newton_per_micrometre = 1000.0;  // N/mm

Json stiffness_json(double stiffness, double unit) { return std::isinf(stiffness) ? Json("rigid") : Json(stiffness / unit); }

Json motion_json(const ShaftMotion& motion) {
  if (std::isnan(motion.displacement)) return nullptr;
  return {{"displacement_um", in_um(motion.displacement)}, {"misalignment_um", in_um(motion.misalignment)}};
}

}  // namespace

Json shaft_json(const std::optional<ShaftData>& shaft) {
  if (!shaft) return false;
  return {{"sections", list(shaft->sections, [](const ShaftSection& section) -> Json {
             return {{"length_mm", section.length},
                     {"outer_diameter_mm", section.outer_diameter},
                     {"inner_diameter_mm", section.inner_diameter}};
           })},
          {"bearings", list(shaft->bearings, [](const ShaftBearing& bearing) -> Json {
             return {{"position_mm", bearing.position},
                     {"radial_stiffness_N_per_um", stiffness_json(bearing.radial_stiffness, newton_per_micrometre)},
                     {"axial_stiffness_N_per_um", stiffness_json(bearing.axial_stiffness, newton_per_micrometre)},
                     {"tilting_stiffness_Nm_per_rad", bearing.tilting_stiffness / units::newton_metre}};
           })},
          {"gear_position_mm", shaft->gear_position},
          {"torque_position_mm", shaft->torque_position},
          {"gear_stiffens", shaft->gear_stiffens},
          {"youngs_modulus_MPa", shaft->material.youngs_modulus},
          {"poissons_ratio", shaft->material.poissons_ratio}};
}

Json shaft_motion_json(const LoadedResult& loaded, const StudyResults& results) {
  if (!results.shafts) return nullptr;
  const MeshModel& model = results.models[loaded.model];
  Json json = Json::array();
  for (std::size_t i = 0; i < loaded.cycle.positions.size(); ++i) {
    const MeshPosition& at = model.positions[i];
    const LoadDistribution& load = loaded.cycle.positions[i].load;
    if (!load.usable()) {
      json.push_back(nullptr);
      continue;
    }
    const Eigen::VectorXd forces = at.weight.cwiseProduct(load.line_load);
    const auto motion = [&](Member m) { return results.shafts->motion(m, at.points, forces, model.axial_offset); };
    const ShaftMotion pinion = motion(Member::Pinion), wheel = motion(Member::Wheel);
    double together = 0.0;
    for (const ShaftMotion& one : {pinion, wheel}) together += std::isnan(one.misalignment) ? 0.0 : one.misalignment;
    json.push_back({{"phase", at.phase},
                    {"pinion", motion_json(pinion)},
                    {"wheel", motion_json(wheel)},
                    {"mesh_misalignment_um", in_um(together)}});
  }
  return json;
}

}  // namespace flankwright::studies
