#include "studies/study_file/study_signal.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "studies/study_file/signal_file.hpp"
#include "studies/study_file/sweep_value.hpp"

namespace flankwright::studies {

namespace {

constexpr const char* signal_path = "load.spectrum.signal";

/// Time without load; without revolutions it has no speed.
SpectrumBin idle_bin(const LoadCount& count, double repeats) {
  const double revolutions = count.idle_revolutions;
  return {.torque = 0.0,
          .speed = revolutions > 0.0 ? 2.0 * units::pi * revolutions / count.idle_duration : not_given,
          .hours = repeats * count.idle_duration,
          .cycles = repeats * revolutions};
}

std::vector<SpectrumBin> bins_of(const CountedSignal& counted) {
  const LoadCount& count = counted.count;
  std::vector<SpectrumBin> bins;
  if (count.idle_duration > 0.0) bins.push_back(idle_bin(count, counted.repeats));
  for (const LoadLevel& level : count.levels) {
    if (counted.counting == LoadCounting::TimeAtLevel) {
      bins.push_back(
          {.torque = level.torque, .speed = level.speed, .hours = counted.repeats * level.duration, .cycles = counted.repeats * level.cycles});
    } else {
      bins.push_back({.torque = level.torque, .cycles = counted.repeats * level.cycles, .same_teeth = true});
    }
  }
  return bins;
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
    counted.count = source.counting == LoadCounting::TimeAtLevel ? count_time_at_level(signal, source.bins) : count_rainflow(signal, source.bins);
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
