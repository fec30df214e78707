#include "studies/analysis/axial_hold_note.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/gear/both_gears.hpp"

namespace flankwright::studies {

namespace {

bool has_axial_force(const Study& study, const std::string& shaft) {
  const auto is_of_pair = [&](Member m) { return shaft == name_of(m); };
  if (study.pair.helix_angle != 0.0 && std::ranges::any_of(both_gears, is_of_pair)) return true;
  const auto is_helical_on_it = [&](const UnitMesh& mesh) {
    return mesh.helix_angle != 0.0 && std::ranges::any_of(mesh.gears, [&](const UnitGear& gear) { return gear.shaft == shaft; });
  };
  const auto pushes_it = [&](const UnitLoad& load) { return load.shaft == shaft && load.force.z() != 0.0; };
  return std::ranges::any_of(study.unit.meshes, is_helical_on_it) || std::ranges::any_of(study.unit.loads, pushes_it);
}

void note_hold(const Study& study, const ShaftData& shaft, const std::string& name, std::vector<std::string>& notes) {
  // A stiffness that is given is finite.
  const auto held = std::ranges::find_if(shaft.bearings, [](const ShaftBearing& bearing) { return std::isinf(bearing.axial_stiffness); });
  if (held == shaft.bearings.end() || !has_axial_force(study, name)) return;
  notes.push_back(fmt::format(
      "no bearing of the shaft \"{}\" has an axial_stiffness: its bearing{} at {:.6g} mm, the first, is taken to hold it rigidly along its axis",
      name, held->name.empty() ? "" : fmt::format(" \"{}\"", held->name), held->position));
}

}  // namespace

std::vector<std::string> axial_hold_notes(const Study& study) {
  std::vector<std::string> notes;
  for (const Member m : both_gears) {
    if (study.shaft[m]) note_hold(study, *study.shaft[m], name_of(m), notes);
  }
  for (const ShaftData& shaft : study.unit.shafts) note_hold(study, shaft, shaft.name, notes);
  return notes;
}

}  // namespace flankwright::studies
