#include "studies/study_file/study_shafts.hpp"

#include <algorithm>
#include <limits>

namespace flankwright::studies {

namespace {

void complete(ShaftData& shaft, const Material& of_gear) {
  if (std::isnan(shaft.material.youngs_modulus)) shaft.material.youngs_modulus = of_gear.youngs_modulus;
  if (std::isnan(shaft.material.poissons_ratio)) shaft.material.poissons_ratio = of_gear.poissons_ratio;
  const auto is_axial = [](const ShaftBearing& bearing) { return bearing.axial_stiffness > 0.0; };
  if (!shaft.bearings.empty() && std::ranges::none_of(shaft.bearings, is_axial)) {
    shaft.bearings.front().axial_stiffness = std::numeric_limits<double>::infinity();
  }
}

void read_shaft(StudyReading& reading, Member member) {
  Study& study = reading.builder.study;
  const bool pinion = member == Member::Pinion;
  std::optional<ShaftData>& shaft = pinion ? study.shaft.pinion : study.shaft.wheel;
  if (!shaft) return;
  complete(*shaft, pinion ? study.material.pinion : study.material.wheel);
  const std::string table = pinion ? "pinion.shaft" : "wheel.shaft";
  const bool has_problem = std::ranges::any_of(reading.problems, [&](const StudyProblem& problem) { return problem.key.starts_with(table); });
  if (has_problem) return;  // what could not be read is missing below
  for (const InvalidInput& problem : find_problems(*shaft, study.pair[member].face_width)) {
    const std::string key = table + "." + problem.field();
    const Position at = reading.where(key);
    reading.problems.push_back({at.file, at.line, at.column, key, problem.value(), "allowed is " + problem.allowed()});
  }
}

}  // namespace

void read_shafts(StudyReading& reading) {
  read_shaft(reading, Member::Pinion);
  read_shaft(reading, Member::Wheel);
  const Study& study = reading.builder.study;
  const bool listed = std::ranges::find(study.fidelity.effects, "shafts") != study.fidelity.effects.end();
  if (!listed || study.shaft.pinion || study.shaft.wheel) return;
  const Match* match = reading.find("fidelity.effects");
  reading.refuse(reading.where("fidelity.effects"), "fidelity.effects", match == nullptr ? nullptr : match->node,
                 "\"shafts\" needs a shaft: allowed is a list without it, or [pinion.shaft] or [wheel.shaft] as well");
}

std::shared_ptr<const ShaftPair> make_shafts(const Study& study, const GearPair& pair) {
  if (!study.shaft.pinion && !study.shaft.wheel) return nullptr;
  const auto body_in = [&](Member member) {
    if (!couples_teeth(study.fidelity.compliance)) return GearBodyIn::Shaft;
    return study.body[member].hold == BodyHold::RigidBore ? GearBodyIn::RigidBore : GearBodyIn::Structure;
  };
  return std::make_shared<const ShaftPair>(pair, study.shaft.pinion, study.shaft.wheel,
                                           PerGear<GearBodyIn>{body_in(Member::Pinion), body_in(Member::Wheel)});
}

}  // namespace flankwright::studies
