#include "studies/study_file/sweep_value.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace flankwright::studies {

bool is_extent(const SchemaKey& key) {
  const auto* parameter = std::get_if<ModificationParameter>(&key.store);
  return parameter != nullptr && describe(*parameter).kind == ParameterKind::Extent;
}

bool is_sweepable(const SchemaKey& key) {
  const bool is_number = key.kind == ValueKind::Number || key.kind == ValueKind::NumberOrList;
  return is_number && (std::holds_alternative<StoreInScene>(key.store) || std::holds_alternative<ModificationParameter>(key.store));
}

bool is_in_range(const SchemaKey& key, double value) {
  const bool above = key.range.low_open || is_extent(key) ? value > key.range.low : value >= key.range.low;
  const bool below = key.range.high_open ? value < key.range.high : value <= key.range.high;
  return std::isfinite(value) && above && below;
}

void set_swept(SweptCondition& condition, const SchemaKey& key, double value) {
  if (!is_in_range(key, value)) throw InvalidInput(key.path, fmt::format("{:.6g}", value), allowed_values(key));
  const double inside = internal_value(value, key.quantity);
  if (const auto* in_scene = std::get_if<StoreInScene>(&key.store)) {
    Value stored;
    stored.number = inside;
    stored.numbers = {inside};
    (*in_scene)(condition.scene, key.member, stored);
  } else {
    set(condition.modification[key.member], std::get<ModificationParameter>(key.store), inside);
  }
}

std::vector<double> pitch_of_draw(const PitchTolerance& tolerance, double value) {
  std::vector<double> deviations = drawn_pitch(tolerance, static_cast<std::uint64_t>(value));
  for (double& deviation : deviations) deviation = outside_value(deviation, Quantity::Deviation);
  return deviations;
}

void set_drawn_pitch(ManufacturingError& error, const PitchTolerance& tolerance, double value) {
  error.pitch_step = 0.0;
  error.cumulative_pitch.clear();
  for (const double um : pitch_of_draw(tolerance, value)) error.cumulative_pitch.push_back(internal_value(um, Quantity::Deviation));
}

}  // namespace flankwright::studies
