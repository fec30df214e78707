#include "studies/analysis/deflection_note.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/units.hpp"

namespace flankwright::studies {

namespace {

/// The largest approach of the flanks over the cycle by the deformation of teeth and bodies [mm].
double largest_approach(const LoadedCycle& cycle) {
  double largest = 0.0;
  for (const LoadedPosition& position : cycle.positions) {
    if (position.gap.total.size() > 0) largest = std::max(largest, position.approach_of_teeth());
  }
  return largest;
}

}  // namespace

std::string deflection_note(const StudyResults& results) {
  constexpr double still_small = 0.1;  // of the module at most: loaded steel gears stay below a hundredth of it
  const LoadedResult* worst = nullptr;
  double largest = still_small * results.pair.data.normal_module;
  for (const LoadedResult& loaded : results.loaded) {
    const double approach = largest_approach(loaded.cycle);
    if (!(approach > largest)) continue;
    largest = approach;
    worst = &loaded;
  }
  if (worst == nullptr) return {};
  return fmt::format(
      "in scene \"{}\" at {:.6g} N·m teeth and bodies deform by {:.3g} mm, which is no small deflection at a module of {:.3g} mm: the torque is too large, or the "
      "material or the common face too small, for these results to mean anything",
      worst->scene, worst->torque / units::newton_metre, largest, results.pair.data.normal_module);
}

}  // namespace flankwright::studies
