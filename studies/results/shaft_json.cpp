#include "studies/results/shaft_json.hpp"

#include <cmath>

namespace flankwright::studies {

namespace {

constexpr double newton_per_micrometre = 1000.0;  // N/mm

Json stiffness_json(double stiffness, double unit) { return std::isinf(stiffness) ? Json("rigid") : Json(stiffness / unit); }

/// What the radial stiffness follows from where it depends on the load.
void add_law(const BearingLawData& law, Json& json) {
  json["radial_stiffness_N_per_um"] = law.has_table() ? "force_table" : name_of(law.type);
  if (law.has_table()) {
    json["force_table_N"] = law.table_force;
    json["deflection_table_um"] = list(law.table_deflection, in_um);
    return;
  }
  json["elements"] = law.elements;
  if (!std::isnan(law.element_diameter)) json["element_diameter_mm"] = law.element_diameter;
  if (!std::isnan(law.element_length)) json["element_length_mm"] = law.element_length;
  json["contact_angle_deg"] = std::isnan(law.contact_angle) ? 0.0 : in_deg(law.contact_angle);
}

/// It says all of how the bearing yields.
void add_matrix(const Eigen::MatrixXd& stiffness, Json& json) {
  for (const char* single : {"radial_stiffness_N_per_um", "axial_stiffness_N_per_um", "tilting_stiffness_Nm_per_rad"}) json.erase(single);
  Json& rows = json["stiffness_matrix_N_mm_rad"] = Json::array();
  for (const auto& row : stiffness.rowwise()) rows.push_back(std::vector<double>(row.begin(), row.end()));
}

}  // namespace

Json bearing_json(const ShaftBearing& bearing) {
  Json json{{"position_mm", bearing.position},
            {"radial_stiffness_N_per_um", stiffness_json(bearing.radial_stiffness, newton_per_micrometre)},
            {"axial_stiffness_N_per_um", stiffness_json(bearing.axial_stiffness, newton_per_micrometre)},
            {"tilting_stiffness_Nm_per_rad", bearing.tilting_stiffness / units::newton_metre}};
  if (bearing.has_matrix()) add_matrix(bearing.stiffness_matrix, json);
  if (bearing.law.given()) add_law(bearing.law, json);
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

}  // namespace flankwright::studies
