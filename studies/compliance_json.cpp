#include "studies/compliance_json.hpp"

namespace flankwright::studies {

namespace {

const char* name_of(RemovedMotion removed) {
  switch (removed) {
    case RemovedMotion::None: return "none";
    case RemovedMotion::TranslationAndTorsion: return "translation and torsion";
    case RemovedMotion::TranslationTorsionAndTilt: return "translation, torsion and tilt";
  }
  __builtin_unreachable();
}

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
          {"grid", {{"radii", table.grid().us().size()}, {"axial_positions", table.grid().zetas().size()}}},
          {"removed_shaft_motion", name_of(run.removed)},
          {"lowest_eigenvalue", table.projection().lowest_eigenvalue},
          {"projection", table.projection().added},
          {"youngs_modulus_MPa", material.youngs_modulus},
          {"poissons_ratio", material.poissons_ratio},
          {"body", body_json(run.body)}};
}

}  // namespace

Json compliance_json(const FiniteElementRuns& runs, const Study& study) {
  return {{"model", "fe"},
          {"seconds", runs.seconds},
          {"pinion", gear_run_json(runs[Member::Pinion], study.pinion_material)},
          {"wheel", gear_run_json(runs[Member::Wheel], study.wheel_material)}};
}

Json body_json(const GearBody& body) {
  return {{"shaft_diameter_mm", body.shaft_diameter},
          {"bore_diameter_mm", body.bore_diameter},
          {"shaft_overhang_mm", body.shaft_overhang}};
}

}  // namespace flankwright::studies
