#include "studies/study_file/study_shafts.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "core/compliance/shaft/unit_checks.hpp"
#include "core/compliance/shaft/unit_statics.hpp"

namespace flankwright::studies {

namespace {

bool is_axial(const ShaftBearing& bearing) { return bearing.holds()[2]; }

/// @param joined  a bearing between shafts holds it axially
void complete(ShaftData& shaft, const Material& of_gear, bool joined) {
  if (std::isnan(shaft.material.youngs_modulus)) shaft.material.youngs_modulus = of_gear.youngs_modulus;
  if (std::isnan(shaft.material.poissons_ratio)) shaft.material.poissons_ratio = of_gear.poissons_ratio;
  if (joined || std::ranges::any_of(shaft.bearings, is_axial)) return;
  const auto first = std::ranges::find_if_not(shaft.bearings, &ShaftBearing::has_matrix);  // a matrix says all of its bearing
  if (first != shaft.bearings.end()) first->axial_stiffness = std::numeric_limits<double>::infinity();
}

void refuse(StudyReading& reading, const std::string& key, const InvalidInput& problem) {
  reading.refuse_value(key, problem.value(), "allowed is " + problem.allowed());
}

void read_shaft(StudyReading& reading, Member member) {
  Study& study = reading.builder.study;
  const bool pinion = member == Member::Pinion;
  std::optional<ShaftData>& shaft = pinion ? study.shaft.pinion : study.shaft.wheel;
  if (!shaft) return;
  const std::string table = pinion ? "pinion.shaft" : "wheel.shaft";
  const bool has_problem = std::ranges::any_of(reading.problems, [&](const StudyProblem& problem) { return problem.key.starts_with(table); });
  if (has_problem) return;  // what could not be read is missing below
  for (const InvalidInput& problem : find_problems(*shaft, study.pair[member].face_width)) refuse(reading, table + "." + problem.field(), problem);
}

/// No section is thicker than the gear that sits on it by more than a module. Drawings of pinions in one piece with their shaft have round diameters.
void check_sections(StudyReading& reading, Member member) {
  const Study& study = reading.builder.study;
  if (!study.shaft[member] || !reading.problems.empty() || !find_problems(study.pair).empty()) return;
  const ShaftData& shaft = *study.shaft[member];
  const double thickest = 2.0 * make_gear_pair(study.pair)[member].tip_radius + study.pair.normal_module, half = 0.5 * study.pair[member].face_width;
  double begin = 0.0;
  for (std::size_t k = 0; k < shaft.sections.size(); ++k) {
    const double end = begin + shaft.sections[k].length, diameter = shaft.sections[k].outer_diameter;
    const bool is_under = std::max(begin, shaft.gear_position - half) < std::min(end, shaft.gear_position + half);
    if (is_under && diameter > thickest) {
      const std::string key = std::string(name_of(member)) + ".shaft.sections." + std::to_string(k) + ".outer_diameter";
      refuse(
          reading, key,
          {key, in_words(diameter), "at most " + in_words(thickest) + " mm, a module more than the tip diameter of the gear that it runs through"});
    }
    begin = end;
  }
}

/// The keys of [unit] and what they say together with both shafts; where all else could be read.
void read_unit(StudyReading& reading) {
  Study& study = reading.builder.study;
  UnitData& unit = study.unit;
  if (const double largest = std::ranges::max(study.torques); std::isnan(unit.reference_torque) && largest > 0.0) unit.reference_torque = largest;
  if (!reading.problems.empty() || !find_problems(study.pair).empty()) return;
  if (!study.shaft.pinion && !study.shaft.wheel) {
    return reading.refuse(reading.where("unit"), "unit", nullptr,
                          "a unit needs a shaft of the pair: allowed is [pinion.shaft] or [wheel.shaft] as well");
  }
  ShaftsOfPair all{study.shaft, unit};
  const std::vector<InvalidInput> problems = find_problems(all, make_gear_pair(study.pair));
  for (const InvalidInput& problem : problems) refuse(reading, problem.field(), problem);
  if (!problems.empty()) return;
  settle_turning_holds(all, make_gear_pair(study.pair));
  study.shaft = all.shaft;
}

/// How often a revolution loads the teeth of the pair's gears, where the study does not say: as often as the unit's meshes do.
void settle_meshes_per_revolution(StudyReading& reading) {
  Study& study = reading.builder.study;
  const bool has_unit = reading.problems.empty() && find_problems(study.pair).empty() && !study.unit.meshes.empty();
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    int& meshes = study.life.meshes_per_revolution[m];
    if (meshes > 0) continue;
    meshes = has_unit ? meshes_per_revolution({study.shaft, study.unit}, make_gear_pair(study.pair), m) : 1;
  }
}

/// Bearings whose stiffness depends on the load have an equilibrium under each torque, and hold their shafts there.
void check_equilibria(StudyReading& reading) {
  const Study& study = reading.builder.study;
  if (!reading.problems.empty() || !find_problems(study.pair).empty()) return;
  const std::shared_ptr<const ShaftPair> shafts = make_shafts(study, make_gear_pair(study.pair));
  if (!shafts || !shafts->depends_on_load()) return;
  std::set<std::pair<bool, double>> cases;  // on the other flanks, torque
  for (const Scene& scene : study.scenes) {
    for (const double torque : scene.torques) cases.emplace(loads_other_flanks(study, scene), torque);
  }
  for (const auto& [on_other_flanks, torque] : cases) {
    if (!(torque > 0.0)) continue;
    try {
      on_other_flanks ? shafts->reversed().at_torque(torque) : shafts->at_torque(torque);
    } catch (const InvalidInput& problem) {
      return refuse(reading, study.spectrum.empty() ? problem.field() : "load.spectrum", problem);
    }
  }
}

}  // namespace

void read_shafts(StudyReading& reading) {
  Study& study = reading.builder.study;
  const auto joined = [&](const std::string& name) {
    return std::ranges::any_of(
        study.unit.joints, [&](const ShaftJoint& joint) { return (joint.shaft == name || joint.outer_shaft == name) && is_axial(joint.bearing); });
  };
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    if (study.shaft[m]) complete(*study.shaft[m], study.material[m], joined(name_of(m)));
  }
  for (ShaftData& shaft : study.unit.shafts) complete(shaft, study.material.pinion, joined(shaft.name));
  if (study.unit.empty() && reading.find("unit.housing.stiffness") == nullptr) {
    read_shaft(reading, Member::Pinion);
    read_shaft(reading, Member::Wheel);
  } else {
    read_unit(reading);
  }
  for (const Member m : {Member::Pinion, Member::Wheel}) check_sections(reading, m);
  settle_meshes_per_revolution(reading);
  check_equilibria(reading);
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
  return std::make_shared<const ShaftPair>(pair, ShaftsOfPair{study.shaft, study.unit},
                                           PerGear<GearBodyIn>{body_in(Member::Pinion), body_in(Member::Wheel)});
}

}  // namespace flankwright::studies
