#include "studies/exchange/rexs/rexs_unit.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/base/units.hpp"
#include "core/compliance/shaft/shaft_pair.hpp"
#include "core/compliance/shaft/unit_checks.hpp"
#include "core/compliance/shaft/unit_statics.hpp"
#include "core/compliance/shaft/unit_supports.hpp"
#include "studies/exchange/rexs/rexs_errors.hpp"
#include "studies/exchange/rexs/rexs_origin.hpp"
#include "studies/exchange/rexs/rexs_unit_part.hpp"
#include "studies/exchange/rexs/unit_scaling.hpp"
#include "studies/study/study_errors.hpp"

namespace flankwright::studies::rexs {

namespace {

using Eigen::Vector3d;

/// With what a study's reader adds.
ShaftsOfPair completed(ShaftsOfPair all) {
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

class UnitReading {
 public:
  UnitReading(Reading& reading, const StageParts& parts, const GearPair& pair, const ImportedTorque& reference)
      : reading_(reading),
        parts_(parts),
        pair_(pair),
        reference_(reference),
        condition_(reading, reference.load_case),
        part_(part_around(reading, *parts.stage)) {
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
    const std::vector<InvalidInput> problems = find_problems(completed(result_.shafts), pair_);
    if (!problems.empty()) {
      refuse_mechanism();
      throw LeftOut{
          fmt::format("{} = {}: allowed is {}", in_terms_of_file(problems.front().field()), problems.front().value(), problems.front().allowed())};
    }
    return std::move(result_);
  }

  /// What is to be said of the unit that was read.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  /// Shafts that support each other alone, which nothing holds; what nothing holds along or about its axis may only be incomplete.
  void refuse_mechanism() {
    const ShaftsOfPair whole = completed(result_.shafts);
    std::vector<double> lengths;
    for (const ShaftData* shaft : whole.all()) lengths.push_back(shaft->length());
    if (std::ranges::any_of(lengths, [](double length) { return !(length > 0.0); })) return;
    const std::optional<LooseMotion> loose = find_loose_motion(lengths, make_supports(whole).supports);
    const auto is_whole = [](double part) { return std::abs(part) == 1.0; };  // the largest part, see LooseMotion
    if (!loose || is_whole(loose->translation.z()) || is_whole(loose->turn.z())) return;
    const std::string name = whole.names()[static_cast<std::size_t>(loose->beam)];
    const auto found = std::ranges::find_if(shafts_, [&](const auto& shaft) { return name_of_shaft(shaft.first) == name; });
    const Component& shaft = *reading_.model().find(found->first);
    refuse(reading_.file(), shaft.line, full_name(shaft), "a shaft that can move as a rigid body",
           "bearings that hold it across its axis and against tilting, by themselves or through the shafts that they sit on");
  }

  /// A field of find_problems() with the component in place of the study's table.
  std::string in_terms_of_file(const std::string& field) const {
    std::vector<std::pair<std::string, std::string>> names;
    for (const Member m : {Member::Pinion, Member::Wheel})
      names.emplace_back(std::string(flankwright::name_of(m)) + ".shaft", full_name(*parts_[m].shaft));
    const auto add = [&](const char* table, const std::vector<std::string>& components) {
      for (std::size_t i = 0; i < components.size(); ++i)
        names.emplace_back(fmt::format("unit.{}.{}", table, i), origin_of(reading_.model(), components[i]).words);
    };
    add("shafts", result_.shaft_remarks);
    add("loads", result_.load_remarks);
    add("joints", result_.joint_remarks);
    std::vector<std::string> meshes;
    for (const UnitMesh& mesh : result_.shafts.unit.meshes) meshes.push_back(mesh.name);
    add("meshes", meshes);
    for (const auto& [table, name] : names) {
      if (field == table || field.starts_with(table + ".")) return name + ": " + field.substr(std::min(field.size(), table.size() + 1));
    }
    return field;
  }

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

  /// The direction that loads are counted from, the file's or z.
  /// @param u  the shaft's axis, a unit vector
  Vector3d across(const Component& shaft, const Vector3d& u) {
    const auto given = reading_.numbers(&shaft, "w_axis_vector", Dimension::Length);
    if (!given) return Vector3d::UnitZ();
    const Vector3d w = given->size() == 3 ? Vector3d((*given)[0], (*given)[1], (*given)[2]) : Vector3d::Zero();
    constexpr double right_angle = 1e-3;  // |cos| of the angle between both at most: 0.06 deg
    if (!(w.norm() > 0.0) || std::abs(w.normalized().dot(u)) > right_angle) {
      throw LeftOut{Reading::name_of(shaft) + " has a w_axis_vector that is no direction across its axis"};
    }
    return w.normalized();
  }

  void read_shafts() {
    for (const Component& component : reading_.model().components) {
      if (component.type != "shaft" || !part_.shafts.contains(component.id)) continue;
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
    const Vector3d w = across(shaft, u), v = w.cross(u);
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
    const auto id = relation.role("stage"), gear = relation.role("gear_1");
    if (!id || *id == parts_.stage->id || (gear && !part_.gears.contains(*gear))) return;
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

  bool are_torques_settled() { return torque_balance(completed(result_.shafts), pair_).determined; }

  /// Torques of meshes where the balance of the shafts leaves them open, and only there: from others it follows.
  void settle_torques() {
    if (are_torques_settled()) return;
    std::vector<UnitMesh>& meshes = result_.shafts.unit.meshes;
    for (std::size_t i = 0; i < meshes.size(); ++i) meshes[i].torque = known_torques_[i];
    for (UnitMesh& mesh : meshes) {
      const double given = std::exchange(mesh.torque, not_given);
      if (are_torques_settled()) continue;
      mesh.torque = given;
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

  Reading& reading_;
  const StageParts& parts_;
  const GearPair& pair_;
  const ImportedTorque& reference_;
  Condition condition_;
  UnitPart part_;
  Vector3d x_{Vector3d::Zero()}, y_{Vector3d::Zero()}, z_{Vector3d::Zero()};
  std::map<int, BareShaft> shafts_;    ///< by id
  std::vector<double> known_torques_;  ///< on the first gear of each mesh by its shaft, about z [N mm]; not given: the file does not say
  std::vector<std::string> notes_;
  ImportedUnit result_;
};

/// What the other conditions' loads from outside change.
void read_other_cases(Reading& reading, const StageParts& parts, const GearPair& pair, const ImportedTorque& reference,
                      const std::vector<ImportedTorque>& torques, ImportedUnit& unit) {
  const auto misalignment_of = [&](const ShaftsOfPair& shafts, double torque) {
    const PerGear<GearBodyIn> bodies{GearBodyIn::Structure, GearBodyIn::Structure};
    return ShaftPair(pair, completed(shafts), bodies).state(torque).mesh_misalignment;
  };
  std::vector<std::pair<const ImportedTorque*, ImportedUnit>> others;
  for (const ImportedTorque& torque : torques) {
    if (torque.load_case == reference.load_case || !(torque.torque > 0.0)) continue;
    try {
      others.emplace_back(&torque, UnitReading(reading, parts, pair, torque).read());
    } catch (const LeftOut& left_out) {
      if (torque.flank != reference.flank) continue;  // the other way round the unit is not that of the pair's flank
      reading.warn(fmt::format("{}: its loads from outside are not taken but those of {}, {}", torque.name, reference.name, left_out.why));
    }
  }
  std::vector<UnitData> conditions;
  for (const auto& [torque, other] : others) conditions.push_back(other.shafts.unit);
  mark_constant_loads(unit.shafts.unit, conditions);
  for (const auto& [torque, other] : others) {
    if (torque->flank != reference.flank || are_scaled(other.shafts.unit, unit.shafts.unit)) continue;
    const double added = misalignment_of(other.shafts, torque->torque) - misalignment_of(unit.shafts, torque->torque);
    constexpr double negligible = 0.01 * units::um;
    const bool counts = std::abs(added) > negligible;
    if (counts) unit.misalignment[torque->load_case] = added;
    reading.warn(
        fmt::format("{}: loads from outside are not those of {} scaled with the torque, as a study has them; {}, bearing forces and "
                    "bending within the face are not taken",
                    torque->name, reference.name,
                    counts ? fmt::format("the {:.3g} um of misalignment by the difference are taken", added / units::um)
                           : "the misalignment by the difference is below 0.01 um"));
  }
}

}  // namespace

std::optional<ImportedUnit> read_unit(Reading& reading, const StageParts& parts, const GearPair& pair, const std::vector<ImportedTorque>& torques) {
  if (stages_of(reading).size() < 2 || !is_in_unit(reading, parts)) return std::nullopt;
  const ImportedTorque& reference = reference_of(torques);
  try {
    UnitReading of_reference(reading, parts, pair, reference);
    ImportedUnit unit = of_reference.read();
    for (const std::string& note : of_reference.notes()) reading.warn(note);
    read_other_cases(reading, parts, pair, reference, torques, unit);
    return unit;
  } catch (const LeftOut& left_out) {
    reading.warn("the unit around the stage: not taken, " + left_out.why);
    return std::nullopt;
  }
}

}  // namespace flankwright::studies::rexs
