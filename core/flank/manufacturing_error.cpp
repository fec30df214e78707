#include "core/flank/manufacturing_error.hpp"

namespace flankwright {

namespace {

/// Entry k mod size; 0 of an empty list.
template <class Value>
Value of_tooth(const std::vector<Value>& list, int tooth) {
  if (list.empty()) return {};
  const int size = static_cast<int>(list.size());
  return list[static_cast<std::size_t>(((tooth % size) + size) % size)];
}

}  // namespace

ToothError tooth_error(const ManufacturingError& error, int tooth) {
  return {error.helix_slope + of_tooth(error.helix_slopes, tooth), error.profile_slope + of_tooth(error.profile_slopes, tooth),
          error.twist + of_tooth(error.twists, tooth)};
}

const DeviationField* tooth_topography(const ManufacturingError& error, int tooth) { return of_tooth(error.topographies, tooth).get(); }

bool teeth_differ(const ManufacturingError& error) {
  return error.pitch_step != 0.0 || !error.cumulative_pitch.empty() || !error.helix_slopes.empty() || !error.profile_slopes.empty() ||
         !error.twists.empty() || !error.topographies.empty();
}

double pitch_deviation(const ManufacturingError& error, int tooth) {
  return error.cumulative_pitch.empty() ? error.pitch_step * tooth : of_tooth(error.cumulative_pitch, tooth);
}

}  // namespace flankwright
