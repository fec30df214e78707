#include "studies/exchange/rexs/rexs_stage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

bool runs_against(const std::array<double, 3>& one, const std::array<double, 3>& two) {
  return one[0] * two[0] + one[1] * two[1] + one[2] * two[2] < 0.0;
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
  for (const Component* of : {parts.gear, parts.shaft}) {
    if (of == nullptr || parts.material != nullptr) continue;
    const auto materials = reading.related(*of, {"material"});
    if (!materials.empty()) parts.material = materials.front();
  }
}

}  // namespace

StageParts parts_of(Reading& reading, const Relation& relation) {
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
    const bool against = runs_against(z, u_axis(reading, *gear.gear));
    const bool positive = reading.word(gear.gear, "datum_face_orientation") == "positive";
    gear.datum_at_low_z = positive == against;
    const auto shafts = reading.related(*gear.gear, {"shaft"});
    if (!shafts.empty()) gear.shaft = shafts.front();
    if (gear.shaft != nullptr) gear.shaft_against_z = runs_against(z, u_axis(reading, *gear.shaft));
  }
  return parts;
}

StageParts find_stage(Reading& reading, std::optional<int> number) { return parts_of(reading, choose(reading, number)); }

void take_flank(Reading& reading, StageParts& parts, WorkingFlank flank, std::string source) {
  parts.working_flank = flank;
  parts.flank_source = std::move(source);
  // Right flanks mesh with right flanks when both are seen from the same end.
  for (GearParts& gear : parts.gears) {
    find_flanks(reading, gear, (flank == WorkingFlank::Left) == gear.datum_at_low_z);
    find_rest(reading, gear);
  }
}

}  // namespace flankwright::studies::rexs
