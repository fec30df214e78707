#include "studies/exchange/rexs/rexs_unit_part.hpp"

#include <algorithm>

namespace flankwright::studies::rexs {

namespace {

/// Both shafts of a bearing or coupling between two of them; empty where it is none.
std::vector<int> joined_shafts(const Reading& reading, const Relation& relation) {
  std::vector<int> shafts;
  for (const char* side : {"inner_part", "outer_part"}) {
    const auto id = relation.role(side);
    const Component* part = id ? reading.model().find(*id) : nullptr;
    if (part != nullptr && part->type == "shaft") shafts.push_back(part->id);
  }
  return shafts.size() == 2 ? shafts : std::vector<int>();
}

bool is_gear_type(const std::string& type) { return type.ends_with("_gear") || type.ends_with("_wheel"); }

/// Whether the stage's gears have other meshes, or its shafts carry other gears or run in other shafts.
bool is_joined(const Reading& reading, const StageParts& parts) {
  for (const GearParts& gear : parts.gears) {
    if (meshes_of(reading, *gear.gear) > 1) return true;
    if (gear.shaft == nullptr) continue;
    if (reading.related(*gear.shaft, {"cylindrical_gear"}).size() > 1) return true;
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

UnitPart part_around(const Reading& reading, const Component& stage) {
  UnitPart part;
  const auto add_gear = [&](const Component& gear) {
    part.gears.insert(gear.id);
    for (const Component* shaft : reading.related(gear, {"shaft"})) part.shafts.insert(shaft->id);
  };
  const auto size = [&] { return part.gears.size() + part.shafts.size(); };
  std::size_t before = 0;
  do {
    before = size();
    for (const Relation& relation : reading.model().relations) {
      const std::vector<int> shafts = joined_shafts(reading, relation);
      if (std::ranges::any_of(shafts, [&](int shaft) { return part.shafts.contains(shaft); })) part.shafts.insert(shafts.begin(), shafts.end());
      const auto assembly = relation.role("assembly"), carried = relation.role("part");
      const Component* gear = carried ? reading.model().find(*carried) : nullptr;
      if (assembly && part.shafts.contains(*assembly) && gear != nullptr && is_gear_type(gear->type)) add_gear(*gear);
      const auto one = relation.role("gear_1"), two = relation.role("gear_2");
      if (relation.type != "stage" || !one || !two) continue;
      if (relation.role("stage") != stage.id && !part.gears.contains(*one) && !part.gears.contains(*two)) continue;
      add_gear(reading.in_role(relation, "gear_1"));
      add_gear(reading.in_role(relation, "gear_2"));
    }
  } while (size() > before);
  return part;
}

bool is_in_unit(Reading& reading, const StageParts& parts) {
  if (!is_joined(reading, parts)) return false;
  const auto has_sections = [&](const Component& shaft) { return !reading.related(shaft, {"shaft_section"}).empty(); };
  std::string lacking;
  for (const GearParts& gear : parts.gears) {
    if (gear.shaft == nullptr) {
      lacking = full_name(*gear.gear) + " is on no shaft";
    } else if (!has_sections(*gear.shaft)) {
      lacking = full_name(*gear.shaft) + " has no shaft_section";
    }
  }
  if (lacking.empty()) return true;
  const UnitPart part = part_around(reading, *parts.stage);
  if (std::ranges::any_of(part.shafts, [&](int shaft) { return has_sections(*reading.model().find(shaft)); })) {
    reading.warn("the unit around the stage: not taken, " + lacking);
  }
  return false;
}

}  // namespace flankwright::studies::rexs
