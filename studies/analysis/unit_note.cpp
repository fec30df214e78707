#include "studies/analysis/unit_note.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/rating/shaft_misalignment.hpp"

namespace flankwright::studies {

std::string unit_note(const StudyResults& results) {
  if (!results.shafts || !results.shafts->has_unit()) return {};
  constexpr double out_of_contact = 2.0;  // face_load_factor above this: the line load would be negative at one end
  double worst = out_of_contact;
  std::string note;
  for (const LoadedResult& loaded : results.loaded) {
    const MeshModel& model = results.models[loaded.model];
    for (const MeshState& mesh : shafts_under(*results.shafts, model, loaded.torque).state(loaded.torque, model.axial_offset).meshes) {
      if (!(mesh.face_load_factor > worst)) continue;
      worst = mesh.face_load_factor;
      note = fmt::format(
          "{} of the unit is out of contact at one end of its face in scene \"{}\" at {:.6g} N·m: by its springs the largest line load is {:.3g} times the mean, and "
          "they hold its shafts more than the teeth would",
          mesh.name, loaded.scene, loaded.torque / units::newton_metre, worst);
    }
  }
  return note;
}

}  // namespace flankwright::studies
