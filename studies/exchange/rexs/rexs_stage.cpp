#include "studies/exchange/rexs/rexs_stage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "studies/exchange/rexs/rexs_errors.hpp"

namespace flankwright::studies::rexs {

std::vector<const Relation*> stages_of(const Reading& reading) {
  std::vector<const Relation*> stages;
  for (const Relation& relation : reading.model().relations) {
    const std::optional<int> id = relation.type == "stage" ? relation.role("stage") : std::nullopt;
    const Component* stage = id ? reading.model().find(*id) : nullptr;
    if (stage != nullptr && stage->type == "cylindrical_stage") stages.push_back(&relation);
  }
  return stages;
}

std::ptrdiff_t meshes_of(const Reading& reading, const Component& gear) {
  return std::ranges::count_if(reading.model().relations, [&](const Relation& relation) {
    return relation.type == "stage" && (relation.role("gear_1") == gear.id || relation.role("gear_2") == gear.id);
  });
}

std::array<double, 3> u_axis(Reading& reading, const Component& component) {
  const auto vector = reading.numbers(&component, "u_axis_vector", Dimension::Length);
  if (!vector || vector->size() != 3) return {1.0, 0.0, 0.0};
  return {(*vector)[0], (*vector)[1], (*vector)[2]};
}

namespace {

std::string teeth_in_words(const Reading& reading, const Relation& stage, std::string_view role) {
  const Component& gear = reading.in_role(stage, role);
  const Attribute* teeth = gear.find("number_of_teeth");
  std::string number = teeth == nullptr ? "?" : teeth->text;
  if (number.ends_with(".0")) number.resize(number.size() - 2);  // as some write whole numbers
  return fmt::format("{} {} with {} teeth", gear.type, gear.id, number);
}

}  // namespace

std::string stage_in_words(const Reading& reading, const Relation& relation) {
  const Component& stage = reading.in_role(relation, "stage");
  return fmt::format("cylindrical_stage {}{}: {}, {}", stage.id, stage.name.empty() ? "" : " \"" + stage.name + "\"",
                     teeth_in_words(reading, relation, "gear_1"), teeth_in_words(reading, relation, "gear_2"));
}

namespace {

std::string list_of(const Reading& reading, const std::vector<const Relation*>& stages) {
  std::vector<std::string> entries;
  for (std::size_t i = 0; i < stages.size(); ++i) entries.push_back(fmt::format("--stage {} ({})", i + 1, stage_in_words(reading, *stages[i])));
  return fmt::format("{}", fmt::join(entries, "; "));
}

const Relation& choose(const Reading& reading, std::optional<int> number) {
  const std::vector<const Relation*> stages = stages_of(reading);
  if (stages.empty()) refuse(reading.file(), 0, "model", "no relation \"stage\" of a cylindrical_stage", "a file with a cylindrical stage");
  if (!number && stages.size() == 1) return *stages.front();
  const std::string allowed = "one of " + list_of(reading, stages);
  if (!number) refuse(reading.file(), 0, "--stage", "not given, and several stages", allowed);
  if (*number >= 1 && static_cast<std::size_t>(*number) <= stages.size()) return *stages[static_cast<std::size_t>(*number) - 1];
  for (const Relation* stage : stages) {
    if (stage->role("stage") == *number) return *stage;
  }
  refuse(reading.file(), 0, "--stage", std::to_string(*number), allowed);
}

int teeth_of(Reading& reading, const Component& gear) {
  if (gear.type != "cylindrical_gear") {
    refuse(reading.file(), gear.line, Reading::name_of(gear), "in the stage", "a cylindrical_gear: internal gears are not modelled");
  }
  const std::optional<Taken> teeth = reading.number(&gear, "number_of_teeth", Dimension::None);
  const std::string allowed = "a whole number of teeth, 5 .. 1000 (internal gears are not modelled)";
  if (!teeth) reading.refuse_attribute(gear, "number_of_teeth", "not given", allowed);
  if (std::floor(teeth->value) != teeth->value || teeth->value < 5.0 || teeth->value > 1000.0) {
    reading.refuse_attribute(gear, "number_of_teeth", fmt::format("{}", teeth->value), allowed);
  }
  return static_cast<int>(teeth->value);
}

/// What the stage says of one gear: stage_gear_data up to 1.2, cylindrical_stage_gear_data since.
const Component* gear_data(const Reading& reading, const Component& stage, const Component& gear) {
  for (const Relation& relation : reading.model().relations) {
    if (relation.type != "stage_gear_data") continue;
    if (relation.role("stage") == stage.id && relation.role("gear") == gear.id) return &reading.in_role(relation, "stage_gear_data");
  }
  return nullptr;
}

bool against_z(const std::array<double, 3>& z, const std::array<double, 3>& u) { return z[0] * u[0] + z[1] * u[1] + z[2] * u[2] < 0.0; }

void find_flanks(const Reading& reading, GearParts& parts, bool left) {
  for (const Relation& relation : reading.model().relations) {
    if (relation.type != "flank" || relation.role("gear") != parts.gear->id) continue;
    const auto side = [&](const char* role) { return relation.role(role) ? &reading.in_role(relation, role) : nullptr; };
    parts.flank = side(left ? "left" : "right");
    parts.other_flank = side(left ? "right" : "left");
    return;
  }
}

void find_rest(Reading& reading, GearParts& parts) {
  // Up to 1.2 the tool belongs to the gear, then to the flank, through a manufacturing step.
  for (const Component* of : {parts.flank, parts.gear}) {
    if (of == nullptr || parts.tool != nullptr) continue;
    const auto tools = reading.related(*of, {"rack_shaped_tool"});
    if (!tools.empty()) parts.tool = tools.front();
  }
  int last = std::numeric_limits<int>::min();
  for (const Relation& step : reading.model().relations) {
    if (parts.flank == nullptr || step.type != "manufacturing_step" || step.role("workpiece") != parts.flank->id) continue;
    if (!step.role("manufacturing_settings") || step.order.value_or(0) < last) continue;
    last = step.order.value_or(0);
    parts.settings = &reading.in_role(step, "manufacturing_settings");
  }
  const auto shafts = reading.related(*parts.gear, {"shaft"});
  if (!shafts.empty()) parts.shaft = shafts.front();
  for (const Component* of : {parts.gear, parts.shaft}) {
    if (of == nullptr || parts.material != nullptr) continue;
    const auto materials = reading.related(*of, {"material"});
    if (!materials.empty()) parts.material = materials.front();
  }
}

/// The first load case's torque of a load about its shaft's u axis, else the model's; 0: none.
double first_torque(Reading& reading, const Component& load) {
  for (const LoadCase& load_case : reading.model().load_cases) {
    for (const Component& varied : load_case.components) {
      if (varied.id != load.id) continue;
      if (const auto torque = reading.number(&varied, "torque_around_u_axis", Dimension::Torque); torque && torque->value != 0.0)
        return torque->value;
    }
  }
  const auto torque = reading.number(&load, "torque_around_u_axis", Dimension::Torque);
  return torque ? torque->value : 0.0;
}

}  // namespace

int torque_sign(Reading& reading, const Component& gear) {
  // On a shaft with a load from outside its gears get the torque as it is; on one that gets it from a gear the other gears give it on, the other way
  // round. Both gears of a mesh get torques of the same sign.
  const std::array<double, 3> z = u_axis(reading, gear);
  std::map<int, int> signs;  // by gear
  const auto gears_on = [&](const Component& shaft) { return reading.related(shaft, {"cylindrical_gear"}); };
  for (const Component& shaft : reading.model().components) {
    if (shaft.type != "shaft") continue;
    for (const Component* load : reading.related(shaft, {"external_load"})) {
      const double torque = first_torque(reading, *load) * (against_z(z, u_axis(reading, shaft)) ? -1.0 : 1.0);
      if (torque == 0.0) continue;
      for (const Component* on : gears_on(shaft)) signs.try_emplace(on->id, torque > 0.0 ? 1 : -1);
    }
  }
  for (std::size_t known = 0; known != signs.size() && !signs.contains(gear.id);) {
    known = signs.size();
    for (const Relation* stage : stages_of(reading)) {
      const auto one = stage->role("gear_1"), two = stage->role("gear_2");
      if (!one || !two) continue;
      for (const auto& [from, to] : {std::pair{*one, *two}, std::pair{*two, *one}}) {
        if (!signs.contains(from) || !signs.try_emplace(to, signs.at(from)).second) continue;
        const Component* mate = reading.model().find(to);
        if (mate == nullptr) continue;
        for (const Component* shaft : reading.related(*mate, {"shaft"})) {
          for (const Component* on : gears_on(*shaft)) signs.try_emplace(on->id, -signs.at(to));
        }
      }
    }
  }
  return signs.contains(gear.id) ? signs.at(gear.id) : 0;
}

StageParts find_stage(Reading& reading, std::optional<int> number) {
  const Relation& relation = choose(reading, number);
  StageParts parts{.stage = &reading.in_role(relation, "stage")};
  parts.gears[0].gear = &reading.in_role(relation, "gear_1");
  parts.gears[1].gear = &reading.in_role(relation, "gear_2");
  for (std::size_t i = 0; i < 2; ++i) parts.teeth[i] = teeth_of(reading, *parts.gears[i].gear);
  if (parts.teeth[1] < parts.teeth[0]) {
    std::swap(parts.gears[0], parts.gears[1]);
    std::swap(parts.teeth[0], parts.teeth[1]);
  }
  const std::array<double, 3> z = u_axis(reading, *parts.gears[0].gear);
  for (GearParts& gear : parts.gears) {
    gear.data = gear_data(reading, *parts.stage, *gear.gear);
    const bool against = against_z(z, u_axis(reading, *gear.gear));
    const bool positive = reading.word(gear.gear, "datum_face_orientation") == "positive";
    gear.datum_at_low_z = positive == against;
  }
  // Right flanks mesh with right flanks when both are seen from the same end.
  std::string loaded = reading.word(parts.gears[0].data, "loaded_tooth_flank");
  if (loaded == "left" || loaded == "right") {
    parts.flank_is_given = true;
    parts.working_flank = (loaded == "right") == parts.gears[0].datum_at_low_z ? WorkingFlank::Right : WorkingFlank::Left;
  }
  // In a unit of several stages the torques say which flanks work where the file does not.
  if (!parts.flank_is_given && stages_of(reading).size() > 1) {
    const int sign = torque_sign(reading, *parts.gears[0].gear);
    if (sign != 0) parts.working_flank = sign > 0 ? WorkingFlank::Right : WorkingFlank::Left;
    parts.flank_by_torque = sign != 0;
  }
  reading.word(parts.gears[1].data, "loaded_tooth_flank");
  for (GearParts& gear : parts.gears) {
    find_flanks(reading, gear, (parts.working_flank == WorkingFlank::Left) == gear.datum_at_low_z);
    find_rest(reading, gear);
    if (gear.shaft != nullptr) gear.shaft_against_z = against_z(z, u_axis(reading, *gear.shaft));
  }
  return parts;
}

}  // namespace flankwright::studies::rexs
