#include "studies/tasks/optimise/assessment_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "optimize/sampling/sobol_sequence.hpp"
#include "studies/study_file/study_items.hpp"
#include "studies/study_file/distribution_reading.hpp"
#include "studies/study_file/sweep_value.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

namespace {

constexpr const char* table_name = "optimise.tolerances";

std::vector<SceneTolerance>& tolerances_of(StudyReading& reading) { return reading.builder.study.tolerances; }

/// An amount of a modification, which scatters about what is designed.
bool is_amount(const SchemaKey& key) {
  const auto* parameter = std::get_if<ModificationParameter>(&key.store);
  return parameter != nullptr && describe(*parameter).kind == ParameterKind::Amount;
}

/// The keys that an item scatters: one, or the three of an error that a tolerance class covers; none where it is refused.
std::vector<const SchemaKey*> keys_of(StudyReading& reading, const Item& item) {
  const std::string shown = std::string(table_name) + "." + item.name;
  if (item.name == "pinion.error" || item.name == "wheel.error") {
    std::vector<const SchemaKey*> keys;
    for (const char* name : {".helix_slope", ".profile_slope", ".pitch"}) keys.push_back(study_keys().at(item.name + name));
    return keys;
  }
  const auto known = study_keys().find(item.name);
  if (known == study_keys().end()) {
    reading.refuse(item.position, shown, item.node, "unknown key" + nearest_key_hint(study_keys(), item.name));
    return {};
  }
  if (is_sweepable(*known->second) && std::holds_alternative<StoreInScene>(known->second->store)) return {known->second};
  if (is_amount(*known->second)) return {known->second};
  reading.refuse(item.position, shown, item.node,
                 "allowed are load.torque, the numbers below misalignment, pinion.error and wheel.error, the amounts below "
                 "pinion.modification and wheel.modification, and bearing_clearance of either gear");
  return {};
}

void read_tolerance(StudyReading& reading, const Item& item, const GearPair* pair) {
  const std::string shown = std::string(table_name) + "." + item.name;
  for (const SchemaKey* key : keys_of(reading, item)) {
    if (reading.find("load.spectrum") != nullptr && key->path.starts_with("load.")) {
      return reading.refuse(item.position, shown, item.node, "every draw has all loads of load.spectrum: allowed is this or load.spectrum");
    }
    const bool twice = std::ranges::any_of(tolerances_of(reading), [&](const SceneTolerance& t) { return t.path == key->path; });
    if (twice) return reading.refuse(item.position, shown, item.node, key->path + " is given twice");
    try {
      const auto named = read_distribution(*key, *item.node, pair);
      if (named) tolerances_of(reading).push_back({key->path, named->in_words, named->distribution, is_amount(*key), named->pitch});
    } catch (const InvalidInput& problem) {
      return reading.refuse(item.position, shown, item.node, "allowed is " + problem.allowed());
    }
  }
}

void read_clearance(StudyReading& reading, const Item& item) {
  const std::string shown = std::string(table_name) + "." + item.name;
  const toml::table* table = item.node->as_table();
  const bool complete = table != nullptr && table->size() == 2 && table->contains("clearance") && table->contains("span");
  if (!complete) return reading.refuse(item.position, shown, item.node, "allowed is { clearance = um, span = mm }");
  const SchemaKey clearance{.quantity = Quantity::Deviation, .range = {.low = 0.0, .high = 1000.0, .low_open = true}};
  const SchemaKey span{.quantity = Quantity::Length, .range = {.low = 1.0, .high = 10000.0}};
  try {
    const double tilt = read_number(clearance, *table->get("clearance")) / read_number(span, *table->get("span")) / units::arcmin;
    for (const char* axis : {"misalignment.crossing", "misalignment.intersecting"}) {
      tolerances_of(reading).push_back(
          {axis,
           fmt::format("clearance of the {} bearings: uniform, {:.3g} arcmin either way, added", item.name.substr(0, item.name.find('.')), tilt),
           Distribution::uniform(-tilt, tilt),
           true,
           {}});
    }
  } catch (const InvalidInput& problem) {
    reading.refuse(item.position, shown, item.node, "allowed is { clearance = um, span = mm }: " + problem.allowed());
  }
}

void check_samples(StudyReading& reading) {
  const Study& study = reading.builder.study;
  const AssessmentTable& assessment = study.table<OptimiseTable>().assessment;
  for (const auto& [key, drawn] :
       {std::pair{"optimise.validation.samples", &assessment.validation}, std::pair{"optimise.scenes_drawn.samples", &assessment.scenes}}) {
    if (drawn->samples == 0 || !study.tolerances.empty()) continue;
    reading.refuse(reading.where(key), key, reading.find(key)->node, "set optimise.tolerances: scenes are drawn from them");
  }
  if (static_cast<int>(study.tolerances.size()) > sobol_dimensions) {
    reading.refuse(reading.where(table_name), table_name, nullptr, "at most " + std::to_string(sobol_dimensions) + " quantities");
  }
}

}  // namespace

void read_assessment(StudyReading& reading) {
  const PairData& data = reading.builder.study.pair;
  std::unique_ptr<GearPair> pair;  // none: what is wrong with it is said elsewhere
  if (reading.find(table_name) != nullptr && find_problems(data).empty()) pair = std::make_unique<GearPair>(make_gear_pair(data));
  const std::size_t problems = reading.problems.size();
  for (const Item& item : items_of(reading, table_name, is_filled_table)) {
    const bool is_clearance = item.name == "pinion.bearing_clearance" || item.name == "wheel.bearing_clearance";
    is_clearance ? read_clearance(reading, item) : read_tolerance(reading, item, pair.get());
  }
  // Values in place of the scene's own come first, what is added to them after.
  std::ranges::stable_partition(tolerances_of(reading), [](const SceneTolerance& t) { return !t.added; });
  if (reading.problems.size() == problems && (pair || reading.find(table_name) == nullptr)) check_samples(reading);
}

}  // namespace flankwright::studies
