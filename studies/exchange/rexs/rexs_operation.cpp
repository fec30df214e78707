#include "studies/exchange/rexs/rexs_operation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "studies/exchange/rexs/rexs_errors.hpp"

namespace flankwright::studies::rexs {

namespace {

/// A speed of the pinion that a file states [1/min].
struct SpeedStatement {
  Taken taken;
  bool of_case;  ///< by the load case, not by the model
};

/// A shaft with its speed over that of the pinion, its size.
struct GearedShaft {
  const Component* shaft;
  double ratio;
};

bool has_carrier(const Model& model) { return std::ranges::find(model.components, "planetary_stage", &Component::type) != model.components.end(); }

double teeth_or_none(Reading& reading, const Component& gear) {
  const auto teeth = reading.number(&gear, "number_of_teeth", Dimension::None);
  return gear.type == "cylindrical_gear" && teeth && teeth->value > 0.0 ? teeth->value : 0.0;
}

/// The pinion's shaft first, then those that external meshes join to it, the nearest first.
std::vector<GearedShaft> geared_shafts(Reading& reading, const Component& first) {
  std::vector<GearedShaft> found{{&first, 1.0}};
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const Relation* relation : stages_of(reading)) {
      if (!relation->role("gear_1") || !relation->role("gear_2")) continue;
      const std::array<const Component*, 2> gears{&reading.in_role(*relation, "gear_1"), &reading.in_role(*relation, "gear_2")};
      for (std::size_t g = 0; g < 2; ++g) {
        const auto here = reading.related(*gears[g], {"shaft"}), there = reading.related(*gears[1 - g], {"shaft"});
        const double teeth = teeth_or_none(reading, *gears[g]), others = teeth_or_none(reading, *gears[1 - g]);
        const bool joins = !here.empty() && !there.empty() && here.front() == found[i].shaft && teeth > 0.0 && others > 0.0;
        if (!joins || std::ranges::find(found, there.front(), &GearedShaft::shaft) != found.end()) continue;
        found.push_back({there.front(), found[i].ratio * teeth / others});
      }
    }
  }
  return found;
}

std::optional<Taken> speed_of_pinion(const Condition& condition, const StageParts& parts) {
  Reading& reading = condition.reading();
  const Component* shaft = parts[Member::Pinion].shaft;
  if (shaft == nullptr) return std::nullopt;
  if (has_carrier(reading.model())) {
    reading.warn("rotational speeds: not taken, the file has a planet carrier, and a study counts speeds relative to it");
    return std::nullopt;
  }
  std::vector<SpeedStatement> statements;
  for (const GearedShaft& geared : geared_shafts(reading, *shaft)) {
    const auto speed = condition.number(geared.shaft, "rotational_speed", Dimension::Speed);
    if (!speed || speed->value == 0.0) continue;
    const std::string source = speed->source + (geared.shaft == shaft ? "" : ", through the teeth");
    statements.push_back({{std::abs(speed->value) / geared.ratio, source}, condition.changes(*geared.shaft, "rotational_speed")});
  }
  if (statements.empty()) return std::nullopt;
  std::ranges::stable_partition(statements, &SpeedStatement::of_case);
  const SpeedStatement& first = statements.front();
  constexpr double same_speed = 0.01;  // |n - n_first| <= same_speed * n_first: speeds come rounded
  for (const SpeedStatement& other : statements) {
    if (other.of_case != first.of_case || std::abs(other.taken.value - first.taken.value) <= same_speed * first.taken.value) continue;
    reading.warn(fmt::format("{}the pinion turns with {:.6g} rpm by {}, but with {:.6g} rpm by {}: the first is taken",
                             condition.name().empty() ? "" : condition.name() + ": ", first.taken.value, first.taken.source, other.taken.value,
                             other.taken.source));
  }
  return first.taken;
}

/// A time or a share of it that a load case states of the gear unit.
std::optional<Taken> time_of(const Condition& condition, std::initializer_list<std::string_view> attributes, Dimension dimension) {
  if (condition.load_case() == nullptr) return std::nullopt;
  Reading& reading = condition.reading();
  for (const Component& varied : condition.load_case()->components) {
    const Component* unit = reading.model().find(varied.id);
    if (unit == nullptr || unit->type != "gear_unit") continue;
    for (const std::string_view id : attributes) {
      const auto taken = reading.number(&varied, id, dimension);
      if (!taken) continue;
      const Attribute& attribute = *varied.find(id);
      const std::string source = Reading::name_of(*unit) + " " + attribute.id;
      if (taken->value < 0.0)
        refuse(reading.file(), attribute.line, source + " of " + condition.name(), attribute.text + " " + attribute.unit, "0 or more");
      return Taken{taken->value, source};
    }
  }
  return std::nullopt;
}

std::optional<Taken> temperature_of(const Condition& condition, const StageParts& parts) {
  constexpr double coldest = -50.0, hottest = 250.0;  // deg C, as a study allows of an oil
  Reading& reading = condition.reading();
  std::vector<const Component*> of{parts.stage};
  for (const Component& component : reading.model().components) {
    if (component.type == "gear_casing") of.push_back(&component);
  }
  for (const Component* component : of) {
    const auto taken = condition.number(component, "temperature_lubricant", Dimension::Temperature);
    if (!taken) continue;
    if (taken->value < coldest || taken->value > hottest) {
      refuse(reading.file(), component->line, taken->source + (condition.name().empty() ? "" : " of " + condition.name()),
             fmt::format("{:.6g} deg C", taken->value), "-50 .. 250 deg C");
    }
    return taken;
  }
  return std::nullopt;
}

}  // namespace

OperatingCondition read_operation(const Condition& condition, const StageParts& parts) {
  return {.speed = speed_of_pinion(condition, parts),
          .temperature = temperature_of(condition, parts),
          .share = time_of(condition, {"operating_time_fraction", "load_duration_fraction"}, Dimension::Share),
          .hours = time_of(condition, {"operating_time", "load_duration"}, Dimension::Time)};
}

std::optional<Taken> total_hours(Reading& reading) {
  for (const Component& component : reading.model().components) {
    if (component.type != "gear_unit") continue;
    const auto hours = reading.number(&component, "operating_time", Dimension::Time);
    if (!hours) continue;
    if (hours->value < 0.0) reading.refuse_attribute(component, "operating_time", fmt::format("{:.6g} h", hours->value), "0 h or more");
    if (hours->value > 0.0) return hours;
  }
  return std::nullopt;
}

}  // namespace flankwright::studies::rexs
