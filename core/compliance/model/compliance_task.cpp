#include "core/compliance/model/compliance_task.hpp"

#include <algorithm>
#include <cmath>

#include "core/compliance/fitted/correction_fit.hpp"
#include "core/compliance/fitted/correction_library.hpp"
#include "core/compliance/pair/pair_compliance.hpp"

namespace flankwright {

InfluenceTableTask influence_table_task(const ComplianceTask& task, Member member) {
  const bool pinion = member == Member::Pinion;
  const GearPair& pair = task.pair;
  const Gear& gear = pair[member];
  InfluenceTableTask run{.gear = {as_generated(gear.data, pair.data.normal_module, pair.data.pressure_angle),
                                  pair.data.normal_module,
                                  pair.data.pressure_angle,
                                  pair.data.helix_angle,
                                  {}},
                         .poissons_ratio = (pinion ? task.material.pinion : task.material.wheel).poissons_ratio,
                         .teeth_apart = std::max(2, teeth_apart_in_contact(pair)),
                         .grid = station_grid(gear.data.face_width / pair.data.normal_module),
                         .root_stress = task.root_stress,
                         .neighbour_grid = neighbour_grid(gear.data.face_width / pair.data.normal_module)};
  run.gear.gear.tip_diameter = 2 * gear.tip_radius;
  if (2 * run.teeth_apart + 1 > gear.data.teeth) {
    throw InvalidInput("fidelity.compliance", to_string(task.model),
                       "another compliance: teeth " + std::to_string(run.teeth_apart) + " pitches apart touch at once, too many for the " +
                           name_of(member) + "'s " + std::to_string(gear.data.teeth));
  }
  if (task.model == ComplianceModel::Fitted) run.mesh = coarse_mesh();
  with_gear_names(task.model, member, [&] {
    const ToothForm form(run.gear.gear, run.gear.normal_module, run.gear.pressure_angle, run.gear.helix_angle);
    run.gear.body = complete_body(pinion ? task.body.pinion : task.body.wheel, form, run.gear.normal_module, gear.data.face_width);
    if (run.gear.body.web) run.gear.body.web->web_offset = 0.0 - pair.acute_end(member) * run.gear.body.web->web_offset;  // GearToMesh's frame
    // The gear's torsion starts where the torque leaves it, and the shaft's own bearings hold it axially.
    if (const std::optional<ShaftData>& shaft = pinion ? task.shaft.pinion : task.shaft.wheel) {
      run.removed = RemovedRigidMotion::WholeTranslationTorsionAndTilt;
      run.gear.body.torque_end = shaft->torque_side() == pair.acute_end(member) ? FaceEnd::Acute : FaceEnd::Obtuse;
    }
    if (run.gear.body.hold == BodyHold::RigidBore) {
      run.removed = RemovedRigidMotion::None;
      run.gear.body.torque_end = FaceEnd::Obtuse;  // the bore carries all
    }
    GearMeshOptions options = run.mesh;
    options.teeth_each_side = run.teeth_apart;
    section_radii(form, gear.data.teeth, run.gear.normal_module, gear.data.face_width, run.gear.body, options);  // only for what it refuses
  });
  return run;
}

std::optional<ComplianceTask> task_of_other_flanks(const ComplianceTask& task) {
  if (!task.other_flanks) return std::nullopt;
  ComplianceTask there = task;
  there.pair = task.pair.on_other_flanks();
  there.other_flanks = false;
  const auto alike = [&](Member member) { return influence_table_task(task, member).gear.body == influence_table_task(there, member).gear.body; };
  if (alike(Member::Pinion) && alike(Member::Wheel)) return std::nullopt;
  return there;
}

std::string unknown_to_library(const ComplianceTask& task, const InfluenceTableTask& gear) {
  return task.model == ComplianceModel::Fitted ? CorrectionLibrary::shipped().unknown(gear.gear, gear.poissons_ratio) : "";
}

std::vector<std::string> library_notes(const ComplianceTask& task) {
  std::vector<std::string> notes;
  if (task.model != ComplianceModel::Fitted) return notes;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const InfluenceTableTask gear = influence_table_task(task, member);
    const std::string unknown = unknown_to_library(task, gear);
    if (unknown.empty()) continue;
    const bool own_run = !alike_but_for_size(task_of_fit(gear), gear);
    notes.push_back(std::string("the ") + name_of(member) + " is outside the library of fits (" + unknown + "): its first run takes " +
                    (own_run ? "three" : "two") + " finite-element models instead of one, and a fit of its own");
  }
  return notes;
}

std::vector<std::string> thin_shaft_notes(const ComplianceTask& task) {
  constexpr double thin = 0.25;  // shaft_diameter < thin * d
  std::vector<std::string> notes;
  if (!couples_teeth(task.model)) return notes;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const GearBody& given = task.body[member];
    if (given.hold != BodyHold::Shaft || !std::isnan(given.shaft_diameter)) continue;
    const GearToMesh gear = influence_table_task(task, member).gear;
    const double reference = 2.0 * ToothForm(gear.gear, gear.normal_module, gear.pressure_angle, gear.helix_angle).reference_radius();
    if (gear.body.shaft_diameter >= thin * reference) continue;
    const std::string name = name_of(member);
    const auto whole = [](double length) { return std::to_string(std::lround(length)) + " mm"; };
    notes.push_back("the " + name + " of " + whole(reference) + " is taken as one with a shaft of " + whole(gear.body.shaft_diameter) +
                    ", the default of 25 modules: mean transmission error and mesh stiffness have the yield of this body in them; " + name +
                    ".body.shaft_diameter sets another");
  }
  return notes;
}

InfluenceTableTask task_of_fit(InfluenceTableTask coarse) {
  const bool is_own_body = !coarse.gear.body.web && coarse.gear.body.hold == BodyHold::Shaft;
  if (!is_own_body) {  // the kernels are the tooth's, whatever is below it
    const GearToMesh& gear = coarse.gear;
    coarse.gear.body =
        complete_body({}, ToothForm(gear.gear, gear.normal_module, gear.pressure_angle, gear.helix_angle), gear.normal_module, gear.gear.face_width);
    coarse.removed = RemovedRigidMotion::TranslationTorsionAndTilt;
    coarse.root_stress = false;
  }
  if (coarse.grid.face_width() <= widest_own_fit) return coarse;
  coarse.gear.gear.face_width = widest_own_fit * coarse.gear.normal_module;
  coarse.grid = station_grid(widest_own_fit);
  coarse.neighbour_grid = neighbour_grid(widest_own_fit);
  coarse.root_stress = false;
  return coarse;
}

}  // namespace flankwright
