#include "studies/compliance_json.hpp"

#include <algorithm>

#include "core/base/units.hpp"
#include "core/compliance/fitted/refinement_library.hpp"

namespace flankwright::studies {

namespace {

Json gear_run_json(const GearRun& run, const Material& material) {
  const RunStatistics& statistics = run.statistics;
  const InfluenceTable& table = *run.table;
  return {{"source", run.from_cache ? "cache" : "solved"},
          {"file", run.file},
          {"seconds", run.seconds},
          {"bricks", statistics.bricks},
          {"unknowns", statistics.unknowns},
          {"factor_entries", statistics.factor_entries},
          {"peak_memory_bytes", statistics.peak_bytes},
          {"model_seconds", statistics.model_seconds},
          {"loads_seconds", statistics.solve_seconds},
          {"teeth_apart", table.teeth_apart()},
          {"root_stress", run.root_stress != nullptr},
          {"grid", {{"radii", table.grid().us().size()}, {"axial_positions", table.grid().zetas().size()}}},
          {"removed_shaft_motion", name_of(run.removed)},
          {"lowest_eigenvalue", table.projection().lowest_eigenvalue},
          {"projection", table.projection().added},
          {"youngs_modulus_MPa", material.youngs_modulus},
          {"poissons_ratio", material.poissons_ratio},
          {"body", body_json(run.body)}};
}

/// The library that completes the coarse values, and how close its own gears come, the least close of each figure.
Json fits_json(const RefinementLibrary& library) {
  ResidualStatistics worst{0, 0, 0, 0, 0};
  for (const RefinementEntry& entry : library.entries()) {
    worst.pairs += entry.unseen.pairs;
    worst.median = std::max(worst.median, entry.unseen.median);
    worst.share_95 = std::max(worst.share_95, entry.unseen.share_95);
    worst.worst = std::max(worst.worst, entry.unseen.worst);
  }
  const auto ends = [](const auto& values) { return Json{values.front(), values.back()}; };
  return {{"gears", library.entries().size()},
          {"teeth", ends(library.teeth())},
          {"helix_angle_deg", {library.helix_angles().front() / units::deg, library.helix_angles().back() / units::deg}},
          {"profile_shift", ends(library.profile_shifts())},
          {"interpolation", "polynomials through all gears in 1/z, helix angle and profile shift"},
          {"largest_residual_percent",
           {{"pairs", worst.pairs}, {"median", 100 * worst.median}, {"share_95", 100 * worst.share_95}, {"worst", 100 * worst.worst}}}};
}

}  // namespace

const char* name_of(RemovedMotion removed) {
  switch (removed) {
    case RemovedMotion::None: return "none";
    case RemovedMotion::TranslationAndTorsion: return "transverse translation and torsion";
    case RemovedMotion::TranslationTorsionAndTilt: return "transverse translation, torsion and tilt";
    case RemovedMotion::WholeTranslationTorsionAndTilt: return "translation, torsion and tilt";
  }
  __builtin_unreachable();
}

Json compliance_json(const FiniteElementRuns& runs, const Study& study) {
  Json json{{"model", to_string(study.fidelity.compliance)},
            {"seconds", runs.seconds},
            {"pinion", gear_run_json(runs[Member::Pinion], study.pinion_material)},
            {"wheel", gear_run_json(runs[Member::Wheel], study.wheel_material)}};
  if (study.fidelity.compliance == ComplianceModel::Fitted) json["fits"] = fits_json(RefinementLibrary::shipped());
  return json;
}

Json body_json(const GearBody& body) {
  return {{"shaft_diameter_mm", body.shaft_diameter},
          {"bore_diameter_mm", body.bore_diameter},
          {"shaft_overhang_mm", body.shaft_overhang},
          {"torque_end", body.torque_end == FaceEnd::Blunt ? "blunt" : "sharp"}};
}

}  // namespace flankwright::studies
