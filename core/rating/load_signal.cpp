#include "core/rating/load_signal.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/error.hpp"
#include "core/rating/rainflow.hpp"

namespace flankwright {

namespace {

/// Equal ranges between two torques; what lies on a border belongs to the range below it.
class TorqueRanges {
 public:
  TorqueRanges(double low, double high, int ranges) : low_(low), count_(high > low ? ranges : 1), width_((high - low) / count_) {}

  std::size_t count() const { return static_cast<std::size_t>(count_); }
  /// Upper end of a range.
  double top(std::size_t range) const { return low_ + width_ * static_cast<double>(range + 1); }
  std::size_t of(double torque) const {
    if (!(width_ > 0.0)) return 0;
    return static_cast<std::size_t>(std::clamp(std::ceil((torque - low_) / width_) - 1.0, 0.0, static_cast<double>(count_ - 1)));
  }

 private:
  double low_;
  int count_;
  double width_;
};

struct SignalSample {
  double time, torque, speed;
};

/// The samples, and one more where the pinion turns back between two of them; speeds without direction.
std::vector<SignalSample> samples_of(const LoadSignal& signal) {
  std::vector<SignalSample> samples;
  for (std::size_t i = 0; i < signal.time.size(); ++i) {
    if (i > 0 && signal.speed[i - 1] * signal.speed[i] < 0.0) {
      const double share = signal.speed[i - 1] / (signal.speed[i - 1] - signal.speed[i]);
      samples.push_back({std::lerp(signal.time[i - 1], signal.time[i], share), std::lerp(signal.torque[i - 1], signal.torque[i], share), 0.0});
    }
    samples.push_back({signal.time[i], signal.torque[i], std::abs(signal.speed[i])});
  }
  return samples;
}

/// A straight line between two samples, by the share of it from its lower torque to its higher one.
struct SignalLine {
  SignalSample lower, upper;
  double duration;

  bool is_level() const { return !(upper.torque > lower.torque); }
  double share_at(double torque) const { return std::clamp((torque - lower.torque) / (upper.torque - lower.torque), 0.0, 1.0); }
  double duration_of(double from, double to) const { return duration * (to - from); }
  double revolutions_of(double from, double to) const {
    const double mean_speed = lower.speed + 0.5 * (from + to) * (upper.speed - lower.speed);
    return duration_of(from, to) * mean_speed / (2.0 * units::pi);
  }
  bool stands() const { return lower.speed == 0.0 && upper.speed == 0.0; }
  /// Sum of the revolutions, each times its speed [rad/s].
  double speed_of_revolutions(double from, double to) const {
    const double a = std::lerp(lower.speed, upper.speed, from), b = std::lerp(lower.speed, upper.speed, to);
    return duration_of(from, to) * (a * a + a * b + b * b) / 3.0 / (2.0 * units::pi);
  }
};

void check_torque_ranges(int ranges) {
  if (ranges < 1) throw InvalidInput("ranges", std::to_string(ranges), "at least 1");
}

}  // namespace

void LoadSignal::validate() const {
  if (time.size() < 2) throw InvalidInput("time", std::to_string(time.size()) + " samples", "at least two samples");
  if (torque.size() != time.size()) throw InvalidInput("torque", std::to_string(torque.size()) + " samples", "one for each time");
  if (!speed.empty() && speed.size() != time.size())
    throw InvalidInput("speed", std::to_string(speed.size()) + " samples", "one for each time, or none");
  for (const auto& [name, values] : {std::pair{"time", &time}, std::pair{"torque", &torque}, std::pair{"speed", &speed}}) {
    for (const double value : *values) {
      if (!std::isfinite(value)) throw InvalidInput(name, in_words(value), "a finite number");
    }
  }
  const auto late = std::ranges::adjacent_find(time, [](double before, double after) { return !(after > before); });
  if (late != time.end()) throw InvalidInput("time", in_words(late[1]), "above the time before it, " + in_words(late[0]));
}

LoadCount count_time_at_level(const LoadSignal& signal, int ranges) {
  check_torque_ranges(ranges);
  signal.validate();
  if (signal.speed.empty()) throw InvalidInput("speed", "none", "one for each time");
  const auto [least, largest] = std::ranges::minmax(signal.torque);
  const TorqueRanges range(std::max(0.0, least), std::max(0.0, largest), ranges);
  std::vector<LoadLevel> levels(range.count(), LoadLevel{0.0, 0.0, 0.0, 0.0});
  LoadCount count;
  const std::vector<SignalSample> samples = samples_of(signal);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const SignalSample &a = samples[i], &b = samples[i + 1];
    const SignalLine line{a.torque <= b.torque ? a : b, a.torque <= b.torque ? b : a, b.time - a.time};
    double from = 0.0;
    if (line.lower.torque <= 0.0) {
      from = line.upper.torque <= 0.0 ? 1.0 : line.share_at(0.0);
      count.idle_duration += line.duration_of(0.0, from);
      count.idle_revolutions += line.revolutions_of(0.0, from);
      if (line.lower.torque < 0.0) count.reversed_duration += line.duration_of(0.0, line.upper.torque < 0.0 ? 1.0 : from);
    }
    for (std::size_t k = range.of(line.lower.torque); from < 1.0; ++k) {
      const bool ends_here = line.is_level() || k + 1 == range.count() || range.top(k) >= line.upper.torque;
      const double to = ends_here ? 1.0 : line.share_at(range.top(k));
      if (to <= from) continue;
      if (line.stands()) {
        count.standing_duration += line.duration_of(from, to);
      } else {
        LoadLevel& level = levels[k];
        level.torque = std::max(level.torque, ends_here ? line.upper.torque : range.top(k));
        level.duration += line.duration_of(from, to);
        level.cycles += line.revolutions_of(from, to);
        level.speed += line.speed_of_revolutions(from, to);
      }
      from = to;
    }
  }
  for (LoadLevel& level : levels) {
    if (!(level.cycles > 0.0)) continue;
    level.speed /= level.cycles;
    count.levels.push_back(level);
  }
  return count;
}

LoadCount count_rainflow(const LoadSignal& signal, int ranges) {
  check_torque_ranges(ranges);
  signal.validate();
  std::vector<double> torque = signal.torque;
  for (double& value : torque) value = std::max(0.0, value);
  struct Swing {
    double torque, count;
  };
  std::vector<Swing> swings;
  for (const RainflowCycle& cycle : repeating_rainflow(torque)) {
    swings.push_back({std::sqrt((cycle.mean + 0.5 * cycle.range) * cycle.range), cycle.count});
  }
  if (swings.empty()) return {};
  const auto [least, largest] = std::ranges::minmax(swings, {}, &Swing::torque);
  const TorqueRanges range(least.torque, largest.torque, ranges);
  std::vector<LoadLevel> levels(range.count());
  for (const Swing& swing : swings) {
    LoadLevel& level = levels[range.of(swing.torque)];
    level.torque = std::max(level.torque, swing.torque);
    level.cycles += swing.count;
  }
  LoadCount count;
  std::ranges::copy_if(levels, std::back_inserter(count.levels), [](const LoadLevel& level) { return level.cycles > 0.0; });
  return count;
}

}  // namespace flankwright
