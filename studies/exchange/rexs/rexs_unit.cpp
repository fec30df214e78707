#include "studies/exchange/rexs/rexs_unit.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/base/units.hpp"
#include "core/compliance/shaft/unit_checks.hpp"
#include "core/compliance/shaft/unit_statics.hpp"
#include "studies/study/study_errors.hpp"

namespace flankwright::studies::rexs {

namespace {

using Eigen::Vector3d;

class UnitReading {
 public:
  UnitReading(Reading& reading, const StageParts& parts, const GearPair& pair, const ImportedTorque& reference)
      : reading_(reading), parts_(parts), pair_(pair), reference_(reference), condition_(reading, reference.load_case) {
    const std::array<double, 3> u = u_axis(reading, *parts.gears[0].gear);
    z_ = Vector3d(u[0], u[1], u[2]).normalized();
  }

  ImportedUnit read() {
    read_shafts();
    find_frame();
    if (reference_.torque > 0.0) result_.shafts.unit.reference_torque = reference_.torque;
    if (!reference_.name.empty()) result_.reference_remark = "of " + reference_.name;
    for (const auto& [id, shaft] : shafts_) read_loads(*reading_.model().find(id));
    for (const Relation& relation : reading_.model().relations) {
      if (relation.type == "stage") add_mesh(relation);
    }
    for (const auto& [id, shaft] : shafts_) read_joints(id);
    settle_bearings();
    settle_torques();
    const std::vector<InvalidInput> problems = find_problems(completed(), pair_);
    if (!problems.empty()) {
      throw LeftOut{fmt::format("{} = {}: allowed is {}", problems.front().field(), problems.front().value(), problems.front().allowed())};
    }
    for (const std::string& note : notes_) reading_.warn(note);
    return std::move(result_);
  }

 private:
  std::string name_of_shaft(int id) const {
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      if (parts_[m].shaft->id == id) return flankwright::name_of(m);
    }
    return "shaft " + std::to_string(id);
  }

  Vector3d vector(const Component& of, const char* attribute, const Vector3d& fallback) {
    const auto found = reading_.numbers(&of, attribute, Dimension::Length);
    return found && found->size() == 3 ? Vector3d((*found)[0], (*found)[1], (*found)[2]) : fallback;
  }

  void read_shafts() {
    for (const Component& component : reading_.model().components) {
      if (component.type != "shaft") continue;
      const std::array<double, 3> u = u_axis(reading_, component);
      const double along = Vector3d(u[0], u[1], u[2]).normalized().dot(z_);
      constexpr double parallel = 1e-6;  // 1 - |cos| at most: 0.08 deg
      if (1.0 - std::abs(along) > parallel) throw LeftOut{Reading::name_of(component) + " is not parallel to the stage's"};
      shafts_.emplace(component.id, read_bare_shaft(reading_, component, along < 0.0, notes_));
    }
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      const BareShaft& bare = shafts_.at(parts_[m].shaft->id);
      const auto place = reading_.number(parts_[m].gear, "u_coordinate_on_shaft", Dimension::Length);
      if (!place) throw LeftOut{Reading::name_of(*parts_[m].gear) + " has no u_coordinate_on_shaft"};
      result_.shafts.shaft[m] = bare.data;
      result_.shafts.shaft[m]->gear_position = bare.place(place->value);
      result_.remarks[m] = bare.remarks;
      result_.remarks[m]["gear_position"] = place->source + ", taken as mid face";
    }
    for (const auto& [id, bare] : shafts_) {
      if (id == parts_[Member::Pinion].shaft->id || id == parts_[Member::Wheel].shaft->id) continue;
      ShaftData& further = result_.shafts.unit.shafts.emplace_back(bare.data);
      further.name = name_of_shaft(id);
      result_.shaft_remarks.push_back(Reading::name_of(*reading_.model().find(id)));
    }
  }

  ShaftData& data_of(int id) {
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      if (parts_[m].shaft->id == id) return *result_.shafts.shaft[m];
    }
    return *std::ranges::find(result_.shafts.unit.shafts, name_of_shaft(id), &ShaftData::name);
  }

  /// A point of a shaft's axis.
  Vector3d axis_of(int id) {
    const Component& shaft = *reading_.model().find(id);
    const Vector3d place = vector(shaft, "support_vector", Vector3d::Constant(not_given));
    if (!place.allFinite()) throw LeftOut{Reading::name_of(shaft) + " has no support_vector"};
    return place;
  }
  Vector3d across(int from, int to) {
    const Vector3d apart = axis_of(to) - axis_of(from);
    return apart - apart.dot(z_) * z_;
  }

  /// x from pinion to wheel.
  void find_frame() {
    const Vector3d apart = across(parts_[Member::Pinion].shaft->id, parts_[Member::Wheel].shaft->id);
    if (!(apart.norm() > 0.0)) throw LeftOut{"both shafts of the stage lie on one axis"};
    x_ = apart.normalized();
    y_ = z_.cross(x_);
  }
  Vector3d in_frame(const Vector3d& v) const { return {v.dot(x_), v.dot(y_), v.dot(z_)}; }

  /// In the reference condition; 0 where the file does not say.
  double value(const Component& component, std::string_view id, Dimension dimension) {
    const auto taken = condition_.number(&component, id, dimension);
    return taken ? taken->value : 0.0;
  }

  void read_loads(const Component& shaft) {
    const BareShaft& bare = shafts_.at(shaft.id);
    const Vector3d u = bare.against_z ? Vector3d(-z_) : z_;
    const Vector3d w = vector(shaft, "w_axis_vector", Vector3d::UnitZ()).normalized(), v = w.cross(u);
    for (const Component* load : reading_.related(shaft, {"external_load"})) {
      const auto place = reading_.number(load, "u_coordinate_on_shaft", Dimension::Length);
      if (!place) throw LeftOut{Reading::name_of(*load) + " has no u_coordinate_on_shaft"};
      if (carries_torque(reading_, *load, shaft)) {
        ShaftData& on = data_of(shaft.id);
        if (!std::isnan(on.torque_position)) throw LeftOut{Reading::name_of(shaft) + ": its torque enters at several places"};
        on.torque_position = bare.place(place->value);
        for (const Member m : {Member::Pinion, Member::Wheel}) {
          if (parts_[m].shaft->id == shaft.id) result_.remarks[m]["torque_position"] = Reading::name_of(*load);
        }
      }
      const Vector3d force = value(*load, "force_u_direction", Dimension::Force) * u + value(*load, "force_v_direction", Dimension::Force) * v +
                             value(*load, "force_w_direction", Dimension::Force) * w;
      const Vector3d moment =
          value(*load, "torque_around_v_axis", Dimension::Torque) * v + value(*load, "torque_around_w_axis", Dimension::Torque) * w;
      if (force.isZero() && moment.isZero()) continue;
      if (!(reference_.torque > 0.0)) {
        notes_.push_back(Reading::name_of(*load) + ": its forces are not taken, as the file has no torque that they belong to");
        continue;
      }
      result_.shafts.unit.loads.push_back({name_of_shaft(shaft.id), bare.place(place->value), in_frame(force), in_frame(moment)});
      result_.load_remarks.push_back(Reading::name_of(*load));
      if (reading_.model().load_cases.size() > 1) {
        notes_.push_back("forces of external loads are those of " + reference_.name +
                         "; with the torque of the other cases they scale, whatever the file has there");
      }
    }
  }

  /// The parts of another stage; what is wrong with its gears is a reason to leave the unit out.
  StageParts parts_of_other(const Relation& relation, const std::string& name) {
    const bool is_cylindrical = reading_.in_role(relation, "stage").type == "cylindrical_stage" && relation.role("gear_1") && relation.role("gear_2");
    if (!is_cylindrical) throw LeftOut{name + " also loads its shafts, and only external cylindrical stages are known"};
    StageParts parts = parts_of(reading_, relation);
    for (const GearParts& gear : parts.gears) {
      if (gear.shaft == nullptr || !shafts_.contains(gear.shaft->id)) throw LeftOut{Reading::name_of(*gear.gear) + " is on no shaft of the unit"};
    }
    return parts;
  }

  void add_mesh(const Relation& relation) {
    const auto id = relation.role("stage");
    if (!id || *id == parts_.stage->id) return;
    const std::string name = Reading::name_of(reading_.in_role(relation, "stage"));
    try {
      StageParts parts = parts_of_other(relation, name);
      const ImportedTorque torque = read_torque(condition_, parts);
      take_flank(reading_, parts, torque.flank, torque.flank_source);
      add_mesh(parts, read_mesh(reading_, parts));
      add_torque(parts, torque);
    } catch (const StudyErrors& errors) {
      throw LeftOut{errors.what()};
    }
  }

  void add_mesh(const StageParts& parts, const ImportedMesh& from) {
    UnitMesh mesh;
    mesh.name = Reading::name_of(*parts.stage);
    mesh.normal_module = from.normal_module;
    mesh.pressure_angle = from.pressure_angle;
    mesh.helix_angle = from.helix_angle;
    mesh.hand = from.pinion_hand;
    mesh.centre_distance = from.centre_distance;
    for (std::size_t g = 0; g < 2; ++g) {
      const GearParts& gear = parts.gears[g];
      const auto place = reading_.number(gear.gear, "u_coordinate_on_shaft", Dimension::Length);
      if (!place) throw LeftOut{Reading::name_of(*gear.gear) + " has no u_coordinate_on_shaft"};
      const auto width = reading_.number(gear.gear, "face_width", Dimension::Length);
      mesh.gears[g] = {name_of_shaft(gear.shaft->id), shafts_.at(gear.shaft->id).place(place->value), parts.teeth[g], width ? width->value : 0.0};
    }
    const Vector3d apart = in_frame(across(parts.gears[0].shaft->id, parts.gears[1].shaft->id));
    mesh.angle = std::atan2(apart.y(), apart.x());
    result_.shafts.unit.meshes.push_back(mesh);
    result_.mesh_remarks.push_back(from.remarks);
  }

  /// About z, as the flank of the pair under study has it: programs write external loads with either sign, and the flank counts.
  void add_torque(const StageParts& parts, const ImportedTorque& torque) {
    const auto sense_of = [](WorkingFlank flank) { return flank == WorkingFlank::Right ? 1 : -1; };
    const bool turned = runs_against(u_axis(reading_, *parts_.gears[0].gear), u_axis(reading_, *parts.gears[0].gear));
    const int sense =
        torque.flank_origin == FlankOrigin::Loads && reference_.signs.loads != 0 ? sense_of(reference_.flank) * reference_.signs.loads : 1;
    const bool is_known = reference_.torque > 0.0 && torque.torque > 0.0 && torque.flank_origin != FlankOrigin::Assumed;
    known_torques_.push_back(is_known ? (turned ? -1 : 1) * sense * sense_of(torque.flank) * torque.torque : not_given);
    result_.mesh_remarks.back()["torque_1"] = torque.source;
  }

  bool are_torques_settled() { return torque_balance(completed(), pair_).determined; }

  /// Torques of meshes where the balance of the shafts leaves them open, and only there: from others it follows.
  void settle_torques() {
    if (are_torques_settled()) return;
    std::vector<UnitMesh>& meshes = result_.shafts.unit.meshes;
    for (std::size_t i = 0; i < meshes.size(); ++i) meshes[i].torque = known_torques_[i];
    for (UnitMesh& mesh : meshes) {
      const double given = std::exchange(mesh.torque, not_given);
      if (are_torques_settled()) continue;
      mesh.torque = given;
      if (!std::isnan(given) && reading_.model().load_cases.size() > 1) {
        notes_.push_back("the torque of " + mesh.name + " is that of " + reference_.name +
                         "; with the torque of the other cases it scales, whatever the file has there");
      }
    }
  }

  void read_joints(int id) {
    for (const BareJoint& inner : shafts_.at(id).joints) {
      if (!inner.is_inner) continue;
      if (!shafts_.contains(inner.mate->id)) throw LeftOut{Reading::name_of(*inner.mate) + " is no shaft of the unit"};
      const std::vector<BareJoint>& there = shafts_.at(inner.mate->id).joints;
      const auto outer = std::ranges::find(there, inner.bearing, &BareJoint::bearing);
      if (outer == there.end()) throw LeftOut{Reading::name_of(*inner.bearing) + " has no place on both shafts"};
      result_.shafts.unit.joints.push_back({name_of_shaft(inner.mate->id), name_of_shaft(id), outer->held.position, inner.held});
      result_.joint_remarks.push_back(Reading::name_of(*inner.bearing));
    }
  }

  /// The axial bearing of each shaft: one with a stiffness, else the one of lowest z.
  void settle_bearings() {
    const auto is_axial = [](const ShaftBearing& bearing) { return bearing.axial_stiffness > 0.0; };
    for (const auto& [id, bare] : shafts_) {
      ShaftData& shaft = data_of(id);
      const std::string name = name_of_shaft(id);
      const bool joined = std::ranges::any_of(result_.shafts.unit.joints, [&](const ShaftJoint& joint) {
        return (joint.shaft == name || joint.outer_shaft == name) && is_axial(joint.bearing);
      });
      if (!shaft.bearings.empty() && !joined && std::ranges::none_of(shaft.bearings, is_axial)) {
        notes_.push_back(Reading::name_of(*reading_.model().find(id)) + ": no bearing has an axial_stiffness, the one of lowest z holds it");
      }
    }
  }

  /// With what a study's reader adds.
  ShaftsOfPair completed() {
    ShaftsOfPair all = result_.shafts;
    const auto complete = [&](ShaftData& shaft) {
      if (std::isnan(shaft.material.youngs_modulus)) shaft.material.youngs_modulus = Material{}.youngs_modulus;
      if (std::isnan(shaft.material.poissons_ratio)) shaft.material.poissons_ratio = Material{}.poissons_ratio;
      const bool held = std::ranges::any_of(shaft.bearings, [](const ShaftBearing& bearing) { return bearing.axial_stiffness > 0.0; });
      if (!shaft.bearings.empty() && !held) shaft.bearings.front().axial_stiffness = std::numeric_limits<double>::infinity();
    };
    for (const Member m : {Member::Pinion, Member::Wheel}) complete(*all.shaft[m]);
    for (ShaftData& shaft : all.unit.shafts) complete(shaft);
    return all;
  }

  Reading& reading_;
  const StageParts& parts_;
  const GearPair& pair_;
  const ImportedTorque& reference_;
  Condition condition_;
  Vector3d x_{Vector3d::Zero()}, y_{Vector3d::Zero()}, z_{Vector3d::Zero()};
  std::map<int, BareShaft> shafts_;    ///< by id
  std::vector<double> known_torques_;  ///< on the first gear of each mesh by its shaft, about z [N mm]; not given: the file does not say
  std::vector<std::string> notes_;
  ImportedUnit result_;
};

/// Whether the stage's gears have other meshes, or its shafts carry other gears or run in other shafts.
bool is_in_unit(const Reading& reading, const StageParts& parts) {
  for (const GearParts& gear : parts.gears) {
    if (gear.shaft == nullptr || reading.related(*gear.shaft, {"shaft_section"}).empty()) return false;
  }
  for (const GearParts& gear : parts.gears) {
    if (meshes_of(reading, *gear.gear) > 1 || reading.related(*gear.shaft, {"cylindrical_gear"}).size() > 1) return true;
    for (const Relation& relation : reading.model().relations) {
      if (relation.role("inner_part") != gear.shaft->id && relation.role("outer_part") != gear.shaft->id) continue;
      for (const char* side : {"inner_part", "outer_part"}) {
        const auto id = relation.role(side);
        const Component* other = id ? reading.model().find(*id) : nullptr;
        if (other != nullptr && other != gear.shaft && other->type == "shaft") return true;
      }
    }
  }
  return false;
}

}  // namespace

std::optional<ImportedUnit> read_unit(Reading& reading, const StageParts& parts, const GearPair& pair, const ImportedTorque& reference) {
  if (!is_in_unit(reading, parts) || stages_of(reading).size() < 2) return std::nullopt;
  try {
    return UnitReading(reading, parts, pair, reference).read();
  } catch (const LeftOut& left_out) {
    reading.warn("the unit around the stage: not taken, " + left_out.why);
    return std::nullopt;
  }
}

}  // namespace flankwright::studies::rexs
