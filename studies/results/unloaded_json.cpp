#include "studies/results/unloaded_json.hpp"

namespace flankwright::studies {

namespace {

Json direction_json(const FlankDirection& pinion, const FlankDirection& wheel) {
  return {{"pinion", {{"radius", pinion.radius}, {"z", pinion.z}}}, {"wheel", {{"radius", wheel.radius}, {"z", wheel.z}}}};
}

/// Null for edges, which have no common tangent plane; an axis without end (line contact) is null, too.
Json ellipse_json(const ContactMark& mark) {
  if (std::isnan(mark.ellipse.semi_minor)) return nullptr;
  return {{"semi_major_mm", mark.ellipse.semi_major},
          {"semi_minor_mm", mark.ellipse.semi_minor},
          {"major", direction_json(mark.pinion_major, mark.wheel_major)},
          {"minor", direction_json(mark.pinion_minor, mark.wheel_minor)}};
}

Json contact_json(const ToothContact& contact, const ContactMark& mark) {
  return {{"phi1_deg", in_deg(contact.phi1)},
          {"phi2_deg", in_deg(contact.phi2)},
          {"te_arcsec", in_arcsec(contact.transmission_error)},
          {"te_slope_arcsec_per_deg", in_arcsec_per_deg(contact.slope)},
          {"contact", to_string(contact.kind)},
          {"carries", mark.carries},
          {"pinion", {{"radius_mm", contact.pinion_radius}, {"z_mm", contact.pinion_z}}},
          {"wheel", {{"radius_mm", contact.wheel_radius}, {"z_mm", contact.wheel_z}}},
          {"ellipse", ellipse_json(mark)}};
}

Json pairs_json(const UnloadedResult& unloaded) {
  Json pairs = Json::array();
  for (std::size_t i = 0; i < unloaded.mesh.pairs.size(); ++i) {
    const PairCurve& curve = unloaded.mesh.pairs[i];
    Json positions = Json::array();
    for (std::size_t j = 0; j < curve.positions.size(); ++j) {
      positions.push_back(contact_json(curve.positions[j], unloaded.marks[i][j]));
    }
    pairs.push_back({{"tooth", curve.tooth}, {"sequence", contact_sequence(curve)}, {"positions", std::move(positions)}});
  }
  return pairs;
}

Json transfer_json(const Transfer& transfer) {
  return {{"phi1_deg", in_deg(transfer.phi1)},
          {"te_arcsec", in_arcsec(transfer.transmission_error)},
          {"from_tooth", transfer.from_tooth},
          {"to_tooth", transfer.to_tooth},
          {"slope_before_arcsec_per_deg", in_arcsec_per_deg(transfer.slope_before)},
          {"slope_after_arcsec_per_deg", in_arcsec_per_deg(transfer.slope_after)},
          {"slope_jump_arcsec_per_deg", in_arcsec_per_deg(transfer.slope_jump())}};
}

Json mesh_json(const UnloadedMesh& mesh, double wheel_base_radius) {
  return {{"phi1_deg", list(mesh.phi1, in_deg)},
          {"te_arcsec", list(mesh.transmission_error, in_arcsec)},
          {"te_um", list(mesh.transmission_error, [&](double te) { return in_um(te * wheel_base_radius); })},
          {"peak_to_peak_arcsec", in_arcsec(mesh.peak_to_peak)},
          {"peak_to_peak_um", in_um(mesh.peak_to_peak * wheel_base_radius)},
          {"harmonics_arcsec", list(mesh.harmonics, in_arcsec)},
          {"transfers", list(mesh.transfers, transfer_json)}};
}

Json pattern_json(const BearingPattern& pattern, double thickness) {
  Json separation = Json::array();
  for (Eigen::Index row = 0; row < pattern.separation.rows(); ++row) {
    Json values = Json::array();
    for (Eigen::Index column = 0; column < pattern.separation.cols(); ++column) {
      values.push_back(in_um(pattern.separation(row, column)));  // infinite becomes null
    }
    separation.push_back(std::move(values));
  }
  return {{"radius_mm", pattern.radius},
          {"z_mm", pattern.z},
          {"separation_um", std::move(separation)},
          {"covered_percent", 100.0 * pattern.covered(thickness)}};
}

Json parabola_json(const ParabolaCheck& check) {
  return {{"wanted_arcsec_per_deg2", in_arcsec_per_deg2(check.wanted)},
          {"found_arcsec_per_deg2", in_arcsec_per_deg2(check.found)},
          {"shift_deg", in_deg(check.shift)},
          {"residual_arcsec", in_arcsec(check.residual)},
          {"holds", check.holds},
          {"why", check.why}};
}

}  // namespace

Json unloaded_json(const UnloadedResult& unloaded, const GearPair& pair) {
  const int teeth = pair.data.pinion.teeth;
  Json json{{"scene", unloaded.scene},
            {"sequence", whole_sequence(unloaded, teeth, false)},
            {"carrying_sequence", whole_sequence(unloaded, teeth, true)},
            {"pairs", pairs_json(unloaded)},
            {"mesh", mesh_json(unloaded.mesh, pair.wheel.base_radius)},
            {"bearing_pattern",
             {{"marking_thickness_um", in_um(unloaded.marking_thickness)},
              {"pinion", pattern_json(unloaded.pinion_pattern, unloaded.marking_thickness)},
              {"wheel", pattern_json(unloaded.wheel_pattern, unloaded.marking_thickness)}}}};
  if (unloaded.parabola) json["parabolic_te"] = parabola_json(*unloaded.parabola);
  return json;
}

}  // namespace flankwright::studies
