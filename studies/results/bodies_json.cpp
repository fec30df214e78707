#include "studies/results/bodies_json.hpp"
#include "studies/analysis/rims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace flankwright::studies {

namespace {

constexpr double milliradian = 1e-3;

/// The names of a rim's motion in results.json and their values in outside units.
std::array<std::pair<const char*, double>, 5> named(const RimMotion& motion) {
  return {{{"radial_um", in_um(motion.radial)},
           {"axial_um", in_um(motion.axial)},
           {"tilt_mrad", motion.tilt / milliradian},
           {"misalignment_um", in_um(motion.misalignment)},
           {"misalignment_at_teeth_um", in_um(motion.misalignment_at_teeth)}}};
}

Json web_json(const WebbedBody& web) {
  Json json{{"rim_thickness_mm", web.rim_thickness},
            {"web_thickness_mm", web.web_thickness},
            {"web_offset_mm", web.web_offset},
            {"hub_diameter_mm", web.hub_diameter},
            {"hub_width_mm", web.hub_width}};
  if (web.holes.count > 0) {
    json["holes"] = {{"count", web.holes.count},
                     {"diameter_mm", web.holes.diameter},
                     {"circle_diameter_mm", web.holes.circle_diameter},
                     {"stiffness", hole_stiffness(web.holes)}};
  }
  return json;
}

/// Mean over the positions, and the largest in size.
Json over_positions(const std::vector<RimMotion>& motions) {
  Json json = Json::object();
  const std::size_t figures = named({}).size();
  for (std::size_t i = 0; i < figures; ++i) {
    double sum = 0.0, largest = 0.0;
    for (const RimMotion& motion : motions) {
      const double value = named(motion)[i].second;
      sum += value;
      if (std::abs(value) > std::abs(largest)) largest = value;
    }
    json[named({})[i].first] = {{"mean", sum / static_cast<double>(motions.size())}, {"largest", largest}};
  }
  return json;
}

/// One gear's rim at the positions of a load case; fewer than there are where one has no load distribution.
std::vector<RimMotion> rim_motions(const LoadedResult& loaded, const StudyResults& results, Member member) {
  const MeshModel& model = results.models[loaded.model];
  const PairRimMotion& rims = *rims_of(results, model);
  std::vector<RimMotion> motions;
  for (std::size_t i = 0; i < loaded.cycle.positions.size(); ++i) {
    const MeshPosition& at = model.positions[i];
    const LoadDistribution& load = loaded.cycle.positions[i].load;
    if (load.usable()) motions.push_back(rims.motion(member, at.points, at.weight.cwiseProduct(load.line_load), model.axial_offset));
  }
  return motions;
}

}  // namespace

Json body_json(const GearBody& body) {
  Json json;
  if (body.hold == BodyHold::RigidBore) {
    json = {{"hold", to_string(body.hold)}, {"bore_diameter_mm", body.bore_diameter}};
  } else {
    json = {{"shaft_diameter_mm", body.shaft_diameter},
            {"bore_diameter_mm", body.bore_diameter},
            {"shaft_overhang_mm", body.shaft_overhang},
            {"torque_end", body.torque_end == FaceEnd::Obtuse ? "blunt" : "sharp"}};
  }
  if (body.web) json["web"] = web_json(*body.web);
  return json;
}

std::string rim_table(const StudyResults& results, std::size_t width) {
  if (!results.structures.rim_motion || results.loaded.empty()) return {};
  std::string out =
      fmt::format("{:<{}}  {:>10}  {:>8}  {:>10}  {:>10}  {:>10}  {:>10}  {:>10}\n", "rims on webs", width, "torque", "gear", "radial", "axial",
                  "tilt", "opens at +z", "at teeth") +
      fmt::format("{:<{}}  {:>10}  {:>8}  {:>10}  {:>10}  {:>10}  {:>10}  {:>10}\n", "", width, "N·m", "", "um", "um", "mrad", "um", "um");
  for (const LoadedResult& loaded : results.loaded) {
    for (const Member member : {Member::Pinion, Member::Wheel}) {
      if (!results.structures.rim_motion->has_rim(member)) continue;
      const Json means = over_positions(rim_motions(loaded, results, member));
      out += fmt::format("{:<{}}  {:>10}  {:>8}", loaded.scene, width, fmt::format("{:.6g}", in_Nm(loaded.torque)), name_of(member));
      for (const auto& [name, value] : named({})) out += fmt::format("  {:>10.4g}", means.at(name).at("mean").get<double>());
      out += "\n";
    }
  }
  return out;
}

void add_rim_motion(const LoadedResult& loaded, const StudyResults& results, Json& json) {
  const MeshModel& model = results.models[loaded.model];
  const PairRimMotion& rims = *rims_of(results, model);
  const auto is_usable = [](const LoadedPosition& position) { return position.load.usable(); };
  json["rims"] = Json::array();
  for (std::size_t i = 0; i < loaded.cycle.positions.size(); ++i) {
    json["rims"].push_back(is_usable(loaded.cycle.positions[i]) ? Json{{"phase", model.positions[i].phase}} : Json());
  }
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const char* gear = name_of(member);
    std::vector<RimMotion> motions;
    if (rims.has_rim(member)) motions = rim_motions(loaded, results, member);
    auto motion = motions.begin();
    for (Json& entry : json["rims"]) {
      if (entry.is_null()) continue;
      Json& of_gear = entry[gear] = nullptr;
      if (motion == motions.end()) continue;
      of_gear = Json::object();
      for (const auto& [name, value] : named(*motion)) of_gear[name] = value;
      ++motion;
    }
    const bool is_whole = !motions.empty() && motions.size() == loaded.cycle.positions.size();
    json["summary"]["rims"][gear] = is_whole ? over_positions(motions) : Json();
  }
}

}  // namespace flankwright::studies
