#include "studies/compliance/study_compliance.hpp"

#include <spdlog/spdlog.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>

#include "optimize/design/problem/for_each_in_parallel.hpp"
#include "studies/compliance/disk_store.hpp"

namespace flankwright::studies {

namespace {

/// Fraction of the machine's memory that runs may take.
constexpr double share_of_memory = 0.8;

double machine_memory() { return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE)); }

}  // namespace

bool asks_for_root_stress(const Study& study) { return study.task->asks_for_root_stress != nullptr && study.task->asks_for_root_stress(study); }

bool wants_root_stress(const Study& study) {
  const Fidelity& fidelity = study.fidelity;
  if (fidelity.compliance == ComplianceModel::Rigid) return false;
  if (!fidelity.automatic_effects) return std::ranges::find(fidelity.effects, "root_stress") != fidelity.effects.end();
  return couples_teeth(fidelity.compliance) || asks_for_root_stress(study) ||
         std::ranges::any_of(study.expect, [](const Expectation& e) { return e.key.find("root_stress") != std::string::npos; });
}

bool wants_rigid_bodies(const Study& study) {
  const Fidelity& fidelity = study.fidelity;
  if (study.task->single_gears || !couples_teeth(fidelity.compliance)) return false;
  const bool left_out = !fidelity.automatic_effects && std::ranges::find(fidelity.effects, "gear_body_compliance") == fidelity.effects.end();
  return left_out || study.task->compares_bodies || fidelity.effect_sizes == EffectSizing::Exact;
}

bool solves_finite_elements(const Study& study) {
  return study.task->single_gears || (has_torque(study) && (couples_teeth(study.fidelity.compliance) || wants_root_stress(study)));
}

ComplianceTask compliance_task(const Study& study, const GearPair& pair) {
  ComplianceTask task{.pair = pair,
                      .model = study.fidelity.compliance,
                      .material = {study.material.pinion, study.material.wheel},
                      .body = {study.body.pinion, study.body.wheel},
                      .shaft = {study.shaft.pinion, study.shaft.wheel},
                      .root_stress = wants_root_stress(study),
                      .rigid_bodies = wants_rigid_bodies(study),
                      .other_flanks = std::ranges::any_of(study.scenes, [&](const Scene& scene) { return loads_other_flanks(study, scene); })};
  if (study.task->single_gears) {
    task.model = ComplianceModel::Fe;
    task.shaft.pinion.reset();
    task.shaft.wheel.reset();
    task.other_flanks = false;
  }
  return task;
}

GearStructures gear_structures(const Study& study, const GearPair& pair, const ProgressReport& progress) {
  const ComplianceTask task = compliance_task(study, pair);
  DiskStore store;
  ComplianceBuild build{.store = &store, .memory_limit = share_of_memory * machine_memory(), .abreast = tbb::this_task_arena::max_concurrency()};
  build.for_each = for_each_in_parallel;
  build.progress = [&, announced = false](const std::string& label, int done, int total, const std::string& remark) mutable {
    if (!announced) {
      for (const std::string& note : library_notes(task)) spdlog::info("{}", note);
    }
    announced = true;
    if (progress) progress(label, done, total, remark);
  };
  GearStructures structures = build_compliance(task, build);
  structures.notes.insert(structures.notes.end(), store.notes().begin(), store.notes().end());
  return structures;
}

}  // namespace flankwright::studies
