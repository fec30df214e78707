#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "core/base/for_each_index.hpp"
#include "core/base/progress_report.hpp"
#include "core/compliance/model/compliance_store.hpp"
#include "core/compliance/model/compliance_task.hpp"

namespace flankwright {

/// The resources of a build, and its progress report. Only the time depends on it.
struct ComplianceBuild {
  ComplianceStore* store{nullptr};                               ///< null: nothing is kept
  double memory_limit{std::numeric_limits<double>::infinity()};  ///< that all runs at one time may take [bytes], > 0
  ForEachIndex for_each{};                                       ///< over finite-element runs; empty: one after the other
  int abreast{1};                                                ///< runs that `for_each` has at one time, at most, >= 1
  ProgressReport progress{};                                     ///< called by one thread at a time; may be empty
};

/// Influence values of one gear and where they came from.
struct GearRun {
  std::shared_ptr<const InfluenceTable> table;
  std::shared_ptr<const RootStressTable> root_stress;  ///< null where the task does not want it
  RunStatistics statistics;                            ///< of the run, whenever it was made
  GearBody body;                                       ///< used [mm]; the web's offset along the pair's z
  RemovedRigidMotion removed{RemovedRigidMotion::TranslationTorsionAndTilt};
  bool from_cache{false};
  std::string file;                                    ///< where it is kept; empty: nowhere
  double seconds{not_given};                           ///< wall time in this build
  std::shared_ptr<const RimMotionTable> rim_motion{};  ///< null: a solid disc
  GearMeshOptions mesh{};                              ///< its elements
};

struct FiniteElementRuns {
  PerGear<GearRun> gears;  ///< by coarse_mesh() where the compliance is "fitted"
  /// By the default mesh, for an own fit, in addition to `gears`: gears outside the library of fits.
  PerGear<std::optional<GearRun>> fine;
  /// By coarse_mesh(), with face and body of the fine run, where that face is narrower than the gear's own or the gear's body is not solid.
  PerGear<std::optional<GearRun>> narrow;
  /// As `gears` with rigid bodies; where ComplianceTask::rigid_bodies.
  PerGear<std::optional<GearRun>> rigid_body;
  double seconds{not_given};  ///< wall time in this build

  const GearRun& operator[](Member m) const { return gears[m]; }
  /// The run whose root stress counts: the finest with the gear's own face.
  const GearRun& root_stress_run(Member m) const { return fine[m] && !narrow[m] ? *fine[m] : gears[m]; }
};

/// Solves both gears or takes them from the store. Gears that are alike but for their size are solved once; two that
/// are not are solved side by side where memory suffices for both, one after the other where it does not.
/// @throws InvalidInput  "fidelity.compliance" where a gear does not fit into the memory, and as influence_table_task()
FiniteElementRuns solve_finite_elements(const ComplianceTask& task, const ComplianceBuild& build);

}  // namespace flankwright
