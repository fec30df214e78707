#include "studies/results/bodies_json.hpp"

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

void add_rim_motion(const LoadedResult& loaded, const StudyResults& results, Json& json) {
  const PairRimMotion& rims = *results.structures.rim_motion;
  const MeshModel& model = results.models[loaded.model];
  PerGear<std::vector<RimMotion>> of_positions;
  bool all_usable = true;
  json["rims"] = Json::array();
  for (std::size_t i = 0; i < loaded.cycle.positions.size(); ++i) {
    const MeshPosition& at = model.positions[i];
    const LoadDistribution& load = loaded.cycle.positions[i].load;
    if (!load.usable()) {
      json["rims"].push_back(nullptr);
      all_usable = false;
      continue;
    }
    const Eigen::VectorXd forces = at.weight.cwiseProduct(load.line_load);
    Json entry{{"phase", at.phase}};
    for (const Member member : {Member::Pinion, Member::Wheel}) {
      Json& of_gear = entry[name_of(member)] = nullptr;
      if (!rims.has_rim(member)) continue;
      const RimMotion motion = rims.motion(member, at.points, forces, model.axial_offset);
      of_gear = Json::object();
      for (const auto& [name, value] : named(motion)) of_gear[name] = value;
      of_positions[member].push_back(motion);
    }
    json["rims"].push_back(std::move(entry));
  }
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    Json& of_gear = json["summary"]["rims"][name_of(member)] = nullptr;
    if (rims.has_rim(member) && all_usable) of_gear = over_positions(of_positions[member]);
  }
}

}  // namespace flankwright::studies
