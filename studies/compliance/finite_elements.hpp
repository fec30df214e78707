#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/compliance/finite_element/solve_influence_table.hpp"
#include "studies/base/progress.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// Influence values of one gear of a study and where they came from.
struct GearRun {
  std::shared_ptr<const InfluenceTable> table;
  std::shared_ptr<const RootStressTable> root_stress;  ///< null where the study does not want it
  RunStatistics statistics;    ///< of the run, whenever it was made
  GearBody body;               ///< used [mm]
  RemovedMotion removed{RemovedMotion::TranslationTorsionAndTilt};
  bool from_cache{false};
  std::string file;            ///< where it is kept; empty: nowhere
  double seconds{not_given};   ///< wall time in this study
};

struct FiniteElementRuns {
  std::array<GearRun, 2> gears;  ///< pinion, wheel; by coarse_mesh() where the compliance is "fitted"
  /// By the default mesh, for a fit of its own, beside that of `gears`: those that the library of fits does not know.
  std::array<std::optional<GearRun>, 2> fine;
  /// By coarse_mesh(), with the face of the fine run, where that is narrower than the gear's own.
  std::array<std::optional<GearRun>, 2> narrow;
  /// As `gears`, their bodies rigid; where wants_rigid_bodies().
  std::array<std::optional<GearRun>, 2> rigid_body;
  std::vector<std::string> notes;
  double seconds{not_given};     ///< wall time in this study

  const GearRun& operator[](Member m) const { return gears[m == Member::Pinion ? 0 : 1]; }
  const std::optional<GearRun>& fine_run(Member m) const { return fine[m == Member::Pinion ? 0 : 1]; }
  const std::optional<GearRun>& narrow_run(Member m) const { return narrow[m == Member::Pinion ? 0 : 1]; }
  const std::optional<GearRun>& rigid_body_run(Member m) const { return rigid_body[m == Member::Pinion ? 0 : 1]; }
  /// Of the finest run with the gear's own face; null where the study does not want it.
  const std::shared_ptr<const RootStressTable>& root_stress(Member m) const {
    return fine_run(m) && !narrow_run(m) ? fine_run(m)->root_stress : (*this)[m].root_stress;
  }
};

/// Whether an optimisation minimises or bounds root stress: a search that does not goes without it.
bool asks_for_root_stress(const Study& study);

/// Whether the study's finite elements shall tell root stress: where its compliance is "fitted" or "fe", or an objective, constraint
/// or expectation names it, and the study's own list of effects, if it has one, does not leave it out.
bool wants_root_stress(const Study& study);

/// Whether the study asks what its gears do on rigid bodies: to leave the effect `gear_body_compliance` out, by its list of effects, on a
/// rung of a ladder or for an accuracy, or for that effect's exact size. An estimate of the size is not worth runs of their own.
bool wants_rigid_bodies(const Study& study);

/// Whether the study solves finite elements of its gears at all: for its task, or, where there is a torque, its compliance
/// or root stress.
bool solves_finite_elements(const Study& study);

/// What is to be solved for one gear, by a coarse mesh where the compliance is "fitted": its own face width, body and tip, teeth apart as the pair needs them (two at
/// least, so that the loaded tooth's neighbours stand on what they stand on), the grid of flank_grid().
/// @throws InvalidInput  under the study's keys, where body and teeth cannot be meshed
InfluenceTableTask influence_table_task(const Study& study, const GearPair& pair, Member member);

/// What of a gear the library of fits does not know, RefinementLibrary::unknown(), where the study's compliance would use
/// it: the gear then needs a fit of its own. Empty otherwise.
std::string unknown_to_library(const Study& study, const InfluenceTableTask& task);

/// What a gear outside the library costs and why, one line for each such gear.
std::vector<std::string> library_notes(const Study& study, const GearPair& pair);

/// What a gear's own fit is made from: the coarse task, with a face of at most widest_own_fit.
InfluenceTableTask task_of_fit(InfluenceTableTask coarse);

/// Solves both gears or takes them from the cache. Gears that are alike but for their size are solved once; two that
/// are not are solved side by side where memory suffices for both, one after the other where it does not.
/// @throws InvalidInput  "fidelity.compliance" where a gear does not fit into the machine's memory, and as
///                       influence_table_task()
FiniteElementRuns solve_finite_elements(const Study& study, const GearPair& pair, const ProgressReport& progress);

}  // namespace flankwright::studies
