#pragma once

#include <optional>
#include <vector>

#include "studies/exchange/rexs/rexs_condition.hpp"
#include "studies/exchange/rexs/rexs_stage.hpp"

namespace flankwright::studies::rexs {

/// What a condition of a file says beside its torques: how fast, how long and how hot a stage runs. Nothing where the file does not say.
struct OperatingCondition {
  std::optional<Taken> speed{};        ///< of the pinion, its size [1/min], > 0
  std::optional<Taken> temperature{};  ///< of the oil [deg C], -50 .. 250
  std::optional<Taken> share{};        ///< of the time of all load cases, >= 0; 1: all of it
  std::optional<Taken> hours{};        ///< how long it lasts [h], >= 0
};

/// The speed is the rotational_speed of the pinion's shaft, or that of a shaft that external meshes join to it, through the teeth. What a load case
/// states comes before what the model states; statements of one origin that differ by more than 1 % are warned of, and the nearest to the pinion is
/// taken. Beside a planet carrier no speed is taken, as a study counts it relative to the carrier.
///
/// The temperature is temperature_lubricant of the stage, else of the casing. Share and hours are those of the load case's gear_unit:
/// operating_time_fraction (up to 1.2 load_duration_fraction) and operating_time (load_duration).
/// @throws StudyErrors with component, attribute, value and line where a time is negative or a temperature is none of an oil
OperatingCondition read_operation(const Condition& condition, const StageParts& parts);

/// operating_time of the gear_unit: the time of all load cases [h], > 0. @throws StudyErrors where it is negative
std::optional<Taken> total_hours(Reading& reading);

}  // namespace flankwright::studies::rexs
