#include "studies/analysis/unit_note.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/rating/shaft_misalignment.hpp"

namespace flankwright::studies {

std::string unit_note(const StudyResults& results) {
  if (!results.shafts || !results.shafts->has_unit()) return {};
  constexpr double out_of_contact = 2.0;  // face_load_factor above this: the line load would be negative at one end
  constexpr double in_balance = 1e-6;     // residual of a shaft's equilibrium at most: sound units have some 1e-16
  constexpr double still_small = 0.1;     // misalignment over the module at most: the motion of the flanks is linear in it
  double worst = out_of_contact;
  std::string note;
  for (const LoadedResult& loaded : results.loaded) {
    const MeshModel& model = results.models[loaded.model];
    const UnitState state = shafts_under(*results.shafts, model, loaded.torque).state(loaded.torque, model.axial_offset);
    for (const ShaftState& shaft : state.shafts) {
      if (shaft.residual <= in_balance) continue;
      return fmt::format(
          "the forces on the unit's shaft \"{}\" do not balance, by {:.2g} of the largest, in scene \"{}\" at {:.6g} N·m: supports of the unit are too far apart in "
          "stiffness, or too close in place, for what hangs on them to be known",
          shaft.name, shaft.residual, loaded.scene, loaded.torque / units::newton_metre);
    }
    const double module = model.pair.data.normal_module;
    if (std::abs(state.mesh_misalignment) > still_small * module) {
      return fmt::format(
          "the unit's shafts misalign the pair by {:.3g} mm in scene \"{}\" at {:.6g} N·m, which is no small motion of teeth of {:.3g} mm module: a "
          "shaft, a bearing or the housing is given too soft",
          std::abs(state.mesh_misalignment), loaded.scene, loaded.torque / units::newton_metre, module);
    }
    for (const MeshState& mesh : state.meshes) {
      if (std::abs(mesh.misalignment) > still_small * module) {
        return fmt::format(
            "the unit's shafts misalign {} by {:.3g} mm in scene \"{}\" at {:.6g} N·m, which is no small motion of teeth: a shaft, a bearing or the housing is "
            "given too soft, or bearings too close",
            mesh.name, std::abs(mesh.misalignment), loaded.scene, loaded.torque / units::newton_metre);
      }
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
