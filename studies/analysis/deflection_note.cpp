#include "studies/analysis/deflection_note.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/units.hpp"

namespace flankwright::studies {

namespace {

/// What teeth of steel discs yield by ISO 6336-1, F/(b c_gamma), without shafts, bearings and webs [mm].
double yield_of_teeth(const MeshModel& model, const LoadedCycle& cycle) { return cycle.force / (model.face_width * model.iso.c_gamma) * units::um; }

}  // namespace

std::string deflection_note(const StudyResults& results) {
  constexpr double still_small = 0.1;  // of the module at most: loaded steel gears stay below a hundredth of it
  const LoadedResult* worst = nullptr;
  double largest = still_small * results.pair.data.normal_module;
  for (const LoadedResult& loaded : results.loaded) {
    const double yield = yield_of_teeth(results.models[loaded.model], loaded.cycle);
    if (!(yield > largest)) continue;
    largest = yield;
    worst = &loaded;
  }
  if (worst == nullptr) return {};
  return fmt::format(
      "in scene \"{}\" at {:.6g} N·m the teeth yield by about {:.3g} mm, which is no small deflection at a module of {:.3g} mm: the torque is too large, or the "
      "material or the common face too small, for these results to mean anything",
      worst->scene, worst->torque / units::newton_metre, largest, results.pair.data.normal_module);
}

}  // namespace flankwright::studies
