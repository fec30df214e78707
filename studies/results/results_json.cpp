#include "studies/results/results_json.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <map>

#include "core/compliance/thin_slice/thin_slice.hpp"
#include "core/fidelity/cycle_quantities.hpp"
#include "core/flank/natural_twist.hpp"
#include "core/gear/tooth_form.hpp"
#include "studies/analysis/study_effects.hpp"
#include "studies/analysis/study_notes.hpp"
#include "studies/results/bodies_json.hpp"
#include "studies/results/drawing.hpp"
#include "studies/results/fidelity_choice_json.hpp"
#include "studies/results/compliance_json.hpp"
#include "studies/results/effects_json.hpp"
#include "studies/study_file/given_units.hpp"
#include "studies/analysis/governing_cases.hpp"
#include "studies/results/gradients_json.hpp"
#include "studies/base/json_format.hpp"
#include "studies/base/version.hpp"
#include "studies/results/life_json.hpp"
#include "studies/results/load_rating_json.hpp"
#include "studies/results/shafts_json.hpp"
#include "studies/results/unloaded_json.hpp"
#include "studies/results/used_json.hpp"

namespace flankwright::studies {

namespace {

constexpr int topography_sections = 41;  // grid of the modification maps, radius by face width
constexpr int profile_points = 80;       // of a drawn tooth

Json gear_json(const GearPair& pair, Member member) {
  const Gear& gear = pair[member];
  Json json{{"teeth", gear.data.teeth},
            {"hand", gear.hand == Hand::Right ? "right" : "left"},
            {"reference_diameter_mm", 2.0 * gear.reference_radius},
            {"base_diameter_mm", 2.0 * gear.base_radius},
            {"tip_diameter_mm", 2.0 * gear.tip_radius},
            {"tip_form_diameter_mm", 2.0 * gear.tip_form_radius},
            {"root_diameter_mm", 2.0 * gear.root_radius},
            {"form_diameter_mm", 2.0 * gear.form_radius},
            {"active_root_diameter_mm", 2.0 * gear.active_root_radius},
            {"working_pitch_diameter_mm", 2.0 * gear.working_pitch_radius},
            {"tooth_thickness_allowance_um", in_um(gear.data.tooth_thickness_allowance)},
            {"generating_profile_shift", gear.generating_profile_shift},
            {"tooth_thickness_mm", gear.tooth_thickness},
            {"tip_thickness_mm", gear.tip_thickness},
            {"virtual_teeth", gear.virtual_teeth},
            {"undercut", gear.undercut}};
  // One tooth as a continuous line: up the left flank, over the tip, down the right flank.
  Json x = Json::array(), y = Json::array();
  const std::vector<ProfilePoint> right = tooth_form(pair, member).profile(profile_points);
  for (const ProfilePoint& point : right) {
    x.push_back(-point.x);
    y.push_back(point.y);
  }
  for (auto point = right.rbegin(); point != right.rend(); ++point) {
    x.push_back(point->x);
    y.push_back(point->y);
  }
  json["profile"] = {{"x_mm", x}, {"y_mm", y}};
  return json;
}

Json geometry_json(const GearPair& pair) {
  return {{"centre_distance_mm", pair.centre_distance},
          {"backlash_free_centre_distance_mm", pair.backlash_free_centre_distance},
          {"backlash_um", in_um(pair.backlash)},
          {"normal_backlash_um", in_um(pair.normal_backlash())},
          {"radial_backlash_um", in_um(pair.radial_backlash())},
          {"transverse_pressure_angle_deg", in_deg(pair.transverse_pressure_angle)},
          {"working_transverse_pressure_angle_deg", in_deg(pair.working_transverse_pressure_angle)},
          {"base_helix_angle_deg", in_deg(pair.base_helix_angle)},
          {"transverse_base_pitch_mm", pair.transverse_base_pitch},
          {"transverse_contact_ratio", pair.transverse_contact_ratio},
          {"overlap_ratio", pair.overlap_ratio},
          {"total_contact_ratio", pair.total_contact_ratio()},
          {"path_of_contact_mm", {{"T1_A", pair.path_start}, {"T1_C", pair.pitch_point}, {"T1_E", pair.path_end}, {"T1_T2", pair.path_length}}},
          {"pinion", gear_json(pair, Member::Pinion)},
          {"wheel", gear_json(pair, Member::Wheel)}};
}

/// Numbers that were not computed are null, in the document as in its text.
void put_null_for_nan(Json& node) {
  if (node.is_number_float() && !std::isfinite(node.get<double>())) node = nullptr;
  if (!node.is_structured()) return;
  for (Json& child : node) put_null_for_nan(child);
}

/// Members in their order: what points have, without the copies that an initialiser list of Json makes.
Json record(std::initializer_list<std::pair<const char*, double>> members) {
  Json json = Json::object();
  auto& object = json.get_ref<Json::object_t&>();
  object.reserve(members.size() + 1);
  for (const auto& [key, value] : members) object.emplace_back(key, value);
  return json;
}

Json point_json(const MeshPosition& at, const LoadedPosition& position, Eigen::Index i) {
  const ContactPoint& point = at.points[static_cast<std::size_t>(i)];
  Json json = record({{"z_mm", point.z},
                      {"phase", point.phase},
                      {"pinion_radius_mm", point.pinion_radius},
                      {"wheel_radius_mm", point.wheel_radius},
                      {"length_mm", point.weight},
                      {"load_N_per_mm", position.load.line_load[i]},
                      {"contact_stress_MPa", position.contact_stress[i]},
                      {"contact_deflection_um", in_um(position.load.contact_deflection[i])},
                      {"structural_deflection_um", in_um(position.load.structural_deflection[i])},
                      {"gap_um", in_um(position.gap.total[i])},
                      {"error_um", in_um(position.gap.error[i])}});
  if (position.edge_stress.size() > 0) json["edge_stress_MPa"] = position.edge_stress[i];
  if (reaches_tip_edge(at, position, static_cast<std::size_t>(i))) json["tip_edge"] = name_of(point.tip_edge.gear);
  if (!position.gap.nearest.empty()) {
    const NearestPoint& nearest = position.gap.nearest[static_cast<std::size_t>(i)];
    json["nearest"] = record({{"pinion_radius_mm", nearest.pinion_radius}, {"wheel_radius_mm", nearest.wheel_radius}});
  }
  return json;
}

/// Largest over a tooth's fillet [MPa]; NaN without.
double root_stress_of_tooth(const MeshPosition& at, const LoadedPosition& position, Member member, int tooth) {
  const Eigen::Index highest = highest_root_stress(at, position, {member, tooth});
  return highest < 0 ? not_given : position.root_stress[highest];
}

/// @param life  of the load case, for film and temperatures at the points; null: not known
/// @param i     index of the position
/// @param with_points  whether the contact points are listed, see cases_with_points()
Json position_json(const MeshModel& model, const MeshPosition& at, const LoadedPosition& position, const FlankCondition& condition,
                   const CaseLife* life, std::size_t i, bool with_points) {
  const double cos_base_helix = std::cos(model.pair.base_helix_angle);
  const LoadDistribution& load = position.load;
  Json json{{"phase", position.phase},
            {"te_um", in_um(load.transmission_error)},
            {"te_base_tangent_um", in_um(load.transmission_error) / cos_base_helix},
            {"stiffness_N_per_mm_um", position.stiffness},
            {"kkt_residual", load.kkt_residual},
            {"condition", load.condition},
            {"iterations", load.iterations},
            {"message", load.message}};
  std::map<int, Json> teeth;
  if (load.usable()) {
    for (std::size_t p = 0; p < at.points.size(); ++p) {
      Json& points = teeth.try_emplace(at.points[p].tooth, Json::array()).first->second;
      const auto point = static_cast<Eigen::Index>(p);
      if (!with_points) continue;
      points.push_back(point_json(at, position, point));
      if (life == nullptr || life->flash.empty()) continue;
      points.back()["flash_temperature_K"] = life->flash[i][point];
      points.back()["specific_film_thickness"] = life->film_at_points[i][point];
    }
  }
  const std::map<int, double> shares = shares_by_tooth(at, position);
  std::map<int, Json> ends = line_ends_json(line_ends(model, at, position, condition));
  json["teeth"] = Json::array();
  for (auto& [tooth, points] : teeth) {
    Json entry{{"tooth", tooth}, {"points", nullptr}, {"line_ends", Json::array()}};
    if (ends.contains(tooth)) entry["line_ends"] = std::move(ends.at(tooth));
    entry["share"] = shares.contains(tooth) ? Json(shares.at(tooth)) : Json();
    if (position.root_stress.size() > 0) {
      entry["pinion_root_stress_MPa"] = root_stress_of_tooth(at, position, Member::Pinion, tooth);
      entry["wheel_root_stress_MPa"] = root_stress_of_tooth(at, position, Member::Wheel, tooth);
    }
    entry["points"] = std::move(points);
    json["teeth"].push_back(std::move(entry));
  }
  return json;
}

/// Null where there is no root stress.
Json root_stress_json(const RootStressPeak& peak) {
  if (std::isnan(peak.stress)) return nullptr;
  return {{"tooth", peak.station.tooth},
          {"z_mm", peak.station.z},
          {"along_fillet", peak.station.along},
          {"phase", peak.phase},
          {"at_30_deg_tangent_MPa", peak.tangent_stress}};
}

/// Every row of cycle_quantities(), and behind them the estimated discretisation errors, each in its quantity's unit; null where none was
/// estimated.
Json quantities_json(const LoadedResult& loaded, bool full_cycle) {
  Json json = Json::object(), errors = Json::object();
  for (const CycleQuantity& quantity : cycle_quantities()) {
    const auto shown = [&](const std::vector<double>& values) -> Json {
      const auto outside = [&](double value) { return value / quantity.unit_size; };
      if (quantity.is_list) return full_cycle ? list(values, outside) : Json::array();
      return outside(values.front());
    };
    json[std::string(quantity.key)] = shown(quantity.values(loaded.summary));
    if (quantity.errors != nullptr) errors[std::string(quantity.key) + "_error"] = shown(quantity.errors(loaded.resolved.errors, loaded.summary));
  }
  json.update(errors);
  json["errors_from_intervals"] = loaded.compared_intervals > 0 ? Json(loaded.compared_intervals) : Json();
  return json;
}

Json edge_contact_json(const LoadedResult& loaded) {
  const EdgeContactStart& start = *loaded.edge_contact;
  return {{"gear", name_of(start.gear)},
          {"begins_at_torque_Nm", in_Nm(start.torque)},
          {"share_of_torque", start.torque / loaded.torque},
          {"phase", start.phase}};
}

Json summary_json(const LoadedResult& loaded, const MeshModel& model, bool full_cycle) {
  const CycleSummary& summary = loaded.summary;
  Json json = quantities_json(loaded, full_cycle);
  json.update({{"te_convergence", full_cycle ? te_convergence_json(loaded.cycle) : Json()},
               {"pinion_root_stress", root_stress_json(summary.pinion_root_stress)},
               {"wheel_root_stress", root_stress_json(summary.wheel_root_stress)},
               {"worst_kkt_residual", summary.worst_kkt_residual},
               {"worst_condition", summary.worst_condition},
               {"peaks", loaded.rating ? peaks_json(*loaded.rating, model) : Json()},
               {"load_factors", loaded.rating ? load_factors_json(*loaded.rating) : Json()},
               {"edge_contact", loaded.edge_contact ? edge_contact_json(loaded) : Json()},
               {"iso6336", iso_json(model.iso, loaded.iso)}});
  return json;
}

/// Where the extremes lie that no position of the cycle has.
Json extremes_json(const LoadedResult& loaded) {
  return list(loaded.resolved.extreme_cycle.positions, [](const LoadedPosition& position) -> Json {
    return {{"phase", position.phase},
            {"te_um", in_um(position.load.transmission_error)},
            {"peak_load_N_per_mm", position.peak_load.maxCoeff()},
            {"peak_contact_stress_MPa", position.contact_stress.maxCoeff()}};
  });
}

Json loaded_json(const LoadedResult& loaded, const StudyResults& results, bool with_points) {
  const MeshModel& model = results.models[loaded.model];
  const CaseLife* life = results.life ? results.life->find(static_cast<std::size_t>(&loaded - results.loaded.data())) : nullptr;
  Json cycle = Json::array();
  for (std::size_t i = 0; i < loaded.cycle.positions.size(); ++i) {
    cycle.push_back(position_json(model, model.positions[i], loaded.cycle.positions[i], loaded.condition, life, i, with_points));
  }
  Json json{{"scene", loaded.scene},
            {"torque_Nm", in_Nm(loaded.torque)},
            {"normal_force_N", loaded.cycle.force},
            {"design", loaded.design},
            {"summary", summary_json(loaded, model, results.study.cycle.phases.empty())},
            {"cycle", nullptr},
            {"extremes", extremes_json(loaded)}};
  if (loaded.condition.other_flanks) json["working_flank"] = name_of(model.pair.data.working_flank);
  if (const double offset = loaded.condition.misalignment.axial_offset; offset != 0.0) json["axial_offset_mm"] = offset;
  if (loaded.bin >= 0) json["bin"] = loaded.bin;
  if (results.shafts) add_shaft_motion(loaded, results, json);
  if (results.structures.rim_motion) add_rim_motion(loaded, results, json);
  if (has_gradients(results) && loaded.cycle.usable()) json["gradients"] = gradients_json(loaded, results);
  json["cycle"] = std::move(cycle);
  put_null_for_nan(json);
  return json;
}

/// How the working flank of a gear differs from the involute by generation, modification and grid, as a map; nothing where it does not.
void add_topography(const GearPair& pair, Member member, const Modification& modification, const std::string& design, Json& maps) {
  const Gear& gear = pair[member];
  const Flank flank = make_flank(pair, member, modification, {});
  Json z = Json::array(), radius = Json::array(), removal_um = Json::array();
  bool modified = false;
  for (int i = 0; i < topography_sections; ++i) {
    z.push_back((static_cast<double>(i) / (topography_sections - 1) - 0.5) * gear.data.face_width);
  }
  for (int j = 0; j < topography_sections; ++j) {
    const double r = gear.active_root_radius + (gear.tip_form_radius - gear.active_root_radius) * j / (topography_sections - 1);
    radius.push_back(r);
    Json row = Json::array();
    for (const auto& position : z) {
      const double removed = flank.deviation(flank.roll_at(r), position.get<double>(), 0);
      modified = modified || removed != 0.0;
      row.push_back(in_um(removed));
    }
    removal_um.push_back(std::move(row));
  }
  if (!modified) return;
  maps.push_back({{"gear", name_of(member)},
                  {"flank", name_of(pair.data.working_flank)},
                  {"design", design},
                  {"process", to_string(modification.process.kind)},
                  {"natural_twist_um", in_um(natural_twist(pair, member, modification))},
                  {"contact_shift_mm", contact_shift_over_profile(pair, member, modification.process)},
                  {"z_mm", std::move(z)},
                  {"radius_mm", std::move(radius)},
                  {"removal_um", std::move(removal_um)}});
}

/// Of the flanks that some load case works on.
Json modifications_json(const StudyResults& results) {
  Json maps = Json::array();
  const GearPair& own = results.pair;
  const bool works_on_others = std::ranges::any_of(results.loaded, [](const LoadedResult& loaded) { return loaded.condition.other_flanks; });
  const auto add_both = [&](const PerGear<Modification>& modification, const std::string& design) {
    for (const Member m : {Member::Pinion, Member::Wheel}) add_topography(own, m, modification[m], design, maps);
    if (!works_on_others) return;
    for (const Member m : {Member::Pinion, Member::Wheel}) add_topography(own.on_other_flanks(), m, on_opposite_flank(modification[m]), design, maps);
  };
  for (const ShownDesign& design : results.designs) add_both(design.modification, design.name);
  if (results.designs.empty()) add_both(analysed_modification(results.study, results.effects), "given");
  return maps;
}

Json units_json() {
  return {
      {"length", "mm"},
      {"modification", "um"},
      {"deflection", "um"},
      {"te_um", "loaded: along the flank normal, positive: the wheel lags; unloaded: along the transverse base tangent, r_b2 (phi2 - (N1/N2) phi1)"},
      {"te_arcsec", "phi2 - (N1/N2) phi1 at the wheel, negative where material is removed"},
      {"load", "N per mm of contact line"},
      {"stress", "MPa"},
      {"stiffness", "N/(mm um), transverse"}};
}

}  // namespace

/// An object that gets another member copies those that it has, as their names are const: what is large is moved into its place in the end.
Json results_document(const StudyResults& results) {
  const Study& study = results.study;
  Json json{{"title", study.title},
            {"task", study.task->name},
            {"version", version()},
            {"file", study.file},
            {"seconds", results.seconds},
            {"units", units_json()},
            {"notes", results.notes},
            {"requirements_not_met", results.requirements},
            {"geometry", geometry_json(results.pair)}};
  if (!results.unloaded.empty()) {
    json["unloaded"] = unloaded_json(results.unloaded.front(), results.pair);
    if (results.unloaded.size() > 1) {
      json["unloaded_scenes"] = list(results.unloaded, [&](const UnloadedResult& u) { return unloaded_json(u, results.pair); });
    }
  }
  json["loaded"] = nullptr;  // the place of what comes last
  if (results.structures.finite_elements) json["compliance"] = compliance_json(results.structures, study);
  json["modifications"] = modifications_json(results);
  if (const auto drawings = drawings_of(results); !drawings.empty()) json["drawing"] = list(drawings, drawing_json);
  json["effects"] = effects_json(results);
  json["steps"] = list(results.steps, [](const RunStep& s) -> Json { return {{"name", s.name}, {"why", s.why}, {"seconds", s.seconds}}; });
  if (results.fidelity_choice) json["accuracy_choice"] = fidelity_choice_json(*results.fidelity_choice);
  if (study.task->add_json != nullptr) study.task->add_json(results, json);
  if (results.life) json["life"] = life_json(results);
  if (!results.deflections.empty()) json["deflections"] = list(results.deflections, deflections_json);
  json["given"] = list(study.given, [](const GivenValue& g) -> Json { return {{"key", g.key}, {"value", g.value}, {"unit", unit_of_given(g)}}; });
  json["used"] = used_json(results);
  json["study"] = study.text;
  put_null_for_nan(json);
  json["loaded"] = Json(Json::array_t(results.loaded.size()));
  auto& loaded = json["loaded"].get_ref<Json::array_t&>();
  const std::vector<bool> with_points = cases_with_points(results);
  tbb::parallel_for(std::size_t{0}, loaded.size(), [&](std::size_t i) { loaded[i] = loaded_json(results.loaded[i], results, with_points[i]); });
  return json;
}

std::string json_text(const Json& document) {
  // A file name need not be UTF-8, JSON must be: what is not becomes the replacement character.
  const auto text_of = [](const Json& node) { return node.dump(-1, ' ', false, Json::error_handler_t::replace); };
  if (!document.is_object()) return text_of(document) + "\n";
  // Load cases are nearly all of it, and are written side by side.
  std::vector<std::string> parts;
  for (const auto& [key, section] : document.items()) {
    parts.push_back(fmt::format("{}{}:", parts.empty() ? '{' : ',', text_of(key)));
    if (!section.is_array() || section.empty()) {
      parts.push_back(text_of(section));
      continue;
    }
    const std::size_t first = parts.size();
    parts.resize(first + section.size());
    tbb::parallel_for(std::size_t{0}, section.size(),
                      [&](std::size_t i) { parts[first + i] = text_of(section[i]).insert(0, 1, i == 0 ? '[' : ','); });
    parts.push_back("]");
  }
  parts.push_back(parts.empty() ? "{}\n" : "}\n");
  std::size_t length = 0;
  for (const std::string& part : parts) length += part.size();
  std::string text;
  text.reserve(length);
  for (const std::string& part : parts) text += part;
  return text;
}

std::string results_json(const StudyResults& results) { return json_text(results_document(results)); }

}  // namespace flankwright::studies
