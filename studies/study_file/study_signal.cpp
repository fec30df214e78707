#include "studies/study_file/study_signal.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "studies/study_file/signal_file.hpp"
#include "studies/study_file/sweep_value.hpp"

namespace flankwright::studies {

namespace {

constexpr const char* signal_path = "load.spectrum.signal";

/// Time without load on either flank; without revolutions it has no speed.
SpectrumBin idle_bin(const CountedSignal& counted) {
  double duration = counted.count.idle_duration, revolutions = counted.count.idle_revolutions;
  if (counted.reversed) {
    for (const LoadLevel& level : counted.reversed->levels) {
      duration -= level.duration;
      revolutions -= level.cycles;
    }
  }
  constexpr double round_off = 1e-9;  // of the whole signal: what the sums leave
  if (duration < round_off * counted.duration) duration = revolutions = 0.0;
  revolutions = std::max(0.0, revolutions);
  return {.torque = 0.0,
          .speed = revolutions > 0.0 ? 2.0 * units::pi * revolutions / duration : not_given,
          .hours = counted.repeats * duration,
          .cycles = counted.repeats * revolutions};
}

/// Bins of one flank's levels.
/// @param direction  1: of the pair's working flank, -1: of the other one
void append_levels(const CountedSignal& counted, const LoadCount& count, double direction, std::vector<SpectrumBin>& bins) {
  for (const LoadLevel& level : count.levels) {
    if (counted.counting == LoadCounting::TimeAtLevel) {
      bins.push_back({.torque = direction * level.torque,
                      .speed = level.speed,
                      .hours = counted.repeats * level.duration,
                      .cycles = counted.repeats * level.cycles});
    } else {
      bins.push_back({.torque = direction * level.torque, .cycles = counted.repeats * level.cycles, .same_teeth = true});
    }
  }
}

std::vector<SpectrumBin> bins_of(const CountedSignal& counted) {
  std::vector<SpectrumBin> bins;
  if (counted.counting == LoadCounting::TimeAtLevel && counted.count.idle_duration > 0.0) {
    if (const SpectrumBin idle = idle_bin(counted); idle.hours > 0.0) bins.push_back(idle);
  }
  append_levels(counted, counted.count, 1.0, bins);
  if (counted.reversed) append_levels(counted, *counted.reversed, -1.0, bins);
  return bins;
}

LoadCount count(const LoadSignal& signal, const SpectrumSource& source) {
  return source.counting == LoadCounting::TimeAtLevel ? count_time_at_level(signal, source.bins) : count_rainflow(signal, source.bins);
}

/// A bin beyond the range of the keys that would give it.
std::optional<InvalidInput> find_problem(const std::vector<SpectrumBin>& bins) {
  static const KeyIndex keys = element_keys("load.spectrum");
  for (const SpectrumBin& bin : bins) {
    for (const auto& [name, value] : {std::pair{"torque", bin.torque}, std::pair{"hours", bin.hours}, std::pair{"cycles", bin.cycles}}) {
      const SchemaKey& key = *keys.at(name);
      const double bare = outside_value(value, key.quantity);
      const bool is_none = std::isnan(bare) || bare == 0.0;  // not counted, or a standstill
      if (!is_none && !is_in_range(key, bare)) return InvalidInput(name, in_words(bare), allowed_values(key));
    }
  }
  return std::nullopt;
}

double repeats_of(const SpectrumSource& source, double duration) {
  if (!std::isnan(source.hours)) return source.hours / duration;
  return std::isnan(source.repeats) ? 1.0 : source.repeats;
}

}  // namespace

void read_signal(StudyReading& reading, const std::string& path) {
  Study& study = reading.builder.study;
  const SpectrumSource& source = study.spectrum_source;
  LoadSignal signal = read_signal_file(path);
  if (signal.speed.empty() && source.counting == LoadCounting::TimeAtLevel) {
    const double speed = reading.builder.base.speed;
    if (!(speed > 0.0)) return reading.refuse_key(signal_path, path + " has no column speed: allowed is one, or load.speed");
    signal.speed.assign(signal.time.size(), speed);
  }
  for (double& torque : signal.torque) torque *= source.torque_factor;
  const auto [least, largest] = std::ranges::minmax(signal.torque);
  CountedSignal counted{.file = path, .counting = source.counting, .samples = signal.time.size(), .duration = signal.duration()};
  counted.repeats = repeats_of(source, counted.duration);
  counted.least_torque = least;
  counted.largest_torque = largest;
  try {
    counted.count = count(signal, source);
    for (double& torque : signal.torque) torque = -torque;
    if (LoadCount reversed = count(signal, source); !reversed.levels.empty()) counted.reversed = std::move(reversed);
    if (counted.count.levels.empty() && !counted.reversed) {
      const bool is_rainflow = source.counting == LoadCounting::Rainflow;
      throw InvalidInput("torque", is_rainflow ? "without a swing" : "always 0 while the pinion turns",
                         is_rainflow ? "one that changes" : "one that loads a flank while the pinion turns");
    }
  } catch (const InvalidInput& problem) {
    return reading.refuse_key(signal_path, path + ": " + problem.field() + " is " + problem.value() + ", allowed is " + problem.allowed());
  }
  study.spectrum = bins_of(counted);
  if (const auto problem = find_problem(study.spectrum)) {
    return reading.refuse_key(signal_path,
                              path + " counts to a " + problem->field() + " of " + problem->value() + ": allowed is " + problem->allowed());
  }
  study.signal = std::move(counted);
}

}  // namespace flankwright::studies
