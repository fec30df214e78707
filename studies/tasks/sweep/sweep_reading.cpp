#include "studies/tasks/sweep/sweep_reading.hpp"

#include <algorithm>
#include <array>

#include "optimize/sampling/sobol_sequence.hpp"
#include "studies/study_file/study_items.hpp"
#include "studies/study_file/distribution_reading.hpp"
#include "studies/study_file/left_out_effects.hpp"
#include "studies/tasks/sweep/sweep_design.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"

namespace flankwright::studies {

namespace {

constexpr std::array toleranced{"helix_slope", "profile_slope", "pitch"};

/// The keys of an item of [sweep.parameters]: one, or the three of an error that a tolerance class covers.
std::vector<const SchemaKey*> keys_of(StudyReading& reading, const Item& item) {
  const std::string shown = "sweep.parameters." + item.name;
  if (item.name == "pinion.error" || item.name == "wheel.error") {
    const toml::table* table = item.node->as_table();
    if (table == nullptr || !table->contains("iso_1328_class")) {
      reading.refuse(item.position, shown, item.node, "allowed is { iso_1328_class = 1 .. 11 }, or distributions of single errors");
      return {};
    }
    std::vector<const SchemaKey*> keys;
    for (const char* name : toleranced) keys.push_back(study_keys().at(item.name + "." + name));
    return keys;
  }
  const auto known = study_keys().find(item.name);
  if (known == study_keys().end()) {
    reading.refuse(item.position, shown, item.node, "unknown key" + nearest_key_hint(study_keys(), item.name));
    return {};
  }
  if (!is_sweepable(*known->second)) {
    reading.refuse(
        item.position, shown, item.node,
        "a sweep cannot vary it; allowed are load.torque, load.speed, twist_compensation and the numbers below misalignment, pinion.modification, "
        "wheel.modification, pinion.error and wheel.error");
    return {};
  }
  return {known->second};
}

void read_parameter(StudyReading& reading, const Item& item, const GearPair* pair) {
  std::vector<SweepParameter>& parameters = reading.builder.study.table<SweepTable>().parameters;
  for (const SchemaKey* key : keys_of(reading, item)) {
    const std::string shown = "sweep.parameters." + item.name;
    try {
      const auto named = read_distribution(*key, *item.node, pair);
      if (!named) continue;
      if (std::ranges::any_of(parameters, [&](const SweepParameter& p) { return p.path == key->path; })) {
        return reading.refuse(item.position, shown, item.node, key->path + " is given twice");
      }
      parameters.push_back({key->path, std::string(default_unit(key->quantity)), named->distribution, named->in_words, named->pitch});
      if (named->pitch) parameters.back().unit = "-";
    } catch (const InvalidInput& problem) {
      return reading.refuse(item.position, shown, item.node, "allowed is " + problem.allowed());
    }
  }
}

bool is_swept(const SweepTable& sweep, const std::string& path) {
  return std::ranges::any_of(sweep.parameters, [&](const SweepParameter& p) { return p.path == path; });
}

/// A relief's amount needs the height or length over which it is spread.
void check_reliefs(StudyReading& reading, const SweptCondition& nominal) {
  const SweepTable& sweep = reading.builder.study.table<SweepTable>();
  for (const std::string gear : {"pinion.", "wheel."}) {
    const Modification& m = gear == "pinion." ? nominal.modification.pinion : nominal.modification.wheel;
    for (const ModificationDescriptor& amount : modification_parameters) {
      if (amount.extent.empty()) continue;
      const std::string path = gear + "modification." + std::string(amount.key), extent = gear + "modification." + std::string(amount.extent);
      if (!is_swept(sweep, path) || find_parameter(amount.extent)->get(m) > 0.0) continue;
      reading.refuse_key("sweep.parameters." + path, "set " + extent + " above 0 mm: the relief's amount is spread over it");
    }
  }
}

void check_design(StudyReading& reading) {
  SweepTable& sweep = reading.builder.study.table<SweepTable>();
  const auto count = static_cast<int>(sweep.parameters.size());
  if (sweep.sampler == Sampler::Grid) {
    sweep.indices = false;
    if (reading.find("sweep.samples") != nullptr) reading.refuse_key("sweep.samples", "a grid has as many as its levels make: leave it out");
    std::vector<int> levels;
    for (const SweepParameter& p : sweep.parameters) {
      levels.push_back(p.distribution.levels());
      if (levels.back() > 0) continue;
      return reading.refuse_key("sweep.parameters." + p.path, "the sampler \"grid\" needs { grid = ... } or { values = ... }");
    }
    try {
      sweep.samples = SampleDesign(levels).samples();
    } catch (const InvalidInput& problem) {
      reading.refuse_key("sweep.parameters", problem.value() + ": allowed are " + problem.allowed());
    }
    return;
  }
  const int coordinates = sweep.indices ? 2 * count : count;
  if (sweep.sampler == Sampler::Sobol && coordinates > sobol_dimensions) {
    return reading.refuse_key("sweep.parameters", "the sampler \"sobol\" has " + std::to_string(sobol_dimensions) +
                                                      " coordinates, a parameter takes " + (sweep.indices ? "2 with indices and 1 without" : "1") +
                                                      "; another sampler has no limit");
  }
  if (sweep.indices && sweep.samples < 2 * (count + 2)) {
    reading.refuse_key("sweep.samples", "at least " + std::to_string(2 * (count + 2)) + " for Sobol indices, or sweep.indices = \"off\"");
  }
}

/// Parameters without a value in the study take their medians.
void set_nominal(StudyReading& reading) {
  Study& study = reading.builder.study;
  SweptCondition nominal = SweptCondition::of(study);
  for (const SweepParameter& p : study.table<SweepTable>().parameters) {
    const bool has_value = reading.find(p.path) != nullptr || p.pitch;  // no gear of a class is its median: the nominal one has equal pitches
    if (!has_value) set_swept(nominal, p, p.distribution.median());
  }
  check_reliefs(reading, nominal);
  study.scenes = {nominal.scene};
  study.modification = nominal.modification;
  study.misalignment = nominal.scene.misalignment;
  study.torques = nominal.scene.torques;
  study.error = nominal.scene.error;
}

}  // namespace

void read_sweep(StudyReading& reading) {
  std::optional<GearPair> pair;
  if (find_problems(reading.builder.study.pair).empty()) pair = make_gear_pair(reading.builder.study.pair);
  for (const Item& item : items_of(reading, "sweep.parameters", is_filled_table)) read_parameter(reading, item, pair ? &*pair : nullptr);
}

void check_sweep(StudyReading& reading) {
  const Study& study = reading.builder.study;
  if (!reading.problems.empty()) return;
  if (study.table<SweepTable>().parameters.empty()) return reading.refuse_key("sweep.parameters", "task \"sweep\" needs at least one parameter");
  if (reading.find("scenes") != nullptr) {
    return reading.refuse_key("scenes", "a sweep runs one working condition: vary its keys in sweep.parameters");
  }
  const bool has_spectrum = reading.find("load.spectrum") != nullptr;
  for (const std::string key : {"load.torque", "load.speed"}) {
    if (!has_spectrum || !is_swept(study.table<SweepTable>(), key)) continue;
    return reading.refuse_key("sweep.parameters." + key, "a sweep has all loads of load.spectrum: allowed is this or load.spectrum");
  }
  if (!has_spectrum && study.torques.size() > 1) {
    return reading.refuse_key("load.torque", "a sweep takes one torque, or load.torque = { values = [...] } in sweep.parameters");
  }
  for (const ExclusiveKeys& keys : exclusive_keys()) {
    if (is_swept(study.table<SweepTable>(), keys.first) && is_swept(study.table<SweepTable>(), keys.second)) {
      return reading.refuse_key("sweep.parameters." + keys.second, "overlaps the parameter " + keys.first + "; allowed is one of them");
    }
  }
  for (const SweepParameter& p : study.table<SweepTable>().parameters) {
    std::string given_at = "sweep.parameters." + p.path;
    if (!reading.positions.contains(given_at)) given_at.resize(given_at.rfind('.'));  // one of the errors that a class covers
    const auto is_said = [&](const StudyProblem& problem) { return problem.key == given_at; };
    if (std::ranges::none_of(reading.problems, is_said)) require_effect_of(reading, given_at, p.path);
    const Member m = study_keys().at(p.path)->member;
    const GrindingKind kind = study.modification[m].process.kind;
    const bool twists = kind == GrindingKind::GeneratingGrinding || kind == GrindingKind::FormGrinding;
    if (p.path.ends_with(".twist_compensation") && !twists) {
      reading.refuse_key(given_at,
                         std::string("has no effect: allowed is ") + name_of(m) + ".process = \"generating_grinding\" or \"form_grinding\" with it");
    }
  }
  check_design(reading);
  if (reading.problems.empty()) set_nominal(reading);
}

}  // namespace flankwright::studies
