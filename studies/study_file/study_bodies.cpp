#include "studies/study_file/study_bodies.hpp"

#include <algorithm>
#include <array>

#include "core/gear/gear_pair.hpp"

namespace flankwright::studies {

namespace {

constexpr std::array web_keys{"rim_thickness", "web_thickness", "web_offset",    "hub_diameter",
                              "hub_width",     "hole_count",    "hole_diameter", "hole_circle_diameter"};

/// What one key of the body needs of another.
void check_presence_of(StudyReading& reading, const std::string& table) {
  const auto given = [&](const char* key) { return reading.find(table + key) != nullptr; };
  const auto key_of_web = std::ranges::find_if(web_keys, given);
  if (key_of_web != web_keys.end()) {
    for (const char* needed : {"rim_thickness", "web_thickness"}) {
      if (!given(needed)) {
        reading.refuse(reading.where(table + *key_of_web), table + needed, nullptr,
                       "allowed is a number in mm: " + table + *key_of_web + " makes a gear of rim, web and hub");
      }
    }
  }
  const bool has_holes =
      given("hole_count") && reading.builder.study.body[table.starts_with("pinion") ? Member::Pinion : Member::Wheel].web->holes.count > 0;
  if (has_holes && !given("hole_diameter")) {
    reading.refuse(reading.where(table + "hole_count"), table + "hole_diameter", nullptr, "allowed is a number in mm: holes have a diameter");
  }
  for (const char* key : {"hole_diameter", "hole_circle_diameter"}) {
    if (given(key) && !has_holes) reading.refuse_key(table + key, "allowed only with " + table + "hole_count of at least 3");
  }
}

void check_body(StudyReading& reading, Member member) {
  const std::string table = std::string(name_of(member)) + ".body.";
  const bool has_body = std::ranges::any_of(reading.matches, [&](const auto& match) { return match.first.starts_with(table); });
  if (!has_body) return;
  const std::size_t problems = reading.problems.size();
  check_presence_of(reading, table);
  if (reading.problems.size() > problems) return;
  const Study& study = reading.builder.study;
  const GearPair pair = make_gear_pair(study.pair);
  GearData gear = pair[member].data;
  gear.tip_diameter = 2 * pair[member].tip_radius;
  const ToothForm form(gear, study.pair.normal_module, study.pair.pressure_angle, study.pair.helix_angle);
  try {
    body_radii(study.body[member], form, study.pair.normal_module, gear.face_width);
  } catch (const InvalidInput& problem) {
    reading.refuse_key(std::string(name_of(member)) + "." + problem.field(), "allowed is " + problem.allowed());
  }
}

}  // namespace

void check_bodies(StudyReading& reading) {
  if (!reading.problems.empty()) return;  // the pair may not exist
  check_body(reading, Member::Pinion);
  check_body(reading, Member::Wheel);
}

}  // namespace flankwright::studies
