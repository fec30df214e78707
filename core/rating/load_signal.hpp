#pragma once

#include <vector>

#include "core/gear/gear_pair.hpp"

/// From a torque that was measured over time to the load cycles of teeth. A tooth of a pair that turns is loaded once in each revolution, from nothing to the torque of
/// that moment and back: how often a torque loads it is how often the gear turns under that torque, whatever the torque did before. That is the load duration
/// distribution by which gears are rated [ISO 6336-6]. The swings of the torque itself, which rainflow counts, are load cycles of shafts, hubs and bolts; of teeth only
/// where the same teeth stay in mesh.
namespace flankwright {

/// Torque over time, in straight lines from sample to sample.
struct LoadSignal {
  std::vector<double> time;    ///< [s], increasing, at least two samples
  std::vector<double> torque;  ///< on the pinion [N mm]; + loads the working flank, - the other one
  std::vector<double> speed;   ///< of the pinion, either way round [rad/s]; empty: not known

  double duration() const { return time.back() - time.front(); }
  /// @throws InvalidInput "time", "torque" or "speed"
  void validate() const;
};

/// What one torque stands for. It is the largest that occurs in its range of torques, so that no damage is left out as long as more torque does more of it.
struct LoadLevel {
  double torque{0.0};          ///< [N mm], > 0
  double duration{not_given};  ///< of time at level: while the pinion turns [s]
  double cycles{0.0};          ///< of time at level: revolutions of the pinion; of rainflow: cycles of the torque; > 0
  double speed{not_given};     ///< of time at level: mean over its revolutions, so that slow parts count by the load cycles that they bring [rad/s]
};

/// A signal as load levels of the working flank.
struct LoadCount {
  std::vector<LoadLevel> levels;  ///< of rising torque, none without cycles; empty where nothing loads this flank
  double idle_duration{0.0};      ///< torque at or below 0: without load on the working flank [s]
  double idle_revolutions{0.0};   ///< of the pinion in that time [-]
  double reversed_duration{0.0};  ///< the part of it below 0 [s]
  double standing_duration{0.0};  ///< under load without turning: no load cycles [s]
};

/// Time and revolutions at equal ranges of torque between the smallest (at least 0) and the largest of the signal. Durations and revolutions of all parts add up to
/// those of the signal. In each line torque and speed change evenly; where the pinion turns back on the way it stands for a moment.
/// @param ranges  >= 1
/// @throws InvalidInput as validate(); "speed" where there is none
LoadCount count_time_at_level(const LoadSignal& signal, int ranges);

/// Cycles of the torque by repeating_rainflow(), in equal ranges of the torque from 0 that does as much damage as a cycle from T_min to T_max,
///
///     T = sqrt(T_max (T_max - T_min))
///
/// [Smith, Watson and Topper 1970, of stress that is in proportion to torque]. Torque below 0 loads the other flank and counts as 0.
/// @throws InvalidInput as validate()
LoadCount count_rainflow(const LoadSignal& signal, int ranges);

}  // namespace flankwright
