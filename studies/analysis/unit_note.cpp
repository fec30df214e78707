#include "studies/analysis/unit_note.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

std::vector<std::string> idle_bearing_notes(const StudyResults& results) {
  if (!results.shafts || !results.shafts->depends_on_load()) return {};
  struct Idle {
    BearingState bearing;
    std::vector<std::pair<std::string, double>> cases;  // scene and torque; both designs of an optimisation have the same
  };
  std::vector<Idle> all;
  for (const LoadedResult& loaded : results.loaded) {
    const MeshModel& model = results.models[loaded.model];
    for (const BearingState& bearing : shafts_under(*results.shafts, model, loaded.torque).state(loaded.torque, model.axial_offset).bearings) {
      if (bearing.carries) continue;
      auto idle = std::ranges::find_if(all, [&](const Idle& of) { return of.bearing.name == bearing.name && of.bearing.shaft == bearing.shaft; });
      if (idle == all.end()) idle = all.insert(all.end(), {bearing, {}});
      const std::pair of_case(loaded.scene, loaded.torque);
      if (std::ranges::find(idle->cases, of_case) == idle->cases.end()) idle->cases.push_back(of_case);
    }
  }
  std::vector<std::string> notes;
  for (const auto& [bearing, cases] : all) {
    const std::size_t further = cases.size() - 1;
    const std::string others = further == 0 ? "" : fmt::format(" and in {} further load case{}", further, further == 1 ? "" : "s");
    const std::string why = bearing.radial_clearance > 0.0
                                ? fmt::format(
                                      "the shaft floats in its clearance of {:.4g} um there, where small forces that the study leaves out, such as "
                                      "its weight, can move it",
                                      bearing.radial_clearance / units::um)
                                : "without load it has no stiffness and does not hold the shaft";
    notes.push_back(fmt::format("bearing \"{}\" of the shaft \"{}\" carries nothing in scene \"{}\" at {:.6g} N·m{}: {}", bearing.name, bearing.shaft,
                                cases.front().first, cases.front().second / units::newton_metre, others, why));
  }
  return notes;
}

}  // namespace flankwright::studies
